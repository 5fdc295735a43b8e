"""System A with orders that keep arriving: four-wheel-steering robots, or any with true shapes."""

from dataclasses import asdict

from clearway.assign import Charging, NearestOrder, OldestOrder
from clearway.coordinate import Lifelong
from clearway.execute import BodyConflicts, RightOfWay
from clearway.execute.body_conflicts import LEAST_CLEARANCE
from clearway.model import Problem, Scenario
from clearway.plan import TailTrips
from clearway.plan.prioritised import unplannable
from clearway.protocols import Dispatcher, Executor
from clearway.simulation.disturbed import PERIOD
from clearway.systems.hierarchical import HierarchicalSettings


def hierarchical_lifelong(settings: HierarchicalSettings) -> Lifelong:
    """Return system A for orders as they come.

    Of its settings ``dispatch`` counts; the others are for planning at once.
    """

    def dispatch(scenario: Scenario) -> Dispatcher:
        orders = OldestOrder if settings.dispatch == "oldest" else NearestOrder
        return Charging(scenario, orders(scenario))

    def execute(scenario: Scenario) -> Executor:
        types = {robot.id: scenario.type_of(robot) for robot in scenario.robots}
        return RightOfWay(BodyConflicts(types), PERIOD)

    return Lifelong(
        name="hierarchical",
        dispatch=dispatch,
        trips=TailTrips,
        execute=execute,
        unsupported=_unsupported,
        parameters=asdict(settings),
    )


def _unsupported(scenario: Scenario) -> tuple[str, ...]:
    """Return what in a scenario system A cannot take when orders arrive."""
    tours = {robot.id: () for robot in scenario.robots}
    reasons = unplannable(Problem(scenario.site, scenario.robot_types, scenario.robots, tours))
    fetching = [order.task.id for order in scenario.orders if order.task.fetches is not None]
    fetching += [stream.name for stream in scenario.simulation.streams if stream.fetch]
    if fetching:
        what = f"{fetching[0]}: fetches a shelf; system A carries none, give it visits instead"
        reasons = (*reasons, what)
    if scenario.simulation.disturbances:
        reasons += tuple(
            f"robot type {name}: a clearance of {scenario.robot_types[name].clearance:g} m is too "
            f"little to go on under delay; give it {LEAST_CLEARANCE:g} m or more"
            for name in sorted({robot.type for robot in scenario.robots})
            if scenario.robot_types[name].clearance < LEAST_CLEARANCE
        )
    return reasons
