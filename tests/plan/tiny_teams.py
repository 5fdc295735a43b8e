"""Tiny random problems whose joint lattices brute force can search: sites of a few steps."""

import itertools
import math
import random

from tests.plan.random_teams import body
from tests.plan.rooms import block, room, team, to

from clearway.model import Footprint, Limits, Pose, Problem, RobotType

STEP = 0.7  # between neighbouring poses (m)
BORDER = 0.75  # from the outer ones to the site's bounds
BLOCK = 0.26  # half the side of an obstacle
STRAIGHT = ("stop", "forward", "reverse")
SPIN = (*STRAIGHT, "rotate-left", "rotate-right")
SIDEWAYS = ("lateral-left", "lateral-right")
ARCS = ("forward-left", "forward-right", "reverse-left", "reverse-right")


def kind(name: str, modes: tuple[str, ...], length=1.0, width=0.5, speed=0.7, **more) -> RobotType:
    """A robot whose steps and arcs fit the grid."""
    limits = Limits(speed=speed, yaw_rate=math.pi / 2.0, turning_radius=STEP)
    return RobotType(
        name, Footprint.rectangle(length, width), "four_wheel", limits, modes=modes, **more
    )


SHUTTLE = kind("shuttle", STRAIGHT)
SPINNER = kind("spinner", SPIN)
CRAB = kind("crab", (*SPIN, *SIDEWAYS))
CAR = kind("car", (*STRAIGHT, *ARCS))
SLOW = kind("slow", (*STRAIGHT, *SIDEWAYS), speed=0.4)
STIFF = kind("stiff", SPIN, mode_switch=0.7)
WIDE = kind("wide", SPIN, length=1.2, width=0.8)
PUCK = RobotType(
    "puck",
    Footprint(radius=0.3),
    "four_wheel",
    Limits(speed=0.8, yaw_rate=math.pi / 2.0, turning_radius=0.7),
    modes=(*STRAIGHT, *SIDEWAYS),
)
TYPES = (SHUTTLE, SPINNER, CRAB, CAR, SLOW, STIFF, WIDE, PUCK)
TURNING = (SPINNER, CRAB, CAR, STIFF, WIDE)


def tiny_team(seed: int) -> Problem:
    """Two robots, or three, among at most two blocks; nothing says that a plan exists."""
    rng = random.Random(seed)
    while True:
        problem = _draw(rng)
        ends = [[robot.start for robot in problem.robots]]
        ends.append([problem.tours[robot.id][-1].pose for robot in problem.robots])
        types = [problem.robot_types[robot.type] for robot in problem.robots]
        if all(_apart(types, poses) for poses in ends):
            return problem


def _apart(types: list[RobotType], poses: list[Pose]) -> bool:
    bodies = [body(t, pose, False) for t, pose in zip(types, poses, strict=True)]
    return all(a.distance(b) > 0.03 for a, b in itertools.combinations(bodies, 2))


def _draw(rng: random.Random) -> Problem:
    columns, rows = rng.randint(3, 6), rng.choice((1, 2, 2, 3))
    places = [(i, j) for i in range(columns) for j in range(rows)]
    rng.shuffle(places)

    def at(place: tuple[int, int]) -> tuple[float, float]:
        return (STEP * place[0] + BORDER, STEP * place[1] + BORDER)

    blocks = []
    for _ in range(rng.randint(0, 2) if rows > 1 else 0):
        x, y = at(places.pop())
        blocks.append(block(x - BLOCK, y - BLOCK, x + BLOCK, y + BLOCK))
    num_robots = 3 if rng.random() < 0.2 else 2
    starts = [rng.choice(places) for _ in range(num_robots)]
    # Often each is to end where the next one starts.
    ends = [*starts[1:], starts[0]] if rng.random() < 0.6 else rng.choices(places, k=num_robots)
    members = []
    for start, end in zip(starts, ends, strict=True):
        robot_type = rng.choice(TYPES)
        headings = (0.0, math.pi) if robot_type in TURNING else (0.0,)
        if robot_type in TURNING and rows > 1:
            headings = (*headings, math.pi / 2.0, -math.pi / 2.0)
        goals = [end] if rng.random() < 0.75 else [rng.choice(places), end]
        visits = [
            to(*at(goal), rng.choice(headings), rng.choice((0.0, 0.0, 0.8, 2.0))) for goal in goals
        ]
        members.append((robot_type, (*at(start), rng.choice(headings)), *visits))
    width, height = (STEP * (n - 1) + 2.0 * BORDER for n in (columns, rows))
    return team(room(width, height, *blocks), *members)
