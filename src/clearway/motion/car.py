"""The car: front wheels steer, the reference point is the middle of the unsteered axle.

Reeds and Shepp, "Optimal paths for a car that goes both forwards and backwards", Pacific J.
Math. 145 (1990): shortest curves consist of straights and arcs of the least radius, so that
these are the table's motions.
"""

import math

from clearway.model import RobotType
from clearway.motion.model import Curve, Mode, Motion, MotionModel

AHEAD, BACK = 0.0, math.pi


def car(robot_type: RobotType, headings: int = 16) -> MotionModel:
    """Return the motion model of a car: straights and arcs of the least radius, both ways.

    On an arc the speed is ``min(top speed, yaw rate x radius)``. A straight is as long as the
    arc over one heading step, so that one cell holds one step. Without a turning radius half
    the body's length is taken.
    """
    limits = robot_type.limits
    radius = limits.turning_radius or robot_type.footprint.length / 2.0
    yaw_rate = limits.yaw_rate or max(limits.speed, limits.speed_backwards) / radius
    step = 2.0 * math.pi / headings
    length = step * radius
    modes, motions = [], []
    for course, direction, top in (
        ("forward", AHEAD, limits.speed),
        ("reverse", BACK, limits.speed_backwards),
    ):
        if top <= 0.0:
            continue
        ahead = length if direction == AHEAD else -length
        for side, turn in (("", 0), ("-left", 1), ("-right", -1)):
            speed = min(top, yaw_rate * radius) if turn else top
            steps = turn if direction == AHEAD else -turn
            modes.append(Mode(course + side, direction, turn, speed))
            motions.append(Motion(course + side, (ahead, 0.0, steps * step), steps, length / speed))
    names = [mode.name for mode in modes]
    ahead_modes = ("forward", "forward-left", "forward-right")
    back_modes = ("reverse", "reverse-left", "reverse-right")
    return MotionModel(
        headings=headings,
        modes=tuple(modes),
        motions=tuple(motions),
        curves=(
            Curve(
                "reeds_shepp",
                AHEAD,
                radius,
                ahead_modes,
                back_modes if "reverse" in names else (None, None, None),
            ),
        ),
        yaw_rate=yaw_rate,
        turn_arm=robot_type.footprint.length / 2.0,
        mode_switch=robot_type.mode_switch,
    )
