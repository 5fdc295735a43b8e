"""The judge of lane grids: right lists pass, and one wrong list of each kind does not."""

import itertools
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clearway.model import Layout
from clearway.plan.route_search import RouteSearch
from clearway.validate.cell_list import DRIVE, STAND, Entry, cells_of
from clearway.validate.lane_rules import LANE_KINDS, judge_lanes
from clearway.world.channels import RULES, lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import STEPS

GRID = lane_grid(Layout("bidirectional"))


def _walk(cells, begin=0.0, step=1.0, waits=None):
    """A list that steps from cell to cell; ``waits`` are seconds before leaving a cell."""
    waits = waits or {}
    first, *rest = cells
    entries = [Entry(0.0, *first, STAND)]
    t = begin + waits.get(first, 0.0)
    for cell in rest:
        entries.append(Entry(t, *cell, DRIVE))
        t += step
        if cell in waits:
            entries.append(Entry(t, *cell, STAND))
            t += waits[cell]
    if entries[-1].state == DRIVE:
        entries.append(Entry(t, *rest[-1], STAND))
    return entries


def _line(a, b):
    """The cells from one to another in the same row or column."""
    (ax, ay), (bx, by) = a, b
    n = max(abs(bx - ax), abs(by - ay))
    return [(ax + (bx - ax) * i // n, ay + (by - ay) * i // n) for i in range(n + 1)]


def _path(*corners):
    cells = [corners[0]]
    for a, b in itertools.pairwise(corners):
        cells += _line(a, b)[1:]
    return cells


def _kinds(lists, own=None, grid=GRID):
    return [violation.kind for violation in judge_lanes(grid, lists, own)]


def test_a_trip_along_the_lanes_is_right():
    """From shelf (5, 2) west, changing lanes for station (0, 0) below, and back to shelf (5, 3)."""
    there = _path((5, 2), (5, 1), (1, 1), (1, 0), (0, 0))
    back = _path((0, 0), (2, 0), (2, 4), (5, 4), (5, 3))
    entries = _walk(there + back[1:], waits={(0, 0): 10.0})
    assert _kinds({"a": entries}) == []
    assert _kinds({"a": entries}, {"a": [(5, 2), (0, 0), (5, 3)]}) == []


def test_lanes_are_changed_in_aprons():
    """Out of shelf (26, 2) across to the eastbound lane; into (30, 2) across from it."""
    right = _path((26, 2), (26, 0), (30, 0), (30, 2))
    assert _kinds({"a": _walk(right)}) == []
    # At column 28 neither the start nor the goal lies across.
    wrong = _path((26, 2), (26, 0), (28, 0), (28, 1), (27, 1))
    assert _kinds({"a": _walk(wrong)}) == ["lane"]


@pytest.mark.parametrize("rule", ["compact", "one_way"])
def test_one_way_channels_are_never_changed_against_the_lane(rule):
    """Shelf g1 opens downwards onto the lowest channel, which leads east."""
    grid = lane_grid(Layout(rule))
    x, y = grid.endpoints["g1"].cell
    assert _kinds({"a": _walk([(x, y), (x, y - 1), (x + 1, y - 1)])}, grid=grid) == []
    assert _kinds({"a": _walk([(x, y), (x, y - 1), (x - 1, y - 1)])}, grid=grid) == ["lane"]
    if rule == "one_way":
        across = _walk([(x, y), (x, y - 1), (x, y - 2), (x + 1, y - 2)])
        assert _kinds({"a": across}, grid=grid) == ["lane"]


def test_a_foreign_endpoint_is_no_way_through():
    """Under shelf (5, 2) and (5, 3) up to the next channel, where nothing is to be done."""
    through = _walk(_path((6, 2), (6, 1), (5, 1), (5, 4)))
    assert set(_kinds({"a": through})) == {"cell", "lane"}
    stops = _walk([(6, 2), (6, 1), (5, 1), (5, 2)])
    assert _kinds({"a": stops}, {"a": [(6, 2)]}) == ["cell"]
    assert _kinds({"a": stops}, {"a": [(6, 2), (5, 2)]}) == []


def test_void_is_no_channel():
    entries = _walk([(1, 29), (1, 30), (1, 29)])
    assert "cell" in _kinds({"a": entries})


def test_a_leap_is_no_step():
    assert _kinds({"a": _walk([(5, 1), (3, 1)])}) == ["astray"]


def test_a_list_that_breaks_off_may_be_on_its_way_to_any_of_its_own():
    """Changing lanes at column 30 is right if shelf (30, 2) across from there is its own."""
    entries = _walk([*_path((26, 2), (26, 0), (30, 0), (30, 1))])
    assert _kinds({"a": entries}, {"a": [(26, 2), (30, 2)]}) == []
    assert _kinds({"a": entries}, {"a": [(26, 2)]}) == ["lane"]


def test_one_follows_another_straight_ahead_at_one_cell():
    """Bumper to bumper on row 1: the second is where the first was a second ago."""
    first, second = _walk(_line((9, 1), (3, 1))), _walk(_line((10, 1), (4, 1)))
    assert _kinds({"a": first, "b": second}) == []


def test_whoever_catches_up_is_in_a_cell_with_the_other():
    first = _walk(_line((9, 1), (4, 1)), step=2.0)
    second = _walk(_line((10, 1), (6, 1)), step=1.0)
    kinds = _kinds({"a": first, "b": second})
    assert set(kinds) == {"hold"}


def test_who_comes_before_the_other_sets_out_is_in_a_cell_with_it():
    """The first stands in (8, 1) until 2 s; the second is slow, but on its way from 1 s on."""
    first = _walk([(8, 1), (7, 1)], begin=2.0)
    assert _kinds({"a": first, "b": _walk([(9, 1), (8, 1)], begin=2.0)}) == []
    assert _kinds({"a": first, "b": _walk([(9, 1), (8, 1)], begin=1.0, step=2.0)}) == ["hold"]


def test_who_leaves_after_the_other_has_come_does_not_change_places():
    """The second runs into (8, 1), where the first stands until 5 s before it goes east."""
    first = _walk([(8, 1), (9, 1)], begin=5.0)
    second = _walk([(9, 1), (8, 1)])
    assert _kinds({"a": first, "b": second}) == ["hold", "lane"]


def test_a_cell_left_sideways_is_not_entered_before_it_is_clear():
    """Eq. (10): the first turns south at (12, 4)'s column while the other comes from behind."""
    first = _walk(_path((13, 5), (12, 5), (12, 2)))
    for wait, kinds in ((0.0, ["hold"]), (1.0, [])):
        second = _walk(_path((14, 5), (10, 5)), waits={(14, 5): wait})
        # At wait 0 it sets out for (13, 5) when the first leaves it straight ahead: that is right;
        # at (12, 5) the first turns off, and the other must not come before it is at (12, 4).
        assert _kinds({"a": first, "b": second}) == kinds


@given(st.sampled_from(sorted(RULES)), st.integers(0, 2), st.integers(0, 2**32))
@settings(max_examples=60, deadline=None)
def test_routes_on_the_dynamic_map_keep_the_rules(rule, more, seed):
    """Judge and map know of lanes and aprons each for itself; the map allows what is right."""
    grid = lane_grid(Layout(rule, blocks=(3,) * (2 * more + 1), bands=2 * more + 1))
    dice = random.Random(seed)
    start, goal = dice.sample([point.cell for point in grid.endpoints.values()], 2)
    route = RouteSearch(grid, 1000, 0)(DynamicMap(grid)(start, goal), start, goal, None)
    assert route is not None
    assert _kinds({"a": _walk(route)}, {"a": [start, goal]}, grid) == []


@given(st.sampled_from(sorted(RULES)), st.integers(0, 2**32))
@settings(max_examples=12, deadline=None)
def test_the_map_allows_all_that_is_right(rule, seed):
    """Any step between channel cells that the judge lets pass between two ends is a legal move."""
    grid = lane_grid(Layout(rule, blocks=(3, 2, 4), bands=3))
    dice = random.Random(seed)
    start, goal = dice.sample([point.cell for point in grid.endpoints.values()], 2)
    moves = DynamicMap(grid)(start, goal)
    (entrance, *_), (last, *_) = grid.entrances(start), grid.entrances(goal)
    for y, x in np.argwhere(grid.lanes > 0):
        for bit, (dx, dy) in STEPS.items():
            after = (int(x) + dx, int(y) + dy)
            if grid.is_channel(after):
                # Leaps to and from the step are told as astray; the step itself as no lane.
                entries = _walk([start, entrance, (int(x), int(y)), after, last, goal])
                told = [v for v in judge_lanes(grid, {"a": entries}) if v.kind == "lane"]
                steps = [
                    v for v in told if v.text.endswith(f"{(int(x), int(y))} to {after}, no lane")
                ]
                assert bool(moves[y, x] & bit) == (not steps)


def test_two_that_stand_in_one_cell_are_found():
    assert _kinds({"a": [Entry(0.0, 3, 2, STAND)], "b": [Entry(0.0, 3, 2, STAND)]}) == ["hold"]


def test_two_that_change_places_are_told_once():
    """Head on in row 1; the second one is on the wrong lane as well."""
    first, second = _walk([(9, 1), (8, 1)]), _walk([(8, 1), (9, 1)])
    found = judge_lanes(GRID, {"a": first, "b": second})
    assert sorted(violation.kind for violation in found) == ["lane", "swap"]
    swap = next(violation for violation in found if violation.kind == "swap")
    assert set(swap.robots) == {"a", "b"}
    assert swap.time == 0.0


def test_each_kind_is_told_with_robot_time_and_place():
    (violation,) = judge_lanes(GRID, {"a": _walk([(8, 1), (9, 1)], begin=4.0)})
    assert violation.kind in LANE_KINDS
    assert (violation.robots, violation.time, violation.place) == (("a",), 4.0, (9.5, 1.5))
    assert str(violation).endswith("a steps from cell (8, 1) to (9, 1), no lane")


def test_cells_are_found_from_samples():
    """Out of (5, 2) at 1 s, down to (5, 1), a turn of half a second, west, and on."""
    t = [0.0, 1.0, 2.0, 2.5, 4.5, 6.0]
    x = [5.5, 5.5, 5.5, 5.5, 3.5, 3.5]
    y = [2.5, 2.5, 1.5, 1.5, 1.5, 1.5]
    assert cells_of(t, x, y, 1.0) == [
        Entry(0.0, 5, 2, STAND),
        Entry(1.0, 5, 1, DRIVE),
        Entry(2.0, 5, 1, STAND),
        Entry(2.5, 4, 1, DRIVE),
        Entry(3.5, 3, 1, DRIVE),
        Entry(4.5, 3, 1, STAND),
    ]


def test_who_turns_without_stopping_does_not_stand():
    """With cells of 2 m, one a second."""
    t, x, y = [0.0, 1.0, 2.0], [1.0, 3.0, 3.0], [1.0, 1.0, 3.0]
    assert cells_of(t, x, y, 2.0) == [
        Entry(0.0, 0, 0, STAND),
        Entry(0.0, 1, 0, DRIVE),
        Entry(1.0, 1, 1, DRIVE),
        Entry(2.0, 1, 1, STAND),
    ]


def test_a_stop_between_two_middles_prolongs_the_way():
    """Half a cell, three seconds of standing, the other half: two cells are held meanwhile."""
    t, x, y = [0.0, 0.5, 3.5, 4.0], [9.5, 9.0, 9.0, 8.5], [1.5] * 4
    entries = cells_of(t, x, y, 1.0)
    assert entries == [Entry(0.0, 9, 1, STAND), Entry(0.0, 8, 1, DRIVE), Entry(4.0, 8, 1, STAND)]
    behind = _walk([(10, 1), (9, 1)], begin=3.0)
    assert _kinds({"a": entries, "b": behind}) == []
    # It arrives at (9, 1) before the first has left it for good.
    assert _kinds({"a": entries, "b": _walk([(10, 1), (9, 1)], begin=2.5)}) == ["hold"]


@pytest.mark.parametrize(
    ("x", "y"),
    [
        ([9.5, 8.5, 7.5], [1.5, 1.3, 1.5]),  # weaving
        ([9.5, 9.1, 9.5], [1.5, 1.5, 1.5]),  # turning back half way
        ([9.1, 8.5, 7.5], [1.5, 1.5, 1.5]),  # beginning off the middle
    ],
)
def test_motion_off_the_lines_is_found(x, y):
    entries = cells_of([0.0, 1.0, 2.0], x, y, 1.0)
    assert "astray" in _kinds({"a": entries})


def test_sampled_lists_are_those_of_the_walk():
    """Ten samples a second, rounded to a micrometre, tell the same cells at the same times."""
    cells = _path((5, 2), (5, 1), (1, 1), (1, 0), (0, 0))
    entries = _walk(cells, begin=2.0, waits={(3, 1): 1.7})
    times = [round(0.1 * i, 6) for i in range(140)]
    xs, ys = zip(*(_where(entries, t) for t in times), strict=True)
    found = cells_of(times, [round(v, 6) for v in xs], [round(v, 6) for v in ys], 1.0)
    assert [(e.cell, e.state) for e in found] == [(e.cell, e.state) for e in entries]
    assert [e.t_enter for e in found] == pytest.approx([e.t_enter for e in entries], abs=1e-4)


def _where(entries, t):
    """Where the robot of a list is at a moment (m)."""
    for before, entry, after in zip(entries, entries[1:], entries[2:], strict=False):
        if entry.state == DRIVE and entry.t_enter <= t < after.t_enter:
            share = (t - entry.t_enter) / (after.t_enter - entry.t_enter)
            return (
                before.x + share * (entry.x - before.x) + 0.5,
                before.y + share * (entry.y - before.y) + 0.5,
            )
    last = [entry for entry in entries if entry.t_enter <= t][-1]
    return last.x + 0.5, last.y + 0.5
