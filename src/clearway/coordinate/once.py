"""All orders are known: assign them, add the robots' own tasks, plan once."""

from collections.abc import Callable

from clearway.assign import build, tours_of
from clearway.coordinate.system import System
from clearway.model import Plan, Problem, Scenario
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
    work = build(scenario, system.weights)
    _refuse(system.assign.unsupported(work))
    routes = system.assign(work, seed)
    tours = system.own_tasks(scenario, tours_of(scenario, routes))
    problem = Problem(scenario.site, scenario.robot_types, scenario.robots, tours)
    _refuse(system.plan.unsupported(problem))
    before_planning()
    return system.plan(problem, budget, seed, progress)


def _refuse(reasons: tuple[str, ...]) -> None:
    if reasons:
        raise Unsupported("; ".join(reasons))
