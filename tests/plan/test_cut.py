"""Where a committed motion may be left."""

import pytest

from clearway.model import Piece, Pose, Trajectory
from clearway.plan.cut import cut

# 4 m in 4 s, on for 2 m in 2 s, 3 s of standing, and 1 m in 1 s.
PIECES = (
    Piece(0, "forward", Pose(0.0, 0.0, 0.0), (4.0, 0.0, 0.0)),
    Piece(1, "forward", Pose(4.0, 0.0, 0.0), (2.0, 0.0, 0.0)),
    Piece(2, "reverse", Pose(6.0, 0.0, 0.0), (-1.0, 0.0, 0.0)),
)
PATH = Trajectory("a", PIECES[0].start, PIECES, ((0, 4000), (4000, 6000), (9000, 10_000)))


def test_a_piece_is_left_half_driven():
    """At 5 s the second piece has come 1 m; the first is over and forgotten."""
    kept = cut(PATH, 4500, 5000, anywhere=True)
    assert kept.ready == 5000
    assert kept.timing == ((4000, 5000),)
    assert kept.pieces[0].twist == (1.0, 0.0, 0.0)
    assert kept.pose == pytest.approx((5.0, 0.0, 0.0))
    assert kept.mode == "forward"


@pytest.mark.parametrize(
    ("at", "ready"), [(1000, 6000), (4000, 6000), (7000, 7000), (9500, 10_000)]
)
def test_who_cannot_stop_at_once_is_left_standing(at, ready):
    """It stands from 6 s to 9 s and from 10 s on, not where one piece goes over into the next."""
    kept = cut(PATH, 0, at, anywhere=False)
    assert kept.ready == ready
    assert kept.pose.x == (6.0 if ready < 9000 else 5.0)


def test_after_the_end_nothing_is_kept():
    kept = cut(PATH, 20_000, 20_000, anywhere=True)
    assert kept.pieces == ()
    assert kept.ready == 20_000
    assert kept.pose == pytest.approx((5.0, 0.0, 0.0))
