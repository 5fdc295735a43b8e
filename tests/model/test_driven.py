"""Pieces of motion joined to one track."""

import numpy as np
import pytest

from clearway.model import Footprint, Limits, Pose, Robot, RobotType, Site, Trace, tracks_of

PUCK = RobotType("puck", Footprint(radius=0.3), "holonomic", Limits(speed=1.0))
ROOM = Site(((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)))


def piece(*rows: tuple[float, float], theta: float = 0.0, mode=None):
    t, x = (np.array(column) for column in zip(*rows, strict=True))
    event = {"event": "motion", "robot": "a", "t": t, "x": x, "y": 0 * x, "theta": 0 * x + theta}
    return event if mode is None else {**event, "mode": mode}


def track(*pieces):
    robots = (Robot("a", "puck", Pose(1.0, 0.0, 0.0)), Robot("b", "puck", Pose(5.0, 5.0, 0.5)))
    trace = Trace("s", "", 0, ROOM, {"puck": PUCK}, robots, pieces, False, {})
    tracks = tracks_of(trace)
    assert tracks["b"].t.tolist() == [0.0]
    assert tracks["b"].theta.tolist() == [0.5]
    return tracks["a"]


def test_a_robot_stands_before_and_between_pieces() -> None:
    """From second 0 to 2 at its start, from 3 to 5 where the first piece ended."""
    made = track(piece((2.0, 1.0), (3.0, 2.0)), piece((5.0, 2.0), (6.0, 3.0)))
    assert made.t.tolist() == [0.0, 2.0, 3.0, 5.0, 6.0]
    assert made.x.tolist() == [1.0, 1.0, 2.0, 2.0, 3.0]


def test_pieces_that_follow_at_once_share_a_sample() -> None:
    """The end of one is the beginning of the next, and its mode the next one's."""
    made = track(
        piece((0.0, 1.0), (1.0, 2.0), mode=["forward", "stop"]),
        piece((1.0, 2.0), (2.0, 3.0), mode=["reverse", "stop"]),
    )
    assert made.t.tolist() == [0.0, 1.0, 2.0]
    assert made.mode == ("forward", "reverse", "stop")


@pytest.mark.parametrize("pause", [0.0, 2.0])
def test_a_heading_that_jumps_does_so_when_the_next_piece_begins(pause: float) -> None:
    """Until then the robot stands as it stood."""
    begin = 1.0 + pause
    made = track(piece((0.0, 1.0), (1.0, 2.0)), piece((begin, 2.0), (begin + 1.0, 3.0), theta=1.5))
    at_once = made.t == begin
    assert made.theta[at_once].tolist() == [0.0, 1.5]
    assert len(made.t) == (4 if pause == 0.0 else 5)


def test_a_robot_that_never_moves_stands_at_its_start() -> None:
    """No piece, one sample."""
    made = track()
    assert (made.t.tolist(), made.x.tolist(), made.mode) == ([0.0], [1.0], (None,))
