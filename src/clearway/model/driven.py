"""What each robot drove: the pieces of motion of a trace, joined."""

from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np

from clearway.model.record import Track
from clearway.model.robot import Robot
from clearway.model.trace import Trace

SAMPLES = ("t", "x", "y", "theta")


def tracks_of(trace: Trace) -> dict[str, Track]:
    """Return every robot's motion from second 0 to its last sample, standing between pieces.

    Where a piece begins at another pose than the one before ended (a heading that jumps),
    both poses are kept at the time of the second, as in plan files. Nothing is checked:
    pieces that do not join, or overlap in time, show as jumps.
    """
    pieces: dict[str, list[Mapping[str, Any]]] = {robot.id: [] for robot in trace.robots}
    for piece in trace.of("motion"):
        pieces[piece["robot"]].append(piece)
    return {robot.id: _joined(robot, pieces[robot.id]) for robot in trace.robots}


def _joined(robot: Robot, pieces: list[Mapping[str, Any]]) -> Track:
    rows = np.empty((1 + sum(len(piece["t"]) for piece in pieces), 4))
    rows[0] = 0.0, *robot.start
    for column, name in enumerate(SAMPLES):
        rows[1:, column] = np.concatenate([[], *(piece[name] for piece in pieces)])
    first = np.cumsum([1, *(len(piece["t"]) for piece in pieces)], dtype=np.intp)[:-1]
    last = first - 1
    apart = (rows[first, 1:] != rows[last, 1:]).any(axis=1)
    later = rows[first, 0] > rows[last, 0]
    copies = np.ones(len(rows), dtype=np.intp)
    copies[last[~apart & (rows[first, 0] == rows[last, 0])]] = 0
    copies[last[apart & later]] = 2
    index = np.repeat(np.arange(len(rows)), copies)
    t, x, y, theta = rows[index].T.copy()
    held = np.flatnonzero(np.diff(index) == 0) + 1
    t[held] = t[held + 1]
    modes = [robot.start_mode, *chain.from_iterable(_modes(piece) for piece in pieces)]
    return Track(t, x, y, theta, tuple(map(modes.__getitem__, index.tolist())))


def _modes(piece: Mapping[str, Any]) -> Sequence[str | None]:
    return piece.get("mode") or (None,) * len(piece["t"])
