"""Which moves a route may make, on the paper's warehouse and its one-way counterparts."""

import itertools
import random

import numpy as np
import pytest

from clearway.model import Layout
from clearway.plan.route_search import RouteSearch
from clearway.world.channels import RULES, lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import EAST, NORTH, SOUTH, STEPS, WEST

EDITED = 14  # moves that differ from the lanes at most: two aprons, start and goal left and entered


def _lane_steps(grid):
    """All steps between channel cells that follow a lane."""
    width, height = grid.size
    return {
        ((x, y), (x + dx, y + dy))
        for x in range(width)
        for y in range(height)
        for bit, (dx, dy) in STEPS.items()
        if grid.lanes[y, x] & bit and grid.is_channel((x + dx, y + dy))
    }


def _apron(cell):
    """The two channel cells across from an endpoint of the paper's warehouse."""
    x, y = cell
    if x == 0:
        return {(1, y), (2, y)}
    row = 4 * ((y + 1) // 4)
    return {(x, row), (x, row + 1)}


def _is_legal(steps, has_aprons, route):
    """Whether all moves follow lanes, or stay in an apron, and endpoints are the ends only."""
    others = [step for step in itertools.pairwise(route[1:-1]) if step not in steps]
    aprons = [_apron(route[0]), _apron(route[-1])] if has_aprons else []
    return len(route) >= 3 and all(
        any(apron.issuperset(step) for apron in aprons) for step in others
    )


@pytest.mark.parametrize("rule", RULES)
def test_every_shelf_is_linked_with_every_station_and_charger(rule):
    """Both ways, never against a lane."""
    grid = lane_grid(Layout(rule))
    moves, search, steps = DynamicMap(grid), RouteSearch(grid, 1000, 0), _lane_steps(grid)
    others = grid.of_kind("station") + grid.of_kind("charger")
    for shelf, other in itertools.product(grid.of_kind("shelf"), others):
        for start, goal in ((shelf.cell, other.cell), (other.cell, shelf.cell)):
            route = search(moves(start, goal), start, goal, None)
            assert route is not None, (start, goal)
            assert route[0] == start
            assert route[-1] == goal
            assert _is_legal(steps, rule == "bidirectional", route), route


@pytest.mark.parametrize("rule", RULES)
def test_shelves_are_linked_with_shelves(rule):
    grid = lane_grid(Layout(rule))
    moves, search, steps = DynamicMap(grid), RouteSearch(grid, 1000, 0), _lane_steps(grid)
    shelves = [shelf.cell for shelf in grid.of_kind("shelf")]
    dice = random.Random(3)
    for _ in range(3000):
        start, goal = dice.sample(shelves, 2)
        route = search(moves(start, goal), start, goal, None)
        assert route is not None, (start, goal)
        assert _is_legal(steps, rule == "bidirectional", route), route


def test_lanes_are_changed_across_from_start_and_goal_only():
    """From shelf (5, 2), which opens onto the westbound lane, to station (0, 4)."""
    grid = lane_grid(Layout("bidirectional"))
    dynamic = DynamicMap(grid)
    moves = dynamic((5, 2), (0, 4))
    assert dynamic.apron((5, 2)) == ((5, 0), (5, 1))
    assert dynamic.apron((0, 4)) == ((1, 4), (2, 4))
    assert moves[2, 5] == SOUTH
    assert moves[1, 5] == WEST | SOUTH
    assert moves[0, 5] == EAST | NORTH
    assert moves[4, 2] == EAST | NORTH | WEST
    assert moves[4, 1] == EAST | SOUTH | WEST  # the last one enters the station
    assert moves[1, 6] == WEST  # not into shelf (6, 2)
    plain = DynamicMap(grid)((20, 10), (0, 20))
    assert 0 < np.count_nonzero(moves != plain) <= EDITED


def test_a_map_leaves_nothing_behind_for_the_next_one():
    grid = lane_grid(Layout("bidirectional"))
    for mode in ("completed", "literal"):
        dynamic = DynamicMap(grid, mode)
        first = dynamic((5, 2), (0, 4))
        dynamic((30, 10), (12, 30))
        assert (dynamic((5, 2), (0, 4)) == first).all()


def test_one_way_layouts_have_no_aprons():
    for rule in ("compact", "one_way"):
        grid = lane_grid(Layout(rule))
        dynamic = DynamicMap(grid)
        start, goal = grid.endpoints["g7"].cell, grid.endpoints["p3"].cell
        assert dynamic.apron(start) == ()
        channel = grid.lanes > 0
        # Beyond lanes there are only the moves into the goal.
        more = dynamic(start, goal)[channel] & ~grid.lanes[channel]
        assert sorted(more[more > 0]) == [WEST]


def test_from_a_channel_one_follows_the_lanes_at_once():
    """A robot on the westbound lane at (5, 1) goes all the way round to (5, 3)."""
    grid = lane_grid(Layout("bidirectional"))
    moves = DynamicMap(grid)((5, 1), (5, 3))
    assert moves[1, 5] == WEST
    route = RouteSearch(grid, 1, 0)(moves, (5, 1), (5, 3), None)
    assert route is not None
    assert route[1:4] == ((4, 1), (3, 1), (2, 1))


def test_the_literal_map_agrees_with_the_completed_one():
    """R-B23: a legal route of the same length in 99.9 % of 2000 pairs, the rest apron shortcuts."""
    grid = lane_grid(Layout("bidirectional"))
    completed, literal = DynamicMap(grid), DynamicMap(grid, "literal")
    search = RouteSearch(grid, 1, 0)
    cells = {kind: [point.cell for point in grid.of_kind(kind)] for kind in ("shelf", "station")}
    cells["charger"] = [point.cell for point in grid.of_kind("charger")]
    legs = [("shelf", "station"), ("station", "shelf"), ("shelf", "charger"), ("charger", "shelf")]
    dice = random.Random(7)
    differ = 0
    for i in range(2000):
        kinds = legs[i % len(legs)]
        start, goal = (dice.choice(cells[kind]) for kind in kinds)
        legal = completed(start, goal)
        best = search(legal, start, goal, None)
        own = search(literal(start, goal), start, goal, None)
        both = search(legal & literal(start, goal), start, goal, None)
        assert best is not None
        assert own is not None
        differ += both is None or len(both) != len(best)
    assert differ <= 2


def test_the_literal_map_closes_the_lanes_that_lead_back():
    """From shelf (5, 6) to shelf (30, 22), to the upper right: Algorithms 1, 2 and 3-3."""
    grid = lane_grid(Layout("bidirectional"))
    moves = DynamicMap(grid, "literal")((5, 6), (30, 22))
    assert moves[4, 4] == 0  # eastbound, west of the start
    assert moves[4, 6] == EAST | WEST  # the row east of it is open; so is the cell behind
    assert moves[5, 8] == 0  # westbound, east of the start
    assert moves[9, 16] == 0  # westbound, between the channels of start and goal
    assert moves[7, 12] == 0  # southbound, above the start's channel
    assert moves[7, 13] == NORTH | SOUTH  # northbound: a cell that is open lets through both ways
    assert moves[3, 13] == 0  # northbound, below it
    assert moves[20, 33] == 0  # eastbound, east of the goal
    assert moves[5, 6] == 0
    assert moves[5, 5] == WEST | SOUTH  # of the apron


def test_the_literal_map_closes_the_left_channel_away_from_a_station():
    """From station (0, 9) to the upper right, Algorithm 1; to it from there, Algorithm 2."""
    grid = lane_grid(Layout("bidirectional"))
    moves = DynamicMap(grid, "literal")((0, 9), (30, 22))
    assert moves[10, 1] == moves[12, 1] == moves[13, 1] == 0  # southbound, above
    assert moves[7, 2] == 0  # northbound, below
    assert moves[5, 2] & EAST  # but its crossings are re-opened
    assert moves[9, 6] == 0  # westbound, in the station's channel
    assert moves[8, 6] == EAST | WEST
    moves = DynamicMap(grid, "literal")((30, 22), (0, 9))
    assert moves[7, 1] == moves[5, 1] == 0  # southbound, below
    assert moves[10, 2] == 0  # northbound, above
    assert moves[8, 6] == 0  # eastbound, in the station's channel
    assert moves[9, 6] == EAST | WEST


def test_where_the_literal_map_says_nothing_moves_follow_the_lanes():
    """From shelf (5, 6) to shelf (8, 22) in the same block, and to (30, 7) in the same channel."""
    grid = lane_grid(Layout("bidirectional"))
    moves = DynamicMap(grid, "literal")((5, 6), (8, 22))
    assert moves[14, 2] == NORTH
    assert moves[14, 1] == SOUTH
    moves = DynamicMap(grid, "literal")((5, 6), (30, 3))
    assert moves[4, 20] == EAST


def test_modes_and_places_that_do_not_exist_are_refused():
    with pytest.raises(ValueError, match="'literal' is for bidirectional layouts, not 'compact'"):
        DynamicMap(lane_grid(Layout("compact")), "literal")
    with pytest.raises(ValueError, match="'literal' or 'completed', got 'paper'"):
        DynamicMap(lane_grid(Layout("bidirectional")), "paper")
    with pytest.raises(ValueError, match=r"no channel leads to cell \(0, 30\)"):
        DynamicMap(lane_grid(Layout("bidirectional")))((0, 30), (3, 2))
