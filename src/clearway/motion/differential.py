"""The differential drive: two driven wheels, the reference point is the middle between them."""

from dataclasses import replace

from clearway.model import RobotType
from clearway.motion.car import AHEAD, car
from clearway.motion.model import Curve, MotionModel
from clearway.motion.on_the_spot import LEFT, RIGHT, on_the_spot


def differential(robot_type: RobotType, headings: int = 16) -> MotionModel:
    """Return the motion model of a differential drive: what a car does, and turns on the spot.

    Its arcs are the tightest at top speed, but from half the body's length to all of it, so
    that steps suit the body. Absent, the yaw rate is that of top speed round half the body's
    length. A turning radius rules out turning on the spot and leaves a car.
    """
    limits, length = robot_type.limits, robot_type.footprint.length
    if limits.turning_radius is not None:
        return car(robot_type, headings)
    yaw_rate = limits.yaw_rate or limits.speed / (length / 2.0)
    radius = min(max(limits.speed / yaw_rate, length / 2.0), length)
    steered = replace(limits, yaw_rate=yaw_rate, turning_radius=radius)
    base = car(replace(robot_type, limits=steered), headings)
    modes, motions = on_the_spot(yaw_rate, headings)
    (curve,) = base.curves
    straight = Curve(
        "turn_drive_turn",
        AHEAD,
        0.0,
        (curve.ahead[0], None, None),
        (curve.back[0], None, None),
        (LEFT, RIGHT),
    )
    return replace(
        base,
        modes=base.modes + modes,
        motions=base.motions + motions,
        curves=(curve, straight),
    )
