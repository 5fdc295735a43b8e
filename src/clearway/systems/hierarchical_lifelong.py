"""System A with orders that keep arriving: four-wheel-steering robots, or any with true shapes."""

from dataclasses import asdict

from clearway.assign import NearestOrder, OldestOrder
from clearway.coordinate import Lifelong
from clearway.execute import BodyConflicts, RightOfWay
from clearway.model import Scenario
from clearway.plan.tail_trips import TailTrips
from clearway.protocols import Dispatcher, Executor
from clearway.systems.hierarchical import HierarchicalSettings


def hierarchical_lifelong(settings: HierarchicalSettings) -> Lifelong:
    """Return system A for orders as they come.

    Of its settings ``dispatch`` counts; the others are for planning at once.
    """

    def dispatch(scenario: Scenario) -> Dispatcher:
        return OldestOrder(scenario) if settings.dispatch == "oldest" else NearestOrder(scenario)

    def execute(scenario: Scenario) -> Executor:
        types = {robot.id: scenario.type_of(robot) for robot in scenario.robots}
        return RightOfWay(BodyConflicts(types))

    return Lifelong(
        name="hierarchical",
        dispatch=dispatch,
        trips=TailTrips,
        execute=execute,
        parameters=asdict(settings),
    )
