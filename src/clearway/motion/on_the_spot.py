"""Turning on the spot, for the models of robots that can."""

import math

from clearway.motion.model import Mode, Motion

LEFT, RIGHT = "rotate-left", "rotate-right"


def on_the_spot(yaw_rate: float, headings: int) -> tuple[tuple[Mode, ...], tuple[Motion, ...]]:
    """Return the modes that turn at ``yaw_rate`` (rad/s), and motions of one heading each."""
    step = 2.0 * math.pi / headings
    sides = ((LEFT, 1), (RIGHT, -1))
    modes = tuple(Mode(name, None, side, yaw_rate) for name, side in sides)
    motions = tuple(
        Motion(name, (0.0, 0.0, side * step), side, step / yaw_rate) for name, side in sides
    )
    return modes, motions
