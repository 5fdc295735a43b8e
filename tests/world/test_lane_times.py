"""Least driving times between endpoints."""

import heapq
import itertools
import math
import random

import pytest

from clearway.model import Layout
from clearway.world.channels import lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import STEPS, Cell, LaneGrid
from clearway.world.lane_times import LaneTimes
from clearway.world.shelf_batch import shelf_batch


def least_time(grid: LaneGrid, start: Cell, goal: Cell, step: float, turn: float) -> float:
    """Search cells and headings on the completed map of one start and goal, nothing clever."""
    moves = DynamicMap(grid)(start, goal)
    best = {(start, None): 0.0}
    queue: list[tuple[float, int, Cell, int | None]] = [(0.0, 0, start, None)]
    number = itertools.count(1)
    while queue:
        cost, _, cell, heading = heapq.heappop(queue)
        if cell == goal:
            return cost
        for direction, (bit, (dx, dy)) in enumerate(STEPS.items()):
            if not moves[cell[1], cell[0]] & bit:
                continue
            quarters = 0 if heading is None else abs(direction - heading) % 4
            new = cost + step + turn * min(quarters, 4 - quarters)
            state = ((cell[0] + dx, cell[1] + dy), direction)
            if new < best.get(state, math.inf):
                best[state] = new
                heapq.heappush(queue, (new, next(number), *state))
    return math.inf


@pytest.mark.parametrize("rule", ["bidirectional", "compact", "one_way"])
@pytest.mark.parametrize("turn", [0.0, 1.0])
def test_times_are_those_of_a_search_on_the_dynamic_map(rule: str, turn: float) -> None:
    """200 pairs of any kinds of endpoints, at half a metre a second."""
    grid = lane_grid(Layout(rule))
    times = LaneTimes(grid, 0.5, turn)
    draw = random.Random(3)
    for _ in range(200):
        a, b = draw.sample(list(grid.endpoints.values()), 2)
        assert times(a.name, b.name) == pytest.approx(least_time(grid, a.cell, b.cell, 2.0, turn))


def test_rows_and_matrix_agree_and_nothing_is_far_from_itself() -> None:
    grid = lane_grid(Layout("bidirectional", (3, 2), 2))
    times, other = LaneTimes(grid), LaneTimes(grid)
    matrix = times.matrix()
    assert (matrix.diagonal() == 0.0).all()
    assert (matrix[4] == other.row(times.names[4])).all()


def test_times_of_a_scenario_know_how_long_its_robots_turn() -> None:
    """The shelf g1 at (3, 2) opens downward onto the westbound row 1, in which p2 lies.

    So the way is down, then west three times, with one turn.
    """
    layout = Layout("bidirectional", (3,), 1)
    grid = lane_grid(layout)
    straight = LaneTimes.of(shelf_batch(layout, 1, 1, 0))
    turning = LaneTimes.of(shelf_batch(layout, 1, 1, 0, turn_seconds=1.0))
    for name in grid.endpoints:
        assert straight("g1", name) == LaneTimes(grid)("g1", name)
        assert turning("g1", name) == pytest.approx(LaneTimes(grid, turn=1.0)("g1", name))
    assert straight("g1", "p2") == 4.0
    assert turning("g1", "p2") == 5.0
