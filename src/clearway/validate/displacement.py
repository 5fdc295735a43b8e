"""What each step of a track does, seen from the body."""

from typing import NamedTuple

import numpy as np

from clearway.model import Track
from clearway.validate.steps import Floats, wrapped


class Displacement(NamedTuple):
    """Changes from sample to sample, shape ``(num_samples - 1,)`` each.

    ``along`` and ``across`` are the way (m) in the body frame at the middle of the step,
    ``length`` its size, ``turn`` the change of heading (rad), ``dt`` the time (s).
    """

    dt: Floats
    along: Floats
    across: Floats
    length: Floats
    turn: Floats


def displacement_of(track: Track) -> Displacement:
    """Return what each step of a track does."""
    dx, dy = np.diff(track.x), np.diff(track.y)
    turn = wrapped(np.diff(track.theta))
    middle = track.theta[:-1] + 0.5 * turn
    cos, sin = np.cos(middle), np.sin(middle)
    along, across = cos * dx + sin * dy, cos * dy - sin * dx
    return Displacement(np.diff(track.t), along, across, np.hypot(dx, dy), turn)
