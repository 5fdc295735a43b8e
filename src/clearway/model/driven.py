"""What each robot drove: the pieces of motion of a trace, joined."""

from collections.abc import Mapping
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
    rows = [np.array([[0.0, *robot.start]])]
    modes: list[str | None] = [robot.start_mode]
    for piece in pieces:
        table = np.column_stack([piece[name] for name in SAMPLES])
        last = rows[-1][-1]
        if table[0, 0] > last[0]:
            if np.abs(table[0, 1:] - last[1:]).max() > 0.0:
                rows.append(np.array([[table[0, 0], *last[1:]]]))
                modes.append(modes[-1])
        elif np.array_equal(table[0], last):
            rows[-1] = rows[-1][:-1]
            modes.pop()
        rows.append(table)
        modes += piece.get("mode") or [None] * len(table)
    t, x, y, theta = np.concatenate(rows).T
    return Track(t, x, y, theta, tuple(modes))
