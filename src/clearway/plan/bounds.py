"""Lower bounds on what any continuous motion of these robots must cost."""

import math
from dataclasses import dataclass

from clearway import _core
from clearway.model import LOAD_CHANGE, Pose, Problem, RobotType, Site, wrap
from clearway.world.obstacles import native_body, native_obstacles


@dataclass(frozen=True)
class Bounds:
    """Bounds on the sum of costs (s) and on the length driven (m)."""

    seconds: float
    metres: float


def leg_bound(robot_type: RobotType, start: Pose, goal: Pose, distance: float) -> float:
    """Return the least time (s) from one pose to another when the way is ``distance`` (m) long."""
    limits = robot_type.limits
    top = max(limits.speed, limits.speed_backwards)
    seconds = distance / top
    if limits.yaw_rate is not None:
        seconds = max(seconds, abs(wrap(goal.theta - start.theta)) / limits.yaw_rate)
    return seconds


class _Ways:
    """Shortest ways of the largest disc about a type's reference point that its body holds."""

    def __init__(self, site: Site) -> None:
        self._site = site
        self._geodesics: dict[tuple[str, bool], _core.Geodesic] = {}

    def __call__(self, robot_type: RobotType, loaded: bool, start: Pose, goal: Pose) -> float:
        key = (robot_type.name, loaded)
        if key not in self._geodesics:
            radius = native_body(robot_type.shape(loaded)).inradius
            obstacles = native_obstacles(self._site, robot_type.name, loaded)
            self._geodesics[key] = _core.Geodesic(obstacles, radius)
        way = self._geodesics[key]((start.x, start.y), (goal.x, goal.y))
        return way if math.isfinite(way) else start.distance(goal)


def lower_bounds(problem: Problem) -> Bounds:
    """Return bounds that hold for any continuous motion of the robots, each taken alone.

    A leg is at least as long as the shortest any-angle way of the disc that the body holds
    about its reference point, and lasts at least that at top speed, or the turn at the
    yaw rate.
    """
    seconds, metres = [], []
    ways = _Ways(problem.site)
    for robot in problem.robots:
        robot_type = problem.robot_types[robot.type]
        state = problem.state_of(robot)
        at, loads = state.pose, int(state.loaded)
        visits = problem.tours.get(robot.id, ())
        for i, visit in enumerate(visits):
            way = ways(robot_type, loads > 0, at, visit.pose)
            metres.append(way)
            seconds.append(leg_bound(robot_type, at, visit.pose, way))
            if i + 1 < len(visits):
                seconds.append(visit.service)
            at = visit.pose
            loads += LOAD_CHANGE[visit.load]
    return Bounds(math.fsum(seconds), math.fsum(metres))
