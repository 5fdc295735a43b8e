"""Samples of a trajectory, as plan files hold them."""

import math

import numpy as np
from numpy.typing import NDArray

from clearway.model import TICKS_PER_SECOND, Piece, Pose, Track, Trajectory

LONGEST_STEP_TICKS = TICKS_PER_SECOND // 10
CHORD_ERROR = 0.2e-3
LARGEST_TURN = 3.0
STANDING = "stop"

Rows = NDArray[np.float64]


def sample(trajectory: Trajectory, modes: bool) -> Track:
    """Turn pieces and timing into samples.

    Moving steps last at most 0.1 s, chords stray from arcs by at most 0.2 mm, and the ends
    of pieces and of rests are samples. Where one piece does not begin at the pose where the
    one before ended (a heading that jumps), both poses are kept at the same time.

    Parameters
    ----------
    modes
        Whether the robot has motion modes; if not, every mode is ``None``.
    """
    rows: list[Rows] = []
    names: list[str | None] = []
    tick, pose = 0, trajectory.start

    def stand(at: int, mode: str | None) -> None:
        rows.append(np.array([[at / TICKS_PER_SECOND, *pose]]))
        names.append(mode)

    for piece, (first, last) in zip(trajectory.pieces, trajectory.timing, strict=True):
        jumps = _differ(pose, piece.start)
        if first > tick:
            stand(tick, STANDING)
        if jumps:
            stand(first, STANDING)
        part = _moving(piece, first, last)
        rows.append(part)
        names.extend([_mode(piece)] * len(part))
        tick, pose = last, piece.end
    stand(tick, STANDING)
    table = np.concatenate(rows)
    t = np.round(table[:, 0], 6)
    x, y, theta = (np.round(table[:, k], 9) + 0.0 for k in (1, 2, 3))
    return Track(t, x, y, theta, tuple(names) if modes else (None,) * len(names))


def _mode(piece: Piece) -> str | None:
    return piece.mode if any(piece.twist) else STANDING


def _differ(one: Pose, other: Pose) -> bool:
    turn = math.remainder(one.theta - other.theta, 2.0 * math.pi)
    return max(abs(one.x - other.x), abs(one.y - other.y), abs(turn)) > 1e-6


def _moving(piece: Piece, first: int, last: int) -> Rows:
    """Return rows ``t x y theta`` of a piece, its end excluded."""
    turn = abs(piece.twist[2])
    # The sagitta of a chord is turn * length / 8 and falls with the square of their number.
    count = max(
        math.ceil((last - first) / LONGEST_STEP_TICKS),
        math.ceil(math.sqrt(turn * piece.length / (8.0 * CHORD_ERROR))),
        math.floor(turn / LARGEST_TURN) + 1,
    )
    if not any(piece.twist):
        count = 1
    progress = np.arange(count) / count
    rows = np.empty((count, 4))
    rows[:, 0] = (first + progress * (last - first)) / TICKS_PER_SECOND
    a, b, c = (progress * value for value in piece.twist)
    # exp of the twist: sin(c)/c and (1 - cos(c))/c, written so that c = 0 needs no case.
    along = np.sinc(c / np.pi)
    across = np.sin(0.5 * c) * np.sinc(0.5 * c / np.pi)
    dx, dy = a * along - b * across, a * across + b * along
    cos, sin = math.cos(piece.start.theta), math.sin(piece.start.theta)
    rows[:, 1] = piece.start.x + cos * dx - sin * dy
    rows[:, 2] = piece.start.y + sin * dx + cos * dy
    rows[:, 3] = -np.remainder(np.pi - (piece.start.theta + c), 2.0 * np.pi) + np.pi
    return rows
