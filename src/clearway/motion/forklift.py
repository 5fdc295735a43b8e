"""The forklift: rear wheels steer, the reference point is the middle of the unsteered front axle.

Its forks lie at -x, so that it drives up to a load in reverse. The rear wheels may steer so far
that the robot pivots about the middle of its unsteered axle.
"""

from dataclasses import replace

from clearway.model import RobotType
from clearway.motion.differential import differential
from clearway.motion.model import Motion, MotionModel

WIDER = 2.0  # radius of its wide arcs, in least radii


def forklift(robot_type: RobotType, headings: int = 16) -> MotionModel:
    """Return the motion model of a forklift: a car's, with wider arcs as well, and pivots.

    On a wide arc the yaw rate binds less, so that it is driven faster than the tightest one.
    Only without a turning radius it pivots on the spot.
    """
    limits = robot_type.limits
    base = differential(robot_type, headings)
    (radius,) = (curve.radius for curve in base.curves if curve.family == "reeds_shepp")
    modes = {mode.name: mode for mode in base.modes}
    wide = []
    for tight in base.motions:
        ahead, _, turn = tight.twist
        if not ahead or not turn:
            continue
        top = limits.speed if ahead > 0.0 else limits.speed_backwards
        speed = min(top, base.yaw_rate * WIDER * radius)
        modes[tight.mode] = replace(modes[tight.mode], speed=speed)
        twist = (WIDER * ahead, 0.0, turn)
        wide.append(Motion(tight.mode, twist, tight.turn_steps, abs(twist[0]) / speed))
    return replace(base, modes=tuple(modes.values()), motions=(*base.motions, *wide))
