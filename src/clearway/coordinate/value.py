"""What a plan is worth less of: the numbers by which systems prefer one plan to another."""

from typing import Protocol

from clearway.metrics.paper_cost import paper_cost
from clearway.model import Plan, Scenario, to_seconds


class Value(Protocol):
    """Compares plans; the first number counts, the next ones where it is equal."""

    def __call__(self, scenario: Scenario, plan: Plan) -> tuple[float, ...]:
        """Return numbers that are lower for better plans."""
        ...


def sum_of_costs(scenario: Scenario, plan: Plan) -> tuple[float, ...]:
    """Return the sum of all last arrivals (s)."""
    return (to_seconds(sum(path.end for path in plan.trajectories.values())),)


def makespan(scenario: Scenario, plan: Plan) -> tuple[float, ...]:
    """Return the last arrival of all (s), then their sum."""
    last = max((path.end for path in plan.trajectories.values()), default=0)
    return (to_seconds(last), *sum_of_costs(scenario, plan))


def paper(scenario: Scenario, plan: Plan) -> tuple[float, ...]:
    """Return the cost of system A's paper (m)."""
    return (
        sum(
            paper_cost(plan.trajectories[robot.id], scenario.type_of(robot), robot.start_mode)
            for robot in scenario.robots
            if robot.id in plan.trajectories
        ),
    )


def lateness(plan: Plan) -> float:
    """Return the sum over tasks of the seconds that they are finished after they are due."""
    late = 0.0
    for robot, path in plan.trajectories.items():
        for stop in path.stops:
            due = plan.tours[robot][stop.visit].due
            if due is not None:
                late += max(to_seconds(stop.leave) - due, 0.0)
    return late
