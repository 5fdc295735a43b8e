"""Routes on lane grids: the least time, and the same one whenever it is asked for."""

import itertools
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.oracles.grid_dijkstra import least_ticks, ticks_of

from clearway.model import Layout
from clearway.plan.route_search import RouteSearch
from clearway.world.channels import RULES, lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import EAST, NORTH, SOUTH, STEPS, WEST, LaneGrid


def _open_floor(width, height):
    """A floor where every move is legal, and no lanes."""
    moves = np.zeros((height, width), np.uint8)
    moves[:, :-1] |= EAST
    moves[:-1, :] |= NORTH
    moves[:, 1:] |= WEST
    moves[1:, :] |= SOUTH
    empty = np.zeros((height, width), np.uint8)
    return LaneGrid("floor", 1.0, empty.astype(np.int8), empty, {}), moves


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("turn", [0, 1000, 2500])
def test_routes_take_the_least_time(rule, turn):
    grid = lane_grid(Layout(rule))
    dynamic, search = DynamicMap(grid), RouteSearch(grid, 1000, turn)
    cells = [point.cell for point in grid.endpoints.values()]
    dice = random.Random(11)
    for _ in range(100):
        start, goal = dice.sample(cells, 2)
        heading = dice.choice([None, *STEPS])
        moves = dynamic(start, goal)
        route = search(moves, start, goal, heading)
        assert route is not None
        assert ticks_of(route, heading, 1000, turn) == least_ticks(
            moves, start, goal, heading, 1000, turn
        )


@given(
    moves=st.lists(st.integers(0, 15), min_size=30, max_size=30),
    lanes=st.lists(st.integers(0, 15), min_size=30, max_size=30),
    ends=st.tuples(st.integers(0, 29), st.integers(0, 29)),
    heading=st.sampled_from([None, *STEPS]),
    turn=st.integers(0, 3),
)
@settings(deadline=None)
def test_routes_take_the_least_time_on_any_map_of_moves(moves, lanes, ends, heading, turn):
    """Whatever moves are legal: 6 x 5 cells, and none where there is no way."""
    _, inside = _open_floor(6, 5)
    grid = LaneGrid("any", 1.0, np.zeros((5, 6), np.int8), np.uint8(lanes).reshape(5, 6), {})
    legal = np.uint8(moves).reshape(5, 6) & inside
    start, goal = ((end % 6, end // 6) for end in ends)
    route = RouteSearch(grid, 2, turn)(legal, start, goal, heading)
    least = least_ticks(legal, start, goal, heading, 2, turn)
    if route is None:
        assert least is None
        return
    assert (route[0], route[-1]) == (start, goal)
    assert ticks_of(route, heading, 2, turn) == least
    for (ax, ay), (bx, by) in itertools.pairwise(route):
        assert legal[ay, ax] & {step: bit for bit, step in STEPS.items()}[bx - ax, by - ay]


def test_a_turn_back_counts_as_two():
    """Out of a dead end to the west, heading east: 2 s of turning, then one step."""
    grid, moves = _open_floor(2, 1)
    assert RouteSearch(grid, 1000, 1000)(moves, (1, 0), (0, 0), EAST) == ((1, 0), (0, 0))
    # Round a block: two turns of 90 degrees instead of one by 180 cost no less.
    grid, moves = _open_floor(3, 2)
    route = RouteSearch(grid, 1000, 5000)(moves, (1, 0), (0, 0), EAST)
    assert route is not None
    assert ticks_of(route, EAST, 1000, 5000) == 11_000


def test_among_equals_straight_ahead_goes_first():
    """On an open floor all monotone routes are equal: straight on, then one turn."""
    grid, moves = _open_floor(4, 4)
    search = RouteSearch(grid, 1000, 0)
    assert search(moves, (0, 0), (3, 3), NORTH) == tuple(
        [(0, y) for y in range(4)] + [(x, 3) for x in range(1, 4)]
    )
    assert search(moves, (0, 0), (3, 3), EAST) == tuple(
        [(x, 0) for x in range(4)] + [(3, y) for y in range(1, 4)]
    )


def test_among_equals_lanes_go_first():
    """Of two ways round with one turn each, the one along the lane is taken."""
    grid, moves = _open_floor(3, 3)
    for bit in (EAST, NORTH):
        grid.lanes[:] = 0
        grid.lanes[0, 0] = bit
        route = RouteSearch(grid, 1000, 0)(moves, (0, 0), (2, 2), None)
        assert route is not None
        assert route[1] == STEPS[bit]


def test_routes_are_repeatable():
    """A search that has been used answers as a new one does."""
    grid = lane_grid(Layout("bidirectional"))
    dynamic, used = DynamicMap(grid), RouteSearch(grid, 1000, 0)
    cells = [point.cell for point in grid.endpoints.values()]
    dice = random.Random(5)
    for _ in range(200):
        start, goal = dice.sample(cells, 2)
        moves = dynamic(start, goal)
        first = used(moves, start, goal, None)
        fresh = RouteSearch(grid, 1000, 0)
        assert fresh(moves, start, goal, None) == first
        assert fresh.expansions == used.expansions


def test_where_one_stands_is_reached_and_closed_cells_are_not():
    grid, moves = _open_floor(3, 3)
    search = RouteSearch(grid, 1000, 0)
    assert search(moves, (1, 1), (1, 1), None) == ((1, 1),)
    assert search(np.zeros_like(moves), (0, 0), (2, 2), None) is None


def test_what_is_off_the_grid_is_refused():
    grid, moves = _open_floor(3, 2)
    search = RouteSearch(grid, 1000, 0)
    with pytest.raises(ValueError, match="lanes' shape"):
        search(moves.reshape(2, 3).T.copy(), (0, 0), (1, 1), None)
    with pytest.raises(ValueError, match=r"cell \(3, 0\) is not on the grid of 3 x 2 cells"):
        search(moves, (0, 0), (3, 0), None)
    with pytest.raises(ValueError, match=r"cell \(0, -1\) is not"):
        search(moves, (0, -1), (1, 0), None)
    moves[0, 2] |= EAST
    with pytest.raises(ValueError, match="off the grid"):
        search(moves, (2, 0), (0, 1), None)
    with pytest.raises(ValueError, match="step must be above 0"):
        RouteSearch(grid, 0, 0)
