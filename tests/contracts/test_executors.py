"""The exam that every executor sits."""

import pytest
from tests.execute.lanes import driven, hall

from clearway.execute import CellConflicts, RightOfWay, TrackPlan

GRID = hall(6, 6)
EXECUTORS = {
    "track plan": TrackPlan,
    "right of way": lambda: RightOfWay(CellConflicts(GRID)),
}
EAST = driven(GRID, "east", [(x, 2) for x in range(5)], [0, 1000, 2000, 3000])
NORTH = driven(GRID, "north", [(2, y) for y in range(5)], [2500, 3500, 4500, 5500])
ROBOTS = {"east": EAST, "north": NORTH}


@pytest.fixture(params=EXECUTORS)
def executor(request):
    executor = EXECUTORS[request.param]()
    executor.commit(ROBOTS, 0)
    return executor


def test_robots_on_time_are_never_held_up(executor):
    """Heard of every 100 ticks, they are always granted at least the next 100."""
    for now in range(0, 8000, 100):
        for robot in ROBOTS:
            assert executor.grant(robot) >= now + 100
        for robot in ROBOTS:
            executor.report(robot, now + 100)


def test_grants_never_shrink(executor):
    granted = dict.fromkeys(ROBOTS, 0)
    for now in (0, 300, 300, 200, 900, 1400, 0):
        for robot in ROBOTS:
            grant = executor.grant(robot)
            assert grant >= granted[robot]
            granted[robot] = grant
            executor.report(robot, now)


def test_grants_reach_beyond_progress_and_have_an_end(executor):
    assert 0 < executor.grant("east") < EAST.trajectory.end


def test_the_first_in_the_plan_is_held_by_nobody(executor):
    assert executor.grant("east") > 0
    assert executor.why("east") is None


def test_on_time_everybody_is_expected_as_planned(executor):
    expected = executor.projected(0)
    assert dict(expected) == {robot: each.trajectory for robot, each in ROBOTS.items()}


def test_others_keep_what_they_have_when_one_is_committed(executor):
    granted = executor.grant("east")
    again = driven(GRID, "north", [(2, y) for y in range(5)], [5000, 6000, 7000, 8000])
    executor.commit({"north": again}, 0)
    assert executor.grant("east") == granted
    assert executor.projected(0)["north"] == again.trajectory
