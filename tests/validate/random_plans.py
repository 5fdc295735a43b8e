"""Right plans by construction, at random: what mutation tests begin with.

Robots of all kinematics, each in a cell of its own, drive legs at exactly their limits and
stand at visits. Obstacles lie outside of what the bodies sweep, which Shapely confirms on
dense samples.
"""

import math
from dataclasses import replace
from types import ModuleType

import numpy as np
import shapely
from shapely import affinity

from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    PlanRecord,
    Pose,
    RobotType,
    Site,
    Visit,
)

CELL = 12.0
L_SHAPE = Footprint(
    parts=(
        ((1.0, 0.5), (-1.0, 0.5), (-1.0, 0.0), (1.0, 0.0)),
        ((0.0, 0.0), (-1.0, 0.0), (-1.0, -0.5), (0.0, -0.5)),
    )
)
TYPES = {
    "car": RobotType(
        "car",
        Footprint.rectangle(2.0, 1.0, rear=0.5),
        "ackermann",
        Limits(speed=1.5, reverse_speed=0.75, turning_radius=1.5),
    ),
    "crab": RobotType(
        "crab",
        Footprint.rectangle(1.6, 1.0),
        "four_wheel",
        Limits(speed=1.0, yaw_rate=1.0 / 1.5, turning_radius=1.5),
    ),
    "cart": RobotType("cart", L_SHAPE, "differential", Limits(speed=1.0, yaw_rate=0.8)),
    "float": RobotType(
        "float", Footprint.rectangle(1.2, 0.8), "holonomic", Limits(speed=1.0, yaw_rate=0.5)
    ),
}


def random_leg(rng: np.random.Generator, kind: RobotType):
    """A leg at the limit: (mode, twist, seconds)."""
    length = float(rng.uniform(0.4, 2.5))
    limits = kind.limits
    if kind.name == "car":
        sign = float(rng.choice([-1, 1]))
        speed = limits.speed if sign > 0 else limits.reverse_speed
        curvature = float(rng.choice([-1, 0, 1])) / limits.turning_radius
        return None, (sign * length, 0.0, sign * length * curvature), length / speed
    if kind.name == "crab":
        family = rng.choice(["forward", "reverse", "lateral", "rotate"])
        left = float(rng.choice([-1, 1]))
        side = "left" if left > 0 else "right"
        if family == "rotate":
            return f"rotate-{side}", (0.0, 0.0, left * length / 2), length / 2 / limits.yaw_rate
        turn = left * length / limits.turning_radius
        if family == "lateral":
            return f"lateral-{side}", (0.0, left * length, float(rng.choice([0, turn]))), length
        along = length if family == "forward" else -length
        if rng.random() < 0.5:
            return str(family), (along, 0.0, 0.0), length
        return f"{family}-{side}", (along, 0.0, math.copysign(turn, along * left)), length
    if kind.name == "cart":
        if rng.random() < 0.5:
            turn = float(rng.uniform(-2.0, 2.0))
            return None, (0.0, 0.0, turn), abs(turn) / limits.yaw_rate
        return None, (float(rng.choice([-1, 1])) * length, 0.0, 0.0), length
    angle = float(rng.uniform(-math.pi, math.pi))
    turn = limits.yaw_rate * length * float(rng.choice([-1, 1]))
    return None, (length * math.cos(angle), length * math.sin(angle), turn), length


def body(kind: RobotType, pose: Pose) -> shapely.Geometry:
    parts = [shapely.Polygon(part) for part in kind.footprint.parts]
    shape = shapely.union_all(parts) if parts else shapely.Point(0, 0).buffer(kind.footprint.radius)
    turned = affinity.rotate(shape, pose.theta, origin=(0, 0), use_radians=True)
    return affinity.translate(turned, pose.x, pose.y)


class Case:
    """A right plan, with the legs it was made of."""

    types = TYPES
    width = 2 * CELL

    def __init__(self, seed: int, by_hand: ModuleType) -> None:
        self.rng = np.random.default_rng(seed)
        self.by_hand = by_hand
        self.legs, journeys, tours = {}, [], {}
        for k, kind in enumerate(TYPES.values()):
            centre = (CELL * (k % 2 + 0.5), CELL * (k // 2 + 0.5))
            start = Pose(*centre, float(self.rng.uniform(-3, 3)))
            legs, visits = self._drive(kind, start, centre)
            self.legs[kind.name] = legs
            journeys.append(by_hand.journey(kind.name, start, *legs))
            tours[kind.name] = visits
        self.journeys = {j.robot: j for j in journeys}
        side = 2 * CELL
        empty = Site(((0, 0), (side, 0), (side, side), (0, side)))
        free = by_hand.plan(list(TYPES.values()), journeys, tours, site=empty)
        self.record = replace(free, site=replace(empty, obstacles=self._scatter(journeys)))

    def _drive(self, kind, start, centre):
        legs, pose, visits = [], start, []
        while len(visits) < 3:
            leg = random_leg(self.rng, kind)
            ends = [self.by_hand.journey("-", pose, leg).pieces[0].at(s) for s in (0.5, 1.0)]
            room = 0.5 * CELL - kind.footprint.circumradius - 0.1
            if any(max(abs(p.x - centre[0]), abs(p.y - centre[1])) > room for p in ends):
                continue
            legs.append(leg)
            pose = ends[-1]
            if self.rng.random() < 0.4:
                service = float(self.rng.integers(1, 4))
                legs.append(service)
                visits.append(Visit(f"{kind.name}{len(visits)}", pose, service))
        return legs, tuple(visits)

    def _scatter(self, journeys) -> tuple[Obstacle, ...]:
        swept = []
        for journey in journeys:
            kind = TYPES[journey.robot]
            poses = [p.at(s) for p in journey.pieces for s in np.linspace(0, 1, 40)]
            swept.append(shapely.union_all([body(kind, p) for p in poses]))
        taken = shapely.union_all(swept).buffer(0.05)
        obstacles = []
        while len(obstacles) < 12:
            x, y = self.rng.uniform(0.5, 2 * CELL - 0.5, 2)
            size = float(self.rng.uniform(0.1, 0.5))
            shapes = (
                Obstacle(disc=(x, y, size)),
                Obstacle(wall=((x, y), (x + size, y - size))),
                Obstacle(polygon=((x, y), (x + size, y), (x + size, y + size), (x, y + size))),
                Obstacle(
                    polygon=((x, y), (x + size, y), (x + size / 3, y + size / 3), (x, y + size))
                ),
            )
            shape = shapes[len(obstacles) % 4]
            area = (
                shapely.Point(x, y).buffer(size)
                if shape.disc
                else shapely.LineString(shape.wall)
                if shape.wall
                else shapely.Polygon(shape.polygon)
            )
            if not area.intersects(taken):
                obstacles.append(shape)
        return tuple(obstacles)

    def body(self, name: str, pose: Pose) -> shapely.Geometry:
        return body(TYPES[name], pose)

    def moment(self, name: str) -> tuple[float, Pose]:
        """A time (s) at which the robot is at a pose that its samples hold or pass."""
        track = self.record.tracks[name]
        i = int(self.rng.integers(len(track.t) - 1))
        share = float(self.rng.choice([0.0, 0.5]))
        turn = math.remainder(track.theta[i + 1] - track.theta[i], 2 * math.pi)
        pose = Pose(
            float(track.x[i] + share * (track.x[i + 1] - track.x[i])),
            float(track.y[i] + share * (track.y[i + 1] - track.y[i])),
            float(track.theta[i] + share * turn),
        )
        return float(track.t[i] + share * (track.t[i + 1] - track.t[i])), pose

    def side(self, name: str, pose: Pose) -> tuple[np.ndarray, np.ndarray]:
        """The middle of a side of the body's hull, and the direction out of it."""
        hull = shapely.convex_hull(body(TYPES[name], pose))
        corners = np.array(shapely.orient_polygons(hull).exterior.coords)
        length = np.hypot(*np.diff(corners, axis=0).T)
        # The slanting side of the L's hull is not a side of the L.
        wide = [k for k in range(len(length)) if round(length[k], 6) != round(math.sqrt(1.25), 6)]
        k = int(self.rng.choice(wide))
        edge = (corners[k + 1] - corners[k]) / length[k]
        return 0.5 * (corners[k] + corners[k + 1]), np.array([edge[1], -edge[0]])

    def with_obstacle(self, obstacle: Obstacle) -> PlanRecord:
        site = self.record.site
        return replace(self.record, site=replace(site, obstacles=(*site.obstacles, obstacle)))

    def with_type(self, kind: RobotType) -> PlanRecord:
        types = {**self.record.robot_types, kind.name: kind}
        return replace(self.record, robot_types=types)

    def with_track(self, name: str, **arrays) -> PlanRecord:
        track = replace(self.record.tracks[name], **arrays)
        return replace(self.record, tracks={**self.record.tracks, name: track})
