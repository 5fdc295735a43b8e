"""Trips on lanes: always possible, never two robots in a cell."""

from collections import Counter
from itertools import pairwise

import pytest
from tests.plan.lane_traffic import LAYOUTS, Traffic

from clearway.model import Layout, Obstacle
from clearway.plan.lane_motion import stays_of
from clearway.validate import validate_plan
from clearway.world.lane_grid import HORIZONTAL, LONGITUDINAL

CHANNELS = (HORIZONTAL, LONGITUDINAL)


@pytest.mark.parametrize("rules", ["waiting", "search"])
@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_random_trips_all_end_and_no_bodies_meet(rule, turn_seconds, rules):
    """Twenty robots on every layout, judged on their true bodies."""
    traffic = Traffic(Layout(rule), 20, turn_seconds, seed=1, rules=rules)
    traffic.run(150)
    assert validate_plan(traffic.record()) == []


def box_at(grid, cell, half=0.3):
    """An obstacle in the middle of a cell."""
    x, y, _ = grid.centre(cell)
    return Obstacle(
        polygon=(
            (x - half, y - half),
            (x + half, y - half),
            (x + half, y + half),
            (x - half, y + half),
        )
    )


def busiest(traffic, now):
    """The channel cell, no crossing, that most robots come to later, and where nobody is now."""
    cells, here = Counter(), set()
    for told in traffic.told.values():
        stays = stays_of(traffic.grid, told[-1].trajectory)
        for before, stay in pairwise(stays):
            cell = (stay.cell % traffic.grid.size[0], stay.cell // traffic.grid.size[0])
            if before.depart > now and traffic.grid.region[cell[::-1]] in CHANNELS:
                cells[cell] += 1
            if before.depart <= now <= stay.depart + 1000:
                here.add(cell)
    return max(cells.keys() - here, key=lambda cell: (cells[cell], cell))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_robots_drive_round_an_obstacle_that_turns_up(rule, turn_seconds, seed):
    """Nobody drives into it, nobody meets anybody, and those whom it does not concern go on."""
    traffic = Traffic(Layout(rule), 20, turn_seconds, seed=seed)
    now = 40_000
    traffic.run(200, until=now)
    before = {name: told[-1] for name, told in traffic.told.items()}
    place = busiest(traffic, now)
    obstacle = box_at(traffic.grid, place)
    concerned = traffic.block(obstacle, now)
    assert concerned
    for name, told in traffic.told.items():
        assert (told[-1] is before[name]) == (name not in concerned)
    refused = traffic.run(60)
    assert validate_plan(traffic.record()) == []
    assert all(v.time < 40.0 for v in validate_plan(traffic.record([obstacle])))
    assert None not in traffic.rests.values()
    shut = {
        name
        for name, point in traffic.grid.endpoints.items()
        if traffic.grid.entrances(point.cell) == (place,)
    }
    assert all(trip.goals[0] in shut or traffic.rests[trip.robot] in shut for trip in refused)
