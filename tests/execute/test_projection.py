"""Times to be expected of late robots, worked by hand."""

from dataclasses import replace

import pytest
from tests.execute.lanes import driven, hall
from tests.execute.late import Late, from_now, overlaps
from tests.execute.rides import encounter

from clearway.execute import BodyConflicts, CellConflicts, RightOfWay
from clearway.model import Commitment, Piece, Stop, Trajectory

GRID = hall(6, 6)
# Serves for half a second at (2, 2), then waits for a second.
EAST = driven(GRID, "east", [(x, 2) for x in range(5)], [0, 1000, 3500, 4500])
EAST = replace(EAST, trajectory=replace(EAST.trajectory, stops=(Stop(0, 2000, 2500),)))
NORTH = driven(GRID, "north", [(2, y) for y in range(5)], [2500, 4500, 5500, 6500])


def late(now, **progress):
    ledger = RightOfWay(CellConflicts(GRID))
    ledger.commit({"east": EAST, "north": NORTH}, 0)
    for tick in range(0, now, 500):
        for robot in ("east", "north"):
            ledger.grant(robot)
            ledger.report(robot, min(tick, progress.get(robot, tick)))
    ledger.grant("east")
    ledger.grant("north")
    for robot in ("east", "north"):
        ledger.report(robot, progress.get(robot, now))
    return ledger


def test_who_is_on_time_stays_on_time():
    ledger = late(1000)
    assert ledger.projected(1000) == {"east": EAST.trajectory, "north": NORTH.trajectory}


def test_a_late_robot_skips_waits_and_serves_as_long_as_planned():
    """700 ticks late at 1700, in the middle of nothing: its wait of 1000 ticks makes up for it."""
    east = late(1700, east=1000).projected(1700)["east"]
    assert east.timing == ((1700, 2700), (3500, 4500), (4500, 5500))
    assert east.stops == (Stop(0, 2700, 3200),)
    assert [piece.id for piece in east.pieces] == [1, 2, 3]


def test_the_piece_that_a_robot_is_on_is_cut_where_it_is():
    """At 2600 it has come to 1250: a quarter of its second step is behind it."""
    east = late(2600, east=1250).projected(2600)["east"]
    assert east.start == pytest.approx((1.75, 2.5, 0.0))
    assert east.pieces[0].twist == pytest.approx((0.75, 0.0, 0.0))
    assert east.timing == ((2600, 3350), (3850, 4850), (4850, 5850))


def test_who_is_held_up_waits_before_a_piece():
    """North, on time, is to enter (2, 2) at 4500; east leaves it two seconds late.

    East, at 1250 when it is 4000, is through its step at 4750, serves until 5250 and has left by
    6250. So north enters then, and all that follows is put off.
    """
    north = late(4000, east=1250).projected(4000)["north"]
    assert north.timing == ((6250, 7250), (7250, 8250), (8250, 9250))


def test_services_under_way_go_on():
    """200 of 500 ticks of service are left at 3000."""
    east = late(3000, east=2300).projected(3000)["east"]
    assert east.stops == (Stop(0, 2700, 3200),)
    assert east.timing[0] == (3500, 4500)


def test_what_new_times_put_off_is_not_granted_any_more():
    """West's only piece is granted to (3, 2), where it waits for north, which does not set out.

    North is to leave that cell at 23,000 at last, so west, to drive through, begins at 22,000.
    That is later than the look-ahead, so its way to (3, 2) is others' until then.
    """
    piece = Piece(0, None, GRID.centre((5, 2)), (-5.0, 0.0, 0.0))
    west = Commitment("west", Trajectory("west", piece.start, (piece,), ((4500, 9500),)))
    north = driven(GRID, "north", [(3, y) for y in range(5)], [1000, 2000, 3000, 4000])
    ledger = RightOfWay(CellConflicts(GRID), 1500)
    ledger.commit({"north": north, "west": west}, 0)
    ledger.report("west", 4400)
    assert ledger.grant("west") == 5500
    ledger.report("north", 1000)
    expected = ledger.projected(20_000)
    assert expected["west"].timing == ((22_000, 27_000),)
    ledger.commit({robot: Commitment(robot, path) for robot, path in expected.items()}, 20_000)
    assert ledger.reserve("west") == (20_000, 22_000)


def test_new_times_are_those_of_a_plan():
    """Told anew while one is late, times of true shapes meet nobody, and all arrive by them."""
    told = 0
    for seed in range(4):
        one, other, types, _ = encounter(seed)
        conflicts = BodyConflicts(types)
        fleet = Late({"a": one, "b": other}, RightOfWay(conflicts), seed, stops=0.05, lost=0.0)
        while not fleet.is_done:
            fleet.step()
            assert fleet.executor.overlapping(conflicts.overlap) == ()
            if fleet.now % 4000 == 0:
                before = {r: c.trajectory for r, c in fleet.commitments.items()}
                fleet.retime()
                after = {r: c.trajectory for r, c in fleet.commitments.items()}
                told += before != after
                assert overlaps({r: from_now(t, fleet.now) for r, t in after.items()}, types) == []
        assert fleet.overlaps(types) == []
    assert told > 4
