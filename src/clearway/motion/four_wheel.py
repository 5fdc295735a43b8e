"""The four-wheel-independent-drive/steering (4WIDS) robot with its 11 motion modes.

Zhang et al., "An Enhanced Hybrid Metaheuristic for Hierarchical Scheduling in 4WIDS
Multi-robot Systems under Confined Environments", Sec. 2.1: the Ackermann family extended by
rotation and lateral motion. The mode list is our reading, the paper's Fig. 1 does not survive.
"""

import math

from clearway.model import FOUR_WHEEL_MODES, RobotType
from clearway.motion.model import Curve, Mode, Motion, MotionModel

AHEAD, BACK, LEFT, RIGHT = 0.0, math.pi, math.pi / 2.0, -math.pi / 2.0

# name, direction of travel in the body frame, side of the turn's centre
MODES: tuple[tuple[str, float | None, int], ...] = (
    ("stop", None, 0),
    ("forward", AHEAD, 0),
    ("reverse", BACK, 0),
    ("forward-left", AHEAD, 1),
    ("forward-right", AHEAD, -1),
    ("reverse-left", BACK, 1),
    ("reverse-right", BACK, -1),
    ("lateral-left", LEFT, 0),
    ("lateral-right", RIGHT, 0),
    ("rotate-left", None, 1),
    ("rotate-right", None, -1),
)


def four_wheel(robot_type: RobotType, headings: int = 16) -> MotionModel:
    """Return the motion model of a 4WIDS robot type.

    On an arc of the least radius R the speed is ``min(top speed, yaw rate x R)``; straight
    motions are as long as that arc over one heading step, so that one cell holds one step.
    """
    limits = robot_type.limits
    radius = limits.turning_radius or 0.0
    yaw_rate = limits.yaw_rate if limits.yaw_rate is not None else limits.speed / max(radius, 1.0)
    allowed = set(robot_type.modes or FOUR_WHEEL_MODES)
    if limits.speed_backwards == 0.0:
        allowed -= {"reverse", "reverse-left", "reverse-right"}
    step = 2.0 * math.pi / headings
    length = step * max(radius, robot_type.footprint.length / 2.0)

    def speed(direction: float | None, turn: int) -> float:
        if direction is None:
            return yaw_rate if turn else 0.0
        top = limits.speed_backwards if direction == BACK else limits.speed
        return min(top, yaw_rate * radius) if turn else top

    modes = tuple(
        Mode(name, direction, turn, speed(direction, turn))
        for name, direction, turn in MODES
        if (name in allowed or name == "stop")
        and not (direction is not None and turn and not radius)
    )
    motions = []
    for mode in modes:
        if isinstance(mode.direction, float):
            # Backwards round a centre on the left the heading falls.
            steps = mode.turn * (-1 if mode.direction == BACK else 1)
            twist = (length * math.cos(mode.direction), length * math.sin(mode.direction))
            motions.append(Motion(mode.name, (*twist, steps * step), steps, length / mode.speed))
        elif mode.turn:
            motions.append(
                Motion(mode.name, (0.0, 0.0, mode.turn * step), mode.turn, step / mode.speed)
            )

    def use(name: str) -> str | None:
        return name if name in allowed else None

    ahead = (use("forward"), use("forward-left"), use("forward-right"))
    back = (use("reverse"), use("reverse-left"), use("reverse-right"))
    left, right = use("lateral-left"), use("lateral-right")
    spin = (use("rotate-left"), use("rotate-right"))
    curves = []
    if radius > 0.0:
        curves.append(Curve("reeds_shepp", AHEAD, radius, ahead, back))
        if left and right:  # the same curves in a body frame turned by 90 degrees
            curves.append(Curve("reeds_shepp", LEFT, radius, (left,) * 3, (right,) * 3))
    if all(spin):
        straight = ((ahead[0], None, None), (back[0], None, None))
        curves.append(Curve("turn_drive_turn", AHEAD, 0.0, *straight, spin))
        if left and right:
            sideways = ((left, None, None), (right, None, None))
            curves.append(Curve("turn_drive_turn", LEFT, 0.0, *sideways, spin))
            if ahead[0] and back[0]:
                curves.append(Curve("slide", AHEAD, 0.0, *straight, spin, (left, right)))
    return MotionModel(
        headings=headings,
        modes=modes,
        motions=tuple(motions),
        curves=tuple(curves),
        yaw_rate=yaw_rate,
        turn_arm=robot_type.footprint.length / 2.0,
        mode_switch=robot_type.mode_switch,
        has_modes=True,
    )
