"""Lower bounds on what any continuous motion of these robots must cost."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from clearway import _core
from clearway.model import LOAD_CHANGE, Pose, Problem, RobotType, Site, wrap
from clearway.world.obstacles import native_body, native_obstacles


@dataclass(frozen=True)
class Bounds:
    """Bounds on each robot's last arrival (s) and on the length it drives (m), by robot id."""

    arrival: Mapping[str, float]
    length: Mapping[str, float]

    @property
    def seconds(self) -> float:
        """Bound on the sum of costs (s), rounded down."""
        return math.floor(1e6 * math.fsum(self.arrival.values())) / 1e6

    @property
    def metres(self) -> float:
        """Bound on the length that all drive (m), rounded down."""
        return math.floor(1e6 * math.fsum(self.length.values())) / 1e6


def curve_bound(robot_type: RobotType, start: Pose, goal: Pose) -> float:
    """Return the length (m) of the shortest curve that a car-like robot can drive in the open.

    Reeds and Shepp (1990); a robot that may not reverse drives no shorter one.
    """
    radius = robot_type.limits.turning_radius
    if robot_type.kinematics != "ackermann" or radius is None:
        return start.distance(goal)
    c, s = math.cos(start.theta), math.sin(start.theta)
    dx, dy = (goal.x - start.x) / radius, (goal.y - start.y) / radius
    return radius * _core.reeds_shepp_length(
        c * dx + s * dy, -s * dx + c * dy, wrap(goal.theta - start.theta)
    )


def leg_bound(robot_type: RobotType, start: Pose, goal: Pose, distance: float) -> float:
    """Return the least time (s) from one pose to another when the way is ``distance`` (m) long."""
    limits = robot_type.limits
    top = max(limits.speed, limits.speed_backwards)
    seconds = distance / top
    if limits.yaw_rate is not None:
        seconds = max(seconds, abs(wrap(goal.theta - start.theta)) / limits.yaw_rate)
    return seconds


class Leg(NamedTuple):
    """What driving from one pose to another takes at least (s) and how long it is (m)."""

    seconds: float
    metres: float


class LegBounds:
    """Bounds on single legs, each robot taken alone.

    A leg is at least as long as the shortest any-angle way of the largest disc about the type's
    reference point that its body holds, and as the shortest curve of bounded curvature in the
    open; it lasts at least that at top speed, or the turn at the yaw rate.
    """

    def __init__(self, site: Site) -> None:
        self._site = site
        self._geodesics: dict[tuple[str, bool], _core.Geodesic] = {}

    def __call__(self, robot_type: RobotType, loaded: bool, start: Pose, goal: Pose) -> Leg:
        """Return the bounds of a robot's leg with or without load."""
        way = max(self._way(robot_type, loaded, start, goal), curve_bound(robot_type, start, goal))
        return Leg(leg_bound(robot_type, start, goal, way), way)

    def _way(self, robot_type: RobotType, loaded: bool, start: Pose, goal: Pose) -> float:
        key = (robot_type.name, loaded)
        if key not in self._geodesics:
            radius = native_body(robot_type.shape(loaded)).inradius
            obstacles = native_obstacles(self._site, robot_type.name, loaded)
            self._geodesics[key] = _core.Geodesic(obstacles, radius)
        way = self._geodesics[key]((start.x, start.y), (goal.x, goal.y))
        return way if math.isfinite(way) else start.distance(goal)


def tour_bounds(problem: Problem) -> dict[str, tuple[Leg, ...]]:
    """Return the bounds of each leg of each robot's tour, by robot id."""
    bounds = LegBounds(problem.site)
    tours: dict[str, tuple[Leg, ...]] = {}
    for robot in problem.robots:
        robot_type = problem.robot_types[robot.type]
        state = problem.state_of(robot)
        at, loads = state.pose, int(state.loaded)
        legs = []
        for visit in problem.tours.get(robot.id, ()):
            legs.append(bounds(robot_type, loads > 0, at, visit.pose))
            at = visit.pose
            loads += LOAD_CHANGE[visit.load]
        tours[robot.id] = tuple(legs)
    return tours


def lower_bounds(problem: Problem) -> Bounds:
    """Return bounds that hold for any continuous motion of the robots, each taken alone.

    Services are made, and none begins before it may.
    """
    arrival, length = {}, {}
    for robot, legs in tour_bounds(problem).items():
        visits = problem.tours.get(robot, ())
        seconds, arrival[robot] = [0.0], 0.0
        for visit, leg in zip(visits, legs, strict=True):
            seconds.append(leg.seconds)
            if leg.seconds > 0.0:  # who is there already rests there already
                arrival[robot] = math.fsum(seconds)
            if math.fsum(seconds) < visit.not_before:
                seconds = [visit.not_before]
            seconds.append(visit.service)
        length[robot] = math.fsum(leg.metres for leg in legs)
    return Bounds(arrival, length)
