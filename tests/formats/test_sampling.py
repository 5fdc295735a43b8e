"""Samples of trajectories."""

import math

import numpy as np
import pytest

from clearway.formats.sampling import sample
from clearway.model import Piece, Pose, Track, Trajectory

START = Pose(1.0, 2.0, 0.5)


def path(*parts: tuple[str, tuple[float, float, float], int, int]) -> Trajectory:
    pieces, pose = [], START
    for i, (mode, twist, _, _) in enumerate(parts):
        pieces.append(Piece(i, mode, pose, twist))
        pose = pieces[-1].end
    timing = tuple((first, last) for _, _, first, last in parts)
    return Trajectory("a", START, tuple(pieces), timing)


def test_a_robot_that_never_moves_is_one_sample() -> None:
    """It is at its start at t = 0, in the mode stop if it has modes."""
    assert sample(path(), modes=False) == Track(
        np.array([0.0]), np.array([1.0]), np.array([2.0]), np.array([0.5]), (None,)
    )
    assert sample(path(), modes=True).mode == ("stop",)


def test_straight_piece_between_rests() -> None:
    """1 m in 0.25 s after 1 s of rest: steps of 0.25 / 3 s, and the mode of what follows."""
    track = sample(path(("forward", (1.0, 0.0, 0.0), 1000, 1250)), modes=True)
    assert track.t.tolist() == [0.0, 1.0, 1.083333, 1.166667, 1.25]
    assert track.mode == ("stop", "forward", "forward", "forward", "stop")
    assert track.x[-1] == pytest.approx(1.0 + math.cos(0.5), abs=1e-9)
    assert track.y[-1] == pytest.approx(2.0 + math.sin(0.5), abs=1e-9)


def test_a_rest_between_pieces_has_a_sample_at_each_end() -> None:
    """From 0.1 s to 5 s it stands; where pieces follow at once they share a sample."""
    track = sample(
        path(
            ("forward", (0.1, 0.0, 0.0), 0, 100),
            ("forward", (0.1, 0.0, 0.0), 5000, 5100),
            ("reverse", (-0.1, 0.0, 0.0), 5100, 5200),
        ),
        modes=True,
    )
    assert track.t.tolist() == [0.0, 0.1, 5.0, 5.1, 5.2]
    assert track.mode == ("forward", "stop", "forward", "reverse", "stop")


def test_chords_stray_from_the_arc_by_at_most_a_fifth_of_a_millimetre() -> None:
    """Half a turn of radius 1 m: all samples are on the circle, chords 0.2 mm inside.

    The sagitta of n chords is pi * pi / 8 / n^2 <= 0.0002 from n = 79 on.
    """
    track = sample(path(("forward-left", (math.pi, 0.0, math.pi), 0, 3142)), modes=True)
    assert len(track.t) == 80
    centre = np.array([1.0 - math.sin(0.5), 2.0 + math.cos(0.5)])
    points = np.column_stack([track.x, track.y]) - centre
    assert np.hypot(*points.T) == pytest.approx(1.0, abs=2e-9)
    middles = 0.5 * (points[1:] + points[:-1])
    assert (1.0 - np.hypot(*middles.T)).max() <= 0.0002


def test_samples_are_where_the_pieces_say() -> None:
    """Between the ends of a piece that moves askew and turns, samples follow its twist."""
    piece = Piece(0, "lateral-left", START, (0.3, -0.8, 4.0))
    track = sample(Trajectory("a", START, (piece,), ((0, 2000),)), modes=False)
    for t, x, y, theta in zip(track.t, track.x, track.y, track.theta, strict=True):
        pose = piece.at(t / 2.0)
        assert (x, y) == pytest.approx((pose.x, pose.y), abs=2e-6)
        assert math.remainder(theta - pose.theta, math.tau) == pytest.approx(0.0, abs=2e-6)


def test_no_step_turns_by_pi_and_headings_stay_wrapped() -> None:
    """Ten turns on the spot within 10 ms need more than 20 steps."""
    track = sample(path(("rotate-left", (0.0, 0.0, 20.0 * math.pi), 0, 10)), modes=True)
    turns = np.remainder(np.diff(track.theta), 2.0 * np.pi)
    assert len(turns) > 20
    assert turns.max() < math.pi
    assert np.abs(track.theta).max() <= math.pi + 1e-9


def test_a_heading_that_jumps_gives_two_samples_at_one_time() -> None:
    """A piece that begins turned by a right angle begins where the robot stands, at once."""
    first = Piece(0, None, START, (0.1, 0.0, 0.0))
    second = Piece(1, None, first.end._replace(theta=0.5 + math.pi / 2), (0.1, 0.0, 0.0))
    for start, times in ((100, [0.0, 0.1, 0.1, 0.2]), (300, [0.0, 0.1, 0.3, 0.3, 0.4])):
        timing = ((0, 100), (start, start + 100))
        track = sample(Trajectory("a", START, (first, second), timing), modes=False)
        assert track.t.tolist() == times
        k = times.index(start / 1000) + 1
        assert track.theta[k] - track.theta[k - 1] == pytest.approx(math.pi / 2)
        assert (track.x[k], track.y[k]) == (track.x[k - 1], track.y[k - 1])


def test_a_piece_of_no_length_is_standing() -> None:
    """A mode switch of 2 s is a rest, whatever the mode that follows."""
    track = sample(
        path(("forward", (0.0, 0.0, 0.0), 0, 2000), ("forward", (0.1, 0.0, 0.0), 2000, 2100)),
        modes=True,
    )
    assert track.t.tolist() == [0.0, 2.0, 2.1]
    assert track.mode == ("stop", "forward", "stop")


def test_figures_are_rounded() -> None:
    """Positions and headings have 9 decimals, times 6, and there is no minus zero."""
    track = sample(path(("forward", (-1.0, 0.3, 1.0), 0, 1333)), modes=True)
    for array, digits in ((track.t, 6), (track.x, 9), (track.y, 9), (track.theta, 9)):
        assert array.tolist() == np.round(array, digits).tolist()
    still = Trajectory("a", Pose(-1e-12, 0.0, -1e-12))
    assert repr(sample(still, modes=False).x[0].item()) == "0.0"
