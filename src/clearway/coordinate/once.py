"""All orders are known: assign them, add the robots' own tasks, plan once."""

from collections.abc import Callable

from clearway.assign import build, tours_of
from clearway.coordinate.precedence import plan_in_order
from clearway.coordinate.reassign import Reassignment
from clearway.coordinate.system import System, Tours
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

    def posed(tours: Tours) -> Problem:
        tours = system.own_tasks(scenario, tours)
        problem = Problem(scenario.site, scenario.robot_types, scenario.robots, tours)
        _refuse(system.plan.unsupported(problem))
        return problem

    def planned(problem: Problem, share: Budget) -> Plan:
        return plan_in_order(system.plan, problem, share, seed, progress)

    _refuse(_fetching(scenario))
    kept = _kept(scenario)
    if kept is not None:
        problem = posed(kept)
        before_planning()
        return planned(problem, budget)
    work = system.travel(scenario, build(scenario, system.weights))
    _refuse(system.assign.unsupported(work))
    routes = system.assign(work, seed)
    problem = posed(tours_of(scenario, routes))
    before_planning()
    if not system.rounds:
        return planned(problem, budget)
    return Reassignment(
        scenario,
        assign=lambda again: system.assign(again, seed),
        plan=lambda some, share: planned(posed(tours_of(scenario, some)), share),
        value=system.value,
        rounds=system.rounds,
    )(work, routes, budget)


def _kept(scenario: Scenario) -> dict[str, tuple[Visit, ...]] | None:
    """Return the tours where each task is kept for a robot that has no other; else ``None``."""
    tours: dict[str, tuple[Visit, ...]] = {robot.id: () for robot in scenario.robots}
    for order in scenario.orders:
        if order.task.robot is None or tours[order.task.robot]:
            return None
        tours[order.task.robot] = order.visits
    return tours


def _fetching(scenario: Scenario) -> tuple[str, ...]:
    fetching = [order.task.id for order in scenario.orders if order.task.fetches is not None]
    mend = "give it visits, or run a system that moves shelves through time"
    return tuple(
        f"task {name} fetches a shelf, which cannot be planned once; {mend}"
        for name in fetching[:1]
    )


def _refuse(reasons: tuple[str, ...]) -> None:
    if reasons:
        raise Unsupported("; ".join(reasons))
