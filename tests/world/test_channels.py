"""Layouts of channels: the recovered ones cell by cell, and what holds for all."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clearway.model import Layout
from clearway.world.channels import RULES, agv_type, lane_grid, site_of
from clearway.world.lane_grid import (
    CROSSING,
    EAST,
    HORIZONTAL,
    LONGITUDINAL,
    NORTH,
    SOUTH,
    T_CROSSING,
    VOID,
    WEST,
)
from clearway.world.move_map import cut_off
from clearway.world.sub_areas import SubAreas

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"
REGIONS = {"H": HORIZONTAL, "L": LONGITUDINAL, "T": T_CROSSING, "R": CROSSING}
DIRECTIONS = {"E": EAST, "N": NORTH, "W": WEST, "S": SOUTH}
KEYS = {"station": "packing", "shelf": "shelves", "charger": "chargers"}

layouts = st.builds(
    Layout,
    rule=st.sampled_from(sorted(RULES)),
    blocks=st.lists(st.integers(1, 6), min_size=1, max_size=5)
    .filter(lambda blocks: len(blocks) % 2 == 1)
    .map(tuple),
    bands=st.integers(0, 4).map(lambda i: 2 * i + 1),
)


@pytest.mark.parametrize("rule", RULES)
def test_layouts_equal_the_recovered_ones(rule):
    """Every endpoint, every channel cell's region and lanes."""
    grid = lane_grid(Layout(rule))
    given = json.loads((LAYOUTS / f"{rule}.json").read_text())
    assert grid.size == (given["width"], given["height"])
    for kind, key in KEYS.items():
        assert [list(point.cell) for point in grid.of_kind(kind)] == given[key]
    for cell in given["channel_cells"]:
        x, y = cell["c"]
        assert grid.region[y, x] == REGIONS[cell["set"]]
        assert grid.lanes[y, x] == sum(DIRECTIONS[d] for d in cell["dirs"])
    assert np.count_nonzero(grid.lanes) == given["counts"]["channel"]
    for name, region in REGIONS.items():
        assert np.count_nonzero(grid.region == region) == given["counts"][name]


def test_the_papers_warehouse_has_its_numbers():
    """30 packing stations, 33 chargers, 406 shelves (Sec. 2); 176 cells lead nowhere else."""
    grid = lane_grid(Layout("bidirectional"))
    assert [len(grid.of_kind(kind)) for kind in ("station", "charger", "shelf")] == [30, 33, 406]
    assert grid.endpoints["p30"].cell == (0, 29)
    assert grid.endpoints["c1"].cell == (3, 30)
    assert grid.endpoints["g30"].cell == (3, 3)
    assert np.count_nonzero(grid.region == VOID) == 3
    # Both lanes of 8 channels along the 11 columns of the third block.
    outside = cut_off(grid)
    assert np.count_nonzero(outside) == 8 * 2 * 11
    assert not outside[:, :25].any()


def test_each_shelf_opens_onto_one_horizontal_lane():
    """The lower row of a pair downwards onto the westbound lane, the upper one onto the other."""
    grid = lane_grid(Layout("bidirectional"))
    sideways = {
        shelf.cell[0] for shelf in grid.of_kind("shelf") if len(_entrances(grid, shelf)) > 1
    }
    assert sideways == {3, 11, 14, 22, 25}
    for shelf in grid.of_kind("shelf"):
        x, y = shelf.cell
        along = [cell for cell in _entrances(grid, shelf) if cell[0] == x]
        down = y % 4 == 2
        assert along == [(x, y - 1 if down else y + 1)]
        assert grid.lanes[along[0][1], x] == (WEST if down else EAST)


def _entrances(grid, shelf):
    return grid.entrances(shelf.cell)


@pytest.mark.parametrize(
    ("cell", "sub_area"),
    [((0, 0), (0, 1)), ((2, 6), (0, 2)), ((3, 2), (1, 1)), ((13, 3), (1, 2)), ((14, 28), (2, 8)),
     ((24, 27), (2, 8)), ((25, 26), (3, 7)), ((35, 30), (3, 8))],
)  # fmt: skip
def test_sub_areas_are_numbered_as_in_the_paper(cell, sub_area):
    """n = floor((x - 3) / 11) + 1 from column 3 on, m = floor((y + 1) / 4) + 1."""
    assert SubAreas(lane_grid(Layout("bidirectional")))(cell) == sub_area


def test_a_shelf_and_the_channel_it_opens_onto_share_a_sub_area():
    for rule in RULES:
        grid = lane_grid(Layout(rule))
        areas = SubAreas(grid)
        for shelf in grid.of_kind("shelf"):
            x, _ = shelf.cell
            along = [cell for cell in grid.entrances(shelf.cell) if cell[0] == x]
            assert [areas(cell) for cell in along] == [areas(shelf.cell)]


def test_blocks_of_10_10_and_9_hold_the_same_shelves():
    grid = lane_grid(Layout("bidirectional", blocks=(10, 10, 9)))
    assert grid.size == (36, 31)
    assert len(grid.of_kind("shelf")) == 406
    assert SubAreas(grid).columns == (1, 13, 25)


@given(layouts)
@settings(max_examples=60, deadline=None)
def test_any_layout_has_ways_between_all_its_channels(layout):
    """One-way channels are all connected; of bidirectional ones all but the last block."""
    grid = lane_grid(layout)
    shelves = 2 * layout.bands * sum(layout.blocks)
    assert len(grid.of_kind("shelf")) == shelves
    breadth = RULES[layout.rule].breadth
    last = breadth * (layout.bands + 1) * layout.blocks[-1]
    both_ways = layout.rule == "bidirectional"
    assert np.count_nonzero(cut_off(grid)) == (last if both_ways else 0)
    assert all(grid.entrances(point.cell) for point in grid.endpoints.values())
    assert len({point.cell for point in grid.endpoints.values()}) == len(grid.endpoints)


def test_a_warehouse_for_five_hundred_robots_has_room():
    grid = lane_grid(Layout("bidirectional", bands=175))
    assert grid.size == (36, 703)
    assert len(grid.of_kind("shelf")) == 25 * 406


@pytest.mark.parametrize(
    ("layout", "words"),
    [
        (Layout("roundabout"), "layout.rule must be one of bidirectional, compact, one_way"),
        (Layout("compact", blocks=()), "layout.blocks must be lengths of at least 1"),
        (Layout("compact", blocks=(9, 0, 11)), r"got \[9, 0, 11\]"),
        (Layout("compact", bands=0), "layout.bands must be at least 1, got 0"),
        (Layout("bidirectional", cell=0.0), "layout.cell must be above 0 m, got 0"),
        (Layout("one_way", bands=6), "layout.bands: rule 'one_way' needs an odd number"),
        (Layout("compact", blocks=(9, 9)), "layout.blocks: rule 'compact' needs an odd number"),
    ],
)
def test_what_makes_no_warehouse_is_refused(layout, words):
    with pytest.raises(ValueError, match=words):
        lane_grid(layout)


def test_a_site_has_a_zone_for_each_endpoint():
    """With a cell of 2 m, shelf (3, 2) lies from (6, 4) to (8, 6)."""
    layout = Layout("bidirectional", cell=2.0)
    site = site_of(layout)
    assert site.layout == layout
    assert site.bounds == ((0.0, 0.0), (72.0, 0.0), (72.0, 62.0), (0.0, 62.0))
    assert [len(site.zones_of(kind)) for kind in KEYS] == [30, 406, 33]
    shelf = next(zone for zone in site.zones if zone.name == "g1")
    assert shelf.kind == "shelf"
    assert shelf.polygon == ((6.0, 4.0), (8.0, 4.0), (8.0, 6.0), (6.0, 6.0))
    assert shelf.pose == (7.0, 5.0, 0.0)


def test_the_robot_turns_within_its_cell():
    """0.7 m square: half the diagonal is 0.495 m. A quarter turn in 2 s is pi/4 a second."""
    agv = agv_type(Layout("bidirectional"), 2.0)
    corners = [point for part in agv.footprint.parts for point in part]
    assert max(math.hypot(*corner) for corner in corners) == pytest.approx(0.495, abs=1e-3)
    assert (agv.limits.speed, agv.limits.reverse_speed) == (1.0, 0.0)
    assert agv.limits.yaw_rate == pytest.approx(math.pi / 4.0)
    assert agv_type(Layout("bidirectional"), 0.0).limits.yaw_rate is None
    with pytest.raises(ValueError, match="turn_seconds"):
        agv_type(Layout("bidirectional"), -1.0)
