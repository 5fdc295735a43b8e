"""The ledger: what robots are granted, and what comes of it when they are late."""

from dataclasses import replace

import pytest
from tests.execute.lanes import BOX, crowd, driven, hall
from tests.execute.late import Late

from clearway.execute import CellConflicts, RightOfWay, TrackPlan
from clearway.protocols import Binding

GRID = hall(6, 6)
EAST = driven(GRID, "east", [(x, 2) for x in range(5)], [0, 1000, 2000, 3000])
# Enters (2, 2), the crossing of both, when the other has been gone from it for half a second.
NORTH = driven(GRID, "north", [(2, y) for y in range(5)], [2500, 3500, 4500, 5500])


def crossing(look_ahead=2000):
    ledger = RightOfWay(CellConflicts(GRID), look_ahead)
    ledger.commit({"east": EAST, "north": NORTH}, 0)
    return ledger


def test_who_comes_later_waits_before_the_cell():
    """East leaves (2, 2) by its tick 3000; north enters it from its tick 3500 on."""
    ledger = crossing(10_000)
    assert ledger.grant("north") == 3500
    assert ledger.why("north") == Binding("north", "east", 3500, 3000)
    ledger.grant("east")
    ledger.report("east", 2999)
    assert ledger.grant("north") == 3500
    ledger.report("east", 3000)
    assert ledger.why("north") is None
    assert ledger.grant("north") > 6500


def test_who_comes_first_is_bound_by_the_look_ahead_only():
    ledger = crossing()
    assert ledger.grant("east") == 2000
    assert ledger.why("east") is None
    ledger.report("east", 500)
    assert ledger.grant("east") == 2500


def test_reports_that_are_late_or_repeated_change_nothing():
    ledger = crossing()
    ledger.grant("east")
    ledger.report("east", 1500)
    granted = ledger.grant("east")
    ledger.report("east", 200)
    assert ledger.reserve("east") == (1500, granted)
    assert ledger.grant("east") == granted


def test_a_robot_beyond_its_grant_is_told():
    ledger = crossing()
    ledger.grant("east")
    with pytest.raises(ValueError, match=r"robot east reports tick 2001.*to 2000 only"):
        ledger.report("east", 2001)


def test_standing_takes_no_grant():
    """North stands at its start until its tick 2500, so it may be there at any time before."""
    ledger = crossing(100)
    assert ledger.grant("north") == 2500
    ledger.report("north", 2500)


def test_what_is_not_free_of_conflicts_is_refused_and_changes_nothing():
    ledger = crossing()
    early = replace(NORTH, trajectory=driven(GRID, "north", [(2, 0), (2, 1)], [0]).trajectory)
    west = driven(GRID, "west", [(x, 2) for x in range(5, 0, -1)], [0, 1000, 2000, 3000])
    with pytest.raises(ValueError, match=r"both hold cell"):
        ledger.commit({"north": early, "west": west}, 0)
    assert ledger.commitment("north") is NORTH
    with pytest.raises(KeyError):
        ledger.grant("west")


def test_new_motion_through_granted_floor_is_refused():
    """West would be through (4, 2) before east comes there, but east may already be on its way."""
    ledger = crossing(10_000)
    assert ledger.grant("east") > 4000
    across = driven(GRID, "across", [(4, 1), (4, 2), (4, 3)], [500, 1500])
    with pytest.raises(ValueError, match=r"robot east has been granted .* look-ahead later"):
        ledger.commit({"across": across}, 500)


def test_the_chain_ends_at_the_robot_that_is_merely_slow():
    """Third waits for north to leave (3, 3), which waits for east to leave (2, 2)."""
    north = driven(
        GRID, "north", [(2, y) for y in range(4)] + [(3, 3), (4, 3)], range(2500, 7500, 1000)
    )
    third = driven(GRID, "third", [(3, 5), (3, 4), (3, 3)], [7000, 8000])
    ledger = RightOfWay(CellConflicts(GRID), 20_000)
    ledger.commit({"east": EAST, "north": north, "third": third}, 0)
    links = ledger.chain("third")
    assert [(link.robot, link.other) for link in links] == [("third", "north"), ("north", "east")]
    assert ledger.chain("east") == ()


@pytest.mark.parametrize("seed", range(8))
def test_late_robots_arrive_without_overlap(seed):
    """Stops of up to 15 s, three of ten robots slow, three of ten reports lost."""
    grid, commitments = crowd(14, seed)
    check = CellConflicts(grid)
    ledger = RightOfWay(check)
    fleet = Late(commitments, ledger, seed)
    granted = dict.fromkeys(commitments, 0)
    while not fleet.is_done:
        fleet.step()
        assert fleet.now < 600_000
        for robot in commitments:
            _, grant = ledger.reserve(robot)
            assert grant >= granted[robot]
            granted[robot] = grant
        assert ledger.overlapping(check.overlap) == ()
    assert fleet.overlaps(dict.fromkeys(commitments, BOX)) == []


def test_without_the_ledger_late_robots_run_into_each_other():
    _grid, commitments = crowd(14, 0)
    fleet = Late(commitments, TrackPlan(), 0)
    while not fleet.is_done:
        fleet.step()
    assert fleet.overlaps(dict.fromkeys(commitments, BOX)) != []
