"""Small sites, fleets and tours on which planners are tried, and the judge's word on a plan."""

import math
from dataclasses import replace

from clearway.formats.recording import record_plan
from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Plan,
    PlanRecord,
    Pose,
    Problem,
    Robot,
    RobotType,
    Scenario,
    Site,
    Visit,
)
from clearway.validate import Violation, validate_plan

WEST, NORTH, EAST, SOUTH = math.pi, math.pi / 2.0, 0.0, -math.pi / 2.0

CARRIER = RobotType(
    "carrier",
    Footprint.rectangle(3.0, 2.0),
    "four_wheel",
    Limits(speed=2.5, yaw_rate=0.57, turning_radius=3.0),
)
CART = RobotType(
    "cart",
    Footprint.rectangle(1.0, 0.6),
    "four_wheel",
    Limits(speed=1.0, yaw_rate=0.8, turning_radius=1.0),
)
DRUM = RobotType(
    "drum",
    Footprint(radius=0.5),
    "four_wheel",
    Limits(speed=1.2, yaw_rate=1.0, turning_radius=0.8),
)
HOOK = RobotType(
    "hook",
    Footprint(
        parts=(
            ((1.0, 0.6), (-1.0, 0.6), (-1.0, 0.0), (1.0, 0.0)),
            ((1.0, 0.0), (0.4, 0.0), (0.4, -0.8), (1.0, -0.8)),
        )
    ),
    "four_wheel",
    Limits(speed=1.5, reverse_speed=0.7, yaw_rate=0.6, turning_radius=1.5),
)
# A car in its manners: it neither turns on the spot nor moves sideways.
CAR = replace(
    CART,
    name="car",
    modes=(
        "stop",
        "forward",
        "reverse",
        "forward-left",
        "forward-right",
        "reverse-left",
        "reverse-right",
    ),
)
TRUCK = RobotType(
    "truck",
    Footprint.rectangle(2.2, 1.2, rear=0.5),
    "ackermann",
    Limits(speed=2.0, reverse_speed=0.8, turning_radius=2.0),
)
STACKER = RobotType(
    "stacker",
    Footprint(
        parts=(
            ((1.2, 0.45), (-0.2, 0.45), (-0.2, -0.45), (1.2, -0.45)),
            ((-0.2, 0.25), (-1.0, 0.25), (-1.0, -0.25), (-0.2, -0.25)),
        )
    ),
    "ackermann",
    Limits(speed=1.4, reverse_speed=1.0, yaw_rate=0.7, turning_radius=1.2),
    motion="forklift",
)
# Its rear wheel steers so far that it pivots.
PIVOT = replace(STACKER, name="pivot", limits=replace(STACKER.limits, turning_radius=None))
TUG = RobotType(
    "tug", Footprint.rectangle(0.9, 0.6), "differential", Limits(speed=1.5, yaw_rate=1.2)
)
FLOAT = RobotType(
    "float",
    Footprint.rectangle(0.8, 0.8),
    "holonomic",
    Limits(speed=0.8, reverse_speed=0.5, yaw_rate=0.9),
)
TRAIN = replace(CART, name="train", modes=("stop", "forward", "reverse"))


def rectangle(x0: float, y0: float, x1: float, y1: float) -> tuple[tuple[float, float], ...]:
    """Corners of an upright rectangle."""
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def block(x0: float, y0: float, x1: float, y1: float, *blocks: str) -> Obstacle:
    """A rectangular obstacle; ``blocks`` names whom it stops."""
    return Obstacle(polygon=rectangle(x0, y0, x1, y1), blocks=blocks)


def room(width: float, height: float, *obstacles: Obstacle, border: str = "closed") -> Site:
    """A rectangular site with a corner at the origin."""
    return Site(rectangle(0.0, 0.0, width, height), obstacles, border=border)


def to(
    x: float, y: float, theta: float = EAST, service: float = 0.0, load: str | None = None
) -> Visit:
    """A visit; its task is named after its place."""
    return Visit(f"{x:g}/{y:g}", Pose(x, y, theta), service, load)


def team(site: Site, *members, **more) -> Problem:
    """Pose a problem; a member is (type, start, visits ...), and robots are a, b, c, ..."""
    robots, tours = [], {}
    for name, (robot_type, start, *visits) in zip("abcdefghijkl", members, strict=False):
        robots.append(Robot(name, robot_type.name, Pose(*start)))
        if visits:
            # Robots that go to the same place have tasks of their own.
            tours[name] = tuple(replace(v, task=f"{name} {v.task}") for v in visits)
    types = {member[0].name: member[0] for member in members}
    return Problem(site, types, tuple(robots), tours, **more)


def record(problem: Problem, plan: Plan) -> PlanRecord:
    """The plan as its file would hold it."""
    scenario = Scenario("room", problem.site, problem.robot_types, problem.robots, ())
    return record_plan(scenario, plan, seed=0, version="")


def judged(problem: Problem, plan: Plan) -> list[Violation]:
    """What the judge finds wrong with a plan."""
    return validate_plan(record(problem, plan))


def swapping_corridor() -> Problem:
    """Two carriers that must change ends in a corridor of one lane, without a siding."""
    return team(
        room(30.0, 3.0),
        (CARRIER, (2.0, 1.5, EAST), to(28.0, 1.5)),
        (CARRIER, (28.0, 1.5, EAST), to(2.0, 1.5)),
    )
