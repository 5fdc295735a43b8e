"""Dijkstra over cells and headings of a map of moves: what a route search must find."""

import heapq
import itertools

from clearway.world.lane_grid import STEPS, Cell
from clearway.world.move_map import MoveMap


def least_ticks(
    moves: MoveMap, start: Cell, goal: Cell, heading: int | None, step: int, turn: int
) -> int | None:
    """Return the ticks of a best route; ``None``: there is no way."""
    order = list(STEPS)
    reached: set[tuple[Cell, int | None]] = set()
    queue = [(0, start, heading if heading is None else order.index(heading))]
    while queue:
        ticks, cell, before = heapq.heappop(queue)
        if cell == goal:
            return ticks
        if (cell, before) in reached:
            continue
        reached.add((cell, before))
        for after, bit in enumerate(order):
            if moves[cell[1], cell[0]] & bit:
                dx, dy = STEPS[bit]
                quarters = 0 if before is None else min((after - before) % 4, (before - after) % 4)
                heapq.heappush(
                    queue, (ticks + step + turn * quarters, (cell[0] + dx, cell[1] + dy), after)
                )
    return None


def ticks_of(route: tuple[Cell, ...], heading: int | None, step: int, turn: int) -> int:
    """Return what a route costs."""
    order = list(STEPS.values())
    before = None if heading is None else list(STEPS).index(heading)
    ticks = 0
    for (ax, ay), (bx, by) in itertools.pairwise(route):
        after = order.index((bx - ax, by - ay))
        quarters = 0 if before is None else min((after - before) % 4, (before - after) % 4)
        ticks += step + turn * quarters
        before = after
    return ticks
