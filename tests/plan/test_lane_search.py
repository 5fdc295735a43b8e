"""The search over intervals on lanes, against brute force tick by tick and by hand."""

import random

import numpy as np
import pytest
from tests.oracles.lane_brute_force import Occupied, earliest

from clearway import _core

STEP, QUARTER = 2, 1
LIMIT = 100_000


def walk(rng, width, height):
    """A random route: waits, turns, and a rest for ever."""
    cell, tick = rng.randrange(width * height), rng.randrange(12)
    stays = []
    for _ in range(rng.randrange(1, 9)):
        x, y = cell % width, cell // width
        ways = [
            n
            for n, (a, b) in zip(
                (cell + 1, cell + width, cell - 1, cell - width),
                ((x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)),
                strict=True,
            )
            if 0 <= a < width and 0 <= b < height
        ]
        turn = rng.choice((0, 0, 1, 2))
        depart = tick + turn + rng.choice((0, 0, 0, 3))
        stays.append(_core.CellStay(cell, tick, depart, depart - turn, depart))
        cell, tick = rng.choice(ways), depart + STEP
    return [*stays, _core.CellStay(cell, tick, _core.NEVER)]


def random_case(seed):
    rng = random.Random(seed)
    width, height = rng.choice(((4, 3), (3, 3), (5, 2)))
    moves = np.array(
        [[rng.choice((15, 15, 5, 10, 7, 13)) for _ in range(width)] for _ in range(height)],
        np.uint8,
    )
    may_wait = np.array(
        [[rng.random() < 0.6 for _ in range(width)] for _ in range(height)], np.uint8
    )
    start, goal = rng.sample(range(width * height), 2)
    routes = [walk(rng, width, height) for _ in range(rng.randrange(0, 6))]
    # Nobody else ever comes to the start or rests at the goal.
    routes = [
        route
        for route in routes
        if all(stay.cell != start for stay in route) and route[-1].cell != goal
    ]
    return width, height, moves, may_wait, start, goal, routes


@pytest.mark.parametrize("wide", [False, True])
@pytest.mark.parametrize("block", range(4))
def test_arrivals_are_those_of_brute_force(block, wide):
    """Random lanes, crossings and passers-by: as early as any timed route can be."""
    found = 0
    for seed in range(100 * block, 100 * block + 100):
        width, height, moves, may_wait, start, goal, routes = random_case(seed)
        holds = _core.CellHolds(width, height, len(routes) + 1, STEP, wide)
        for number, route in enumerate(routes, 1):
            holds.put(number, route)
        first, last = [0, 1, 2, 1], [1, 2, 1, 0]
        search = _core.LaneSearch(holds, may_wait, QUARTER)
        way = search(moves, 0, start, goal, 5, 0, first, last, LIMIT)
        expected = earliest(
            moves,
            may_wait,
            Occupied(routes, width),
            (start % width, start // width),
            (goal % width, goal // width),
            5,
            first,
            last,
            STEP,
            QUARTER,
            wide,
        )
        assert (way.ready if way.found else None) == expected, seed
        if way.found:
            found += 1
            assert holds.clashes(0, way.stays) == [], seed
            waits = [a.turn_begin > a.arrive for a in way.stays[:-1]]
            assert all(
                may_wait[stay.cell // width, stay.cell % width] or stay.cell == start
                for stay, waits_here in zip(way.stays, waits, strict=False)
                if waits_here
            )
    assert found > 30
