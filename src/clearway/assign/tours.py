"""Routes of task numbers become tours of visits."""

from collections.abc import Sequence

from clearway.model import Scenario, Visit


def tours_of(scenario: Scenario, routes: Sequence[Sequence[int]]) -> dict[str, tuple[Visit, ...]]:
    """Return each robot's visits in order, where routes number the scenario's orders from 0."""
    return {
        robot.id: tuple(visit for task in route for visit in scenario.orders[task].visits)
        for robot, route in zip(scenario.robots, routes, strict=True)
    }
