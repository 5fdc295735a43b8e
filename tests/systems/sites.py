"""A scenario small enough to solve in an instant."""

from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Order,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
)

CARRIER = RobotType(
    "carrier",
    Footprint.rectangle(3.0, 2.0),
    "four_wheel",
    Limits(speed=2.5, yaw_rate=0.57, turning_radius=3.0),
)


def hall(**changes) -> Scenario:
    """Two carriers and two tasks of 1 s in a hall of 30 m x 12 m with a pillar."""
    tasks = {"t1": Pose(25.0, 3.0, 0.0), "t2": Pose(25.0, 9.0, 0.0)}
    parts = {
        "name": "hall",
        "site": Site(((0, 0), (30, 0), (30, 12), (0, 12)), (Obstacle(disc=(15.0, 6.0, 1.0)),)),
        "robot_types": {"carrier": CARRIER},
        "robots": (
            Robot("a", "carrier", Pose(3.0, 3.0, 0.0)),
            Robot("b", "carrier", Pose(3.0, 9.0, 0.0)),
        ),
        "orders": tuple(Order(Task(id_, (Visit(id_, at, 1.0),))) for id_, at in tasks.items()),
        "seed": 5,
    }
    return Scenario(**{**parts, **changes})
