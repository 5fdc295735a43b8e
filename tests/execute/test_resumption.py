"""Where robots are on motions that replace what they were on."""

import pytest
from tests.execute.lanes import driven, hall

from clearway.execute import CellConflicts, RightOfWay
from clearway.execute.course import Course
from clearway.execute.resumption import resume

GRID = hall(8, 8)
EAST = driven(GRID, "east", [(x, 2) for x in range(5)], [0, 1000, 3000, 4000])
LATER = driven(GRID, "east", [(x, 2) for x in range(5)], [500, 1500, 3000, 4000])


class Asked:
    """Conflicts that remember what they were asked."""

    def __init__(self):
        self.conflicts, self.done = CellConflicts(GRID), []

    def __call__(self, one, other, done=(0, 0)):
        self.done.append((one.robot, other.robot, done))
        return self.conflicts(one, other, done)


def test_a_new_end_changes_no_progress():
    """At 1200 in its second step, a robot gets another way from (3, 2) on."""
    other = driven(GRID, "east", [(0, 2), (1, 2), (2, 2), (3, 2), (3, 3)], [0, 1000, 3000, 4000])
    there = resume("east", Course(EAST.trajectory), Course(other.trajectory), 1200, 1300)
    assert (there.progress, there.until, there.is_retimed) == (1200, 4000, False)
    assert there.granted(3500) == 3500
    assert there.granted(4700) == 4000


def test_new_times_put_a_robot_on_time():
    there = resume("east", Course(EAST.trajectory), Course(LATER.trajectory), 1000, 1500)
    assert (there.progress, there.is_retimed) == (1500, True)
    assert [there.at(tick) for tick in (1000, 1300, 2000, 2500, 3300)] == [
        1500,
        1800,
        3000,
        3000,
        3300,
    ]
    assert [there.passed(tick) for tick in (1300, 2000, 2500, 3300)] == [1800, 2500, 2500, 3300]


def test_a_motion_from_elsewhere_is_refused():
    away = driven(GRID, "east", [(5, 5), (6, 5)], [2000])
    with pytest.raises(ValueError, match=r"robot east has come to \(1.500, 2.500\).*goes on from"):
        resume("east", Course(EAST.trajectory), Course(away.trajectory), 1000, 1000)


def test_only_what_is_new_is_looked_at():
    """A new end is compared from where it departs; new times alone ask for nothing."""
    asked = Asked()
    ledger = RightOfWay(asked, 500)
    north = driven(GRID, "north", [(2, y) for y in range(5)], [3500, 4500, 5500, 6500])
    ledger.commit({"east": EAST, "north": north}, 0)
    assert asked.done == [("east", "north", (0, 0))]
    ledger.commit({"east": LATER}, 0)
    assert asked.done == [("east", "north", (0, 0))]
    other = driven(GRID, "east", [(0, 2), (1, 2), (2, 2), (3, 2), (3, 3)], [500, 1500, 3000, 4000])
    ledger.commit({"east": other}, 0)
    assert asked.done[1:] == [("east", "north", (4000, 0))]
    assert [(s.at, s.passed) for s in ledger.unmet("north")] == [(4500, 4000)]
