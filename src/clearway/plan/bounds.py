"""Lower bounds on what any continuous motion of these robots must cost."""

import math
from dataclasses import dataclass

from clearway.model import Pose, Problem, RobotType, wrap


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


def lower_bounds(problem: Problem) -> Bounds:
    """Return bounds that hold for any continuous motion of the robots, each taken alone."""
    seconds, metres = [], []
    for robot in problem.robots:
        robot_type = problem.robot_types[robot.type]
        at = problem.state_of(robot).pose
        visits = problem.tours.get(robot.id, ())
        for i, visit in enumerate(visits):
            distance = at.distance(visit.pose)
            metres.append(distance)
            seconds.append(leg_bound(robot_type, at, visit.pose, distance))
            if i + 1 < len(visits):
                seconds.append(visit.service)
            at = visit.pose
    return Bounds(math.fsum(seconds), math.fsum(metres))
