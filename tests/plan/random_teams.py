"""Small random problems whose starts and final rests are legal; ways there may be none."""

import math
import random
from dataclasses import replace

import shapely
from shapely import affinity
from tests.plan.rooms import (
    CAR,
    CARRIER,
    CART,
    DRUM,
    FLOAT,
    HOOK,
    PIVOT,
    STACKER,
    TRUCK,
    TUG,
    block,
    room,
    team,
    to,
)

from clearway.model import Footprint, Obstacle, Pose, Problem, RobotType

LOADER = replace(
    CARRIER,
    name="loader",
    footprint=Footprint.rectangle(1.5, 1.0),
    loaded_footprint=Footprint.rectangle(1.8, 1.4),
    limits=replace(CARRIER.limits, turning_radius=1.2),
    clearance=0.1,
)
STIFF = replace(CART, name="stiff", mode_switch=0.7)
TYPES = (CART, DRUM, HOOK, CAR, STIFF, LOADER, TRUCK, STACKER, PIVOT, TUG, FLOAT)
HEADINGS = (0.0, math.pi / 2.0, math.pi, -math.pi / 2.0)
TRIES = 400


def body(robot_type: RobotType, pose: Pose, loaded: bool) -> shapely.Geometry:
    """The floor that a robot covers."""
    shape = robot_type.shape(loaded)
    if shape.radius:
        return shapely.Point(pose.x, pose.y).buffer(shape.radius)
    union = shapely.union_all([shapely.Polygon(part) for part in shape.parts])
    turned = affinity.rotate(union, pose.theta, origin=(0.0, 0.0), use_radians=True)
    return affinity.translate(turned, pose.x, pose.y)


def random_obstacle(rng: random.Random, width: float, height: float) -> Obstacle:
    """A disc, a wall, a block or a cup."""
    x, y = rng.uniform(1.0, width - 1.0), rng.uniform(1.0, height - 1.0)
    kind = rng.choice(["disc", "wall", "block", "cup"])
    if kind == "disc":
        return Obstacle(disc=(x, y, rng.uniform(0.2, 1.0)))
    if kind == "wall":
        angle, length = rng.uniform(0.0, math.tau), rng.uniform(0.5, 4.0)
        return Obstacle(wall=((x, y), (x + length * math.cos(angle), y + length * math.sin(angle))))
    if kind == "block":
        return block(x, y, x + rng.uniform(0.3, 2.0), y + rng.uniform(0.3, 2.0))
    s, w = rng.uniform(2.0, 4.0), 0.3
    cup = ((0, 0), (s, 0), (s, s), (s - w, s), (s - w, w), (w, w), (w, s), (0, s))
    return Obstacle(polygon=tuple((x + dx, y + dy) for dx, dy in cup))


def shape_of(obstacle: Obstacle) -> shapely.Geometry:
    """An obstacle as a geometry."""
    if obstacle.disc:
        return shapely.Point(obstacle.disc[:2]).buffer(obstacle.disc[2] + 0.01)
    return shapely.LineString(obstacle.wall) if obstacle.wall else shapely.Polygon(obstacle.polygon)


def random_team(seed: int) -> Problem:
    """Two to four unlike robots with up to three visits each; some pick up and drop."""
    rng = random.Random(seed)
    while True:
        problem = _draw(rng)
        if problem is not None:
            return problem


def _draw(rng: random.Random) -> Problem | None:
    width, height = rng.uniform(8.0, 16.0), rng.uniform(6.0, 14.0)
    obstacles = [random_obstacle(rng, width, height) for _ in range(rng.randrange(4))]
    site = room(width, height, *obstacles, border=rng.choice(["closed", "closed", "open"]))
    inside = shapely.Polygon(site.bounds)
    solid = shapely.union_all([shape_of(obstacle) for obstacle in obstacles])

    def place(kind: RobotType, taken: list[shapely.Geometry], loaded: bool) -> Pose | None:
        for _ in range(TRIES):
            theta = rng.choice([*HEADINGS, rng.uniform(-3.1, 3.1)])
            pose = Pose(rng.uniform(0.3, width - 0.3), rng.uniform(0.3, height - 0.3), theta)
            covered = body(kind, pose, loaded)
            if not inside.contains(covered) or covered.intersects(solid):
                continue
            if all(not covered.intersects(other) for other in taken):
                taken.append(covered)
                return pose
        return None

    starts: list[shapely.Geometry] = []
    rests: list[shapely.Geometry] = []
    members = []
    for _ in range(rng.randrange(2, 5)):
        kind = rng.choice(TYPES)
        count = rng.choice([0, 1, 1, 2, 3])
        carries = count > 1 and rng.random() < 0.3
        start = place(kind, starts, False)
        poses = [place(kind, rests if j == count - 1 else [], carries) for j in range(count)]
        if start is None or None in poses:
            return None
        if not count and any(body(kind, start, False).intersects(rest) for rest in rests):
            return None
        if not count:
            rests.append(body(kind, start, False))
        loads = {0: "pick", count - 1: "drop"} if carries else {}
        visits = [
            to(*pose, rng.choice([0.0, 0.0, 2.5]), loads.get(j)) for j, pose in enumerate(poses)
        ]
        members.append((kind, start, *visits))
    return team(site, *members)
