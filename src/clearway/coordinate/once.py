"""All orders are known: assign them, add the robots' own tasks, plan once."""

from collections.abc import Callable

from clearway.assign import build, tours_of
from clearway.coordinate.precedence import plan_in_order
from clearway.coordinate.system import System
from clearway.model import Plan, Problem, Scenario, Visit
from clearway.protocols import Budget, Progress


class Unsupported(ValueError):
    """The system cannot take something in the scenario; the message lists what and the mend."""


def plan_once(
    scenario: Scenario,
    system: System,
    budget: Budget,
    seed: int,
    progress: Progress | None = None,
    before_planning: Callable[[], None] = lambda: None,
) -> Plan:
    """Return a plan for all of a scenario's orders.

    ``before_planning`` is called once everything is assigned.

    Raises
    ------
    Unsupported
        If a part of the system cannot take a feature of the scenario.
    """
    tours = _kept(scenario)
    if tours is None:
        work = system.travel(scenario, build(scenario, system.weights))
        _refuse(system.assign.unsupported(work))
        tours = tours_of(scenario, system.assign(work, seed))
    tours = system.own_tasks(scenario, tours)
    problem = Problem(scenario.site, scenario.robot_types, scenario.robots, tours)
    _refuse(system.plan.unsupported(problem))
    before_planning()
    return plan_in_order(system.plan, problem, budget, seed, progress)


def _kept(scenario: Scenario) -> dict[str, tuple[Visit, ...]] | None:
    """Return the tours where each task is kept for a robot that has no other; else ``None``."""
    tours: dict[str, tuple[Visit, ...]] = {robot.id: () for robot in scenario.robots}
    for order in scenario.orders:
        if order.task.robot is None or tours[order.task.robot]:
            return None
        tours[order.task.robot] = order.visits
    return tours


def _refuse(reasons: tuple[str, ...]) -> None:
    if reasons:
        raise Unsupported("; ".join(reasons))
