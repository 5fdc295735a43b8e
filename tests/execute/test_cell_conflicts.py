"""Cells that grid robots hold, and the order in which they pass them."""

from dataclasses import replace

import pytest
from tests.execute.lanes import driven, hall

from clearway.execute import CellConflicts
from clearway.execute.cell_conflicts import CellHold, holds_of
from clearway.execute.course import NEVER
from clearway.model import Piece, Pose, Trajectory
from clearway.protocols import Precedence

GRID = hall(8, 8)
EAST = driven(GRID, "east", [(x, 2) for x in range(5)], [0, 1000, 2000, 3000])


def at_once(robot, start, length, begin, end, theta=0.0):
    piece = Piece(0, None, Pose(*start, theta), (length, 0.0, 0.0))
    return Trajectory(robot, piece.start, (piece,), ((begin, end),))


def test_a_cell_is_held_from_the_move_into_it_to_the_end_of_the_move_out():
    first, second, *_, last = holds_of(GRID, EAST.trajectory)
    assert first == CellHold((0, 2), 0, 0, 0, 1000, None, (1, 0))
    assert second == CellHold((1, 2), 0, 1000, 1000, 2000, (1, 0), (1, 0))
    assert last == CellHold((4, 2), 3000, 4000, NEVER, NEVER, (1, 0), None)


def test_one_piece_may_lead_through_many_cells():
    straight = at_once("east", (0.5, 2.5), 4.0, 0, 4000)
    assert holds_of(GRID, straight) == holds_of(GRID, EAST.trajectory)


def test_what_is_left_of_a_move_holds_both_cells():
    """A quarter of the move from (0, 2) to (1, 2) is left at 5000; it began at 4250."""
    rest = at_once("east", (1.25, 2.5), 0.25, 5000, 5250)
    first, second = holds_of(GRID, rest)
    assert (first.cell, first.enter, first.go, first.leave) == ((0, 2), 0, 4250, 5250)
    assert (second.cell, second.enter, second.there) == ((1, 2), 4250, 5250)


def test_turning_on_the_spot_holds_the_cell_only():
    piece = Piece(0, None, Pose(0.5, 0.5, 0.0), (0.0, 0.0, 1.57))
    turn = Trajectory("east", piece.start, (piece,), ((0, 1000),))
    assert [hold.cell for hold in holds_of(GRID, turn)] == [(0, 0)]


def test_pieces_off_the_grid_are_refused_by_name():
    with pytest.raises(ValueError, match=r"robot east, piece 0: does not lead along a row"):
        holds_of(GRID, at_once("east", (0.5, 2.5), 4.0, 0, 4000, theta=0.3))
    halfway = at_once("east", (0.5, 2.5), 3.5, 0, 3500)
    more = Piece(1, None, halfway.final_pose, (0.5, 0.0, 0.0))
    with pytest.raises(ValueError, match=r"to the middle of another"):
        holds_of(
            GRID, replace(halfway, pieces=(*halfway.pieces, more), timing=((0, 3500), (5000, 5500)))
        )


@pytest.mark.parametrize("begin", [0.5, 1.25, 1.75, 2.0])
def test_who_stops_between_two_cells_holds_both_for_ever(begin):
    """In front of an obstacle, however much of the way there has been driven before."""
    length = 2.0 - begin
    path = Trajectory("east", Pose(2.0, 2.5, 0.0))
    if length:
        path = at_once("east", (begin, 2.5), length, 1000, 1000 + round(1000 * length))
    *_, behind, ahead = holds_of(GRID, path)
    assert (behind.cell, behind.leave) == ((1, 2), NEVER)
    assert (ahead.cell, ahead.there, ahead.leave) == ((2, 2), NEVER, NEVER)
    assert ahead.enter == (500 + round(1000 * length) if length else 0)


def test_who_crosses_waits_until_the_cell_is_left():
    """East leaves (2, 2) at 3000; north enters it at 3500 and leaves it at 5500."""
    north = driven(GRID, "north", [(2, y) for y in range(5)], [2500, 3500, 4500, 5500])
    assert CellConflicts(GRID)(EAST, north) == ((), (Precedence(3500, "east", 3000),))
    assert CellConflicts(GRID)(north, EAST) == ((Precedence(3500, "east", 3000),), ())
    assert CellConflicts(GRID)(EAST, north, (3000, 0)) == ((), ())


def test_who_follows_in_line_keeps_its_body_behind():
    """With bodies of 0.7 m a follower may come 0.25 m nearer than the cell that lies between.

    In the middle of the cell, where it may turn, it may go on when the other has left.
    """
    behind = driven(GRID, "behind", [(0, 2), (1, 2)], [1000])
    ahead = replace(EAST, trajectory=driven(GRID, "east", [(1, 2), (2, 2)], [1000]).trajectory)
    waits, _ = CellConflicts(GRID, 0.7)(behind, ahead)
    assert [(step.at, step.passed) for step in waits] == [
        (1000, 1000),
        (1250, 1250),
        (1500, 1500),
        (1750, 1750),
        (2000, 2000),
    ]


def test_who_follows_round_a_corner_waits():
    """A body that leaves sideways is in the way of one that comes in (R-B29)."""
    behind = driven(GRID, "behind", [(0, 2), (1, 2)], [1000])
    ahead = driven(GRID, "ahead", [(1, 2), (1, 3)], [1000])
    with pytest.raises(ValueError, match=r"behind and ahead both hold cell \(1, 2\)"):
        CellConflicts(GRID)(behind, ahead)


def test_large_bodies_are_refused():
    with pytest.raises(ValueError, match=r"a body of 0.8 m cannot turn within a cell of 1.0 m"):
        CellConflicts(GRID, 0.8)


def test_reserves_that_meet_are_seen():
    """East's body reaches into (2, 2) when it is 0.65 m before, at 1350 of its second step."""
    north = driven(GRID, "north", [(2, y) for y in range(5)], [2500, 3500, 4500, 5500])
    check = CellConflicts(GRID)
    assert not check.overlap(EAST, (3000, 4000), north, (3000, 5000))
    assert not check.overlap(EAST, (0, 1250), north, (4500, 4500))
    assert check.overlap(EAST, (0, 1350), north, (4500, 4500))
