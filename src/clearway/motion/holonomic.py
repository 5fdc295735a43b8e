"""The holonomic robot: it drives off in any direction at once, turned as it is."""

import math
from dataclasses import replace

from clearway.model import RobotType
from clearway.motion.car import car
from clearway.motion.model import Curve, Mode, Motion, MotionModel
from clearway.motion.on_the_spot import LEFT, RIGHT, on_the_spot

COURSES = 16  # body-frame directions of the table's motions


def holonomic(robot_type: RobotType, headings: int = 16) -> MotionModel:
    """Return the motion model of a holonomic robot: sixteen courses, and turns on the spot.

    A step is as long as the arc of one heading round the body's length, or the turning radius.
    Where a speed in reverse is given, it bounds the part of the velocity that goes backwards.
    With a turning radius the robot cannot turn on the spot, and turns as a car does.
    """
    limits = robot_type.limits
    # What it does backwards is bound by its speed as well.
    slower = replace(limits, reverse_speed=min(limits.speed, limits.speed_backwards))
    turning = car(replace(robot_type, limits=slower), headings)
    drive = Mode("drive", "any", 0, limits.speed, backwards=limits.reverse_speed)
    modes, motions, curves = turning.modes, turning.motions, turning.curves
    if limits.turning_radius is None:
        modes, motions = on_the_spot(turning.yaw_rate, headings)
        none = (None, None, None)
        curves = (Curve("translate", 0.0, 0.0, (drive.name, None, None), none, (LEFT, RIGHT)),)
    length = 2.0 * math.pi / headings * (limits.turning_radius or robot_type.footprint.length)
    courses = [2.0 * math.pi * k / COURSES for k in range(COURSES)]
    return MotionModel(
        headings=headings,
        modes=(drive, *modes),
        motions=(
            *(
                Motion(
                    drive.name,
                    (length * math.cos(course), length * math.sin(course), 0.0),
                    0,
                    length / drive.speed_towards(course),
                )
                for course in courses
                if drive.speed_towards(course) > 0.0
            ),
            *motions,
        ),
        curves=curves,
        yaw_rate=turning.yaw_rate,
        turn_arm=turning.turn_arm,
        mode_switch=robot_type.mode_switch,
    )
