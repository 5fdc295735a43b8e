"""Who waits where: each case of the paper's Figs. 11 to 13 in each set of regions (R-B48).

Crossroad: columns 12 (south), 13 (north), rows 8 (east), 9 (west). T crossing: columns 1, 2 with
the same rows. Robots drive a cell a second; `one` asks later than `other`, so it waits if both
would have to for as long.
"""

import pytest

from clearway import _core
from clearway.model import Layout
from clearway.plan.crossing_conflicts import Node, conflicts
from clearway.plan.waits_by_rule import CANNOT, ROUNDS, WaitsByRule
from clearway.world.channels import lane_grid

GRID = lane_grid(Layout("bidirectional"))
WIDTH, HEIGHT = GRID.size
STEP = 1000


def line(*corners):
    """Cells from corner to corner."""
    cells = [corners[0]]
    for x, y in corners[1:]:
        while cells[-1] != (x, y):
            u, v = cells[-1]
            cells.append((u + (x > u) - (x < u), v + (y > v) - (y < v)))
    return cells


def stays(cells, begin, wait=0):
    """A route that sets out at second ``begin`` and stands for ``wait`` seconds half-way."""
    route, tick = [], begin * STEP
    for k, (x, y) in enumerate(cells):
        depart = tick + (wait * STEP if k == len(cells) // 2 else 0)
        last = k == len(cells) - 1
        index = y * WIDTH + x
        route.append(_core.CellStay(index, tick, _core.NEVER if last else depart, depart, depart))
        tick = depart + STEP
    return route


def resolve(one, other, first=0, granted=-10_000):
    """Let a new route ``one`` meet a committed one; return how it came out."""
    holds = _core.CellHolds(WIDTH, HEIGHT, 2, STEP)
    holds.put(1, other)
    holds.put(0, [_core.CellStay(one[0].cell, one[0].arrive, _core.NEVER)])
    ruled = WaitsByRule(GRID, holds, STEP, ROUNDS)(0, one, first, granted)
    if ruled is not None:
        assert holds.clashes(0, ruled.stays) == []
    return ruled


HORIZONTAL_AHEAD = line((8, 8), (16, 8))  # east through the crossroad
SOUTH = line((12, 12), (12, 4))
NORTH = line((13, 4), (13, 12))
# Case: routes with the second at which they set out; who waits at which cell, and the equation.
CASES = {
    "node in crossroad, a-1 in H": (
        (HORIZONTAL_AHEAD, 0), (SOUTH, 0), "node in crossroad", "one", (11, 8), 13
    ),
    "node in crossroad, a-2 in H": (
        (HORIZONTAL_AHEAD, 0), (NORTH, 1), "node in crossroad", "one", (11, 8), 13
    ),
    "between in crossroad": (
        (HORIZONTAL_AHEAD, 0), (SOUTH, -1), "between in crossroad", "one", (11, 8), 13
    ),
    "swap in crossroad": (
        (HORIZONTAL_AHEAD, 0),
        (line((13, 4), (13, 8), (12, 8), (12, 4)), 0),
        "swap in crossroad",
        "one",
        (11, 8),
        13,
    ),
    "the horizontal one waits if it came first, too": (
        (SOUTH, 0), (HORIZONTAL_AHEAD, 0), "node in crossroad", "other", (11, 8), 13
    ),
    "both from L in crossroad": (
        (SOUTH, 0),
        (line((13, 4), (13, 9), (8, 9)), -3),
        "node in crossroad",
        "one",
        (12, 10),
        14,
    ),
    "both from H in crossroad": (
        (HORIZONTAL_AHEAD, 0),
        (line((16, 9), (12, 9), (12, 4)), -1),
        "node in crossroad",
        "one",
        (11, 8),
        14,
    ),
    "both from L in t-crossroad": (
        (line((1, 12), (1, 4)), 0),
        (line((2, 5), (2, 9), (0, 9)), -2),
        "node in t-crossroad",
        "one",
        (1, 10),
        16,
    ),
    "one from H in t-crossroad": (
        (line((6, 9), (1, 9), (1, 4)), 0),
        (line((1, 12), (1, 2)), 2),
        "node in t-crossroad",
        "one",
        (3, 9),
        15,
    ),
    "between in t-crossroad": (
        (line((6, 9), (1, 9), (1, 8)), 0),
        (line((1, 12), (1, 4)), 1),
        "between in t-crossroad",
        "one",
        (3, 9),
        15,
    ),
    "swap in t-crossroad": (
        (line((5, 9), (1, 9), (1, 6)), 0),
        (line((1, 12), (1, 9), (2, 9), (2, 12)), 0),
        "swap in t-crossroad",
        "one",
        (3, 9),
        15,
    ),
    "node in channel, one in N": (
        (line((5, 10), (5, 9), (3, 9)), 0),
        (line((8, 9), (1, 9), (1, 6)), -2),
        "node in channel",
        "one",
        (5, 10),
        18,
    ),
    "node in channel, the other in N": (
        (line((8, 9), (1, 9), (1, 6)), -2),
        (line((5, 10), (5, 9), (3, 9)), 0),
        "node in channel",
        "other",
        (5, 10),
        18,
    ),
    "between in channel, one leaves aside": (
        (line((8, 9), (3, 9)), -2),
        (line((8, 9), (5, 9), (5, 10)), -3),
        "between in channel",
        "one",
        (6, 9),
        17,
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_each_case_has_its_waiter_and_place(case):
    """The rule names the waiter; where it must not stand in a crossing, the node before."""
    (one, begin), (other, since), kind, waiter, place, equation = CASES[case]
    ruled = resolve(stays(one, begin), stays(other, since))
    pause = ruled.pauses[0]
    route = one if pause.robot == 0 else other
    assert next(iter(ruled.resolved)) == kind
    assert ("one", "other")[pause.robot] == waiter
    assert route[pause.index] == place
    assert pause.because.endswith(f"(eq. {equation})")
    # Who drives in front of another cannot let it pass.
    assert (CANNOT in pause.because) == (case == "between in channel, one leaves aside")


@pytest.mark.parametrize(("begin", "waiter", "by"), [(-4, 0, 1), (-3, 0, 2), (-2, 1, 1)])
def test_who_would_wait_longer_goes_first(begin, waiter, by):
    """By hand: the one holds (12, 9) in [2, 4] s, the other in [begin + 5, begin + 7] s.

    So the one would wait for begin + 5 s, the other for -1 - begin s.
    """
    ruled = resolve(stays(SOUTH, 0), stays(line((13, 4), (13, 9), (8, 9)), begin))
    assert [(pause.robot, pause.by) for pause in ruled.pauses] == [(waiter, by * STEP)]


def test_waits_in_crossings_are_none():
    """Whatever the moments, nobody ever waits inside a crossing."""
    for begin in range(-6, 7):
        for other in (SOUTH, NORTH, line((16, 9), (12, 9), (12, 4))):
            ruled = resolve(stays(HORIZONTAL_AHEAD, 0), stays(other, begin))
            for pause in ruled.pauses:
                x, y = (HORIZONTAL_AHEAD, other)[pause.robot][pause.index]
                assert not (x in (12, 13) and y in (8, 9))


def test_who_was_granted_a_cell_goes_first():
    """The horizontal one should wait, but has been told to go: the new one waits."""
    ruled = resolve(stays(SOUTH, 0), stays(HORIZONTAL_AHEAD, 0), granted=4 * STEP)
    assert [pause.robot for pause in ruled.pauses] == [0]
    assert CANNOT in ruled.pauses[0].because


def test_a_route_that_starts_in_anothers_way_stays_as_it_was():
    """Nobody can wait: the new one starts where the other comes, and that one may not wait."""
    holds = _core.CellHolds(WIDTH, HEIGHT, 2, STEP)
    holds.put(1, stays(SOUTH, 0))
    holds.put(0, stays([(12, 8)], 0))
    rules = WaitsByRule(GRID, holds, STEP, ROUNDS)
    assert rules(0, stays(line((12, 8), (16, 8)), 3), 0, 9 * STEP) is None
    assert [stay.cell for stay in holds.route(0)] == [8 * WIDTH + 12]
    assert holds.route(1)[-1].arrive == 8 * STEP


def test_the_papers_conditions_are_part_of_who_holds_what():
    """R-B29: wherever eqs. (5) to (11) tell a conflict, both hold a cell at once."""
    told = 0
    lines = [HORIZONTAL_AHEAD, SOUTH, NORTH, line((16, 9), (8, 9)), line((13, 4), (13, 9), (8, 9))]
    lines += [line((12, 12), (12, 8), (16, 8)), line((16, 9), (12, 9), (12, 4))]
    for one in lines:
        for other in lines:
            for begin in range(-8000, 8001, 250):
                for wait in (0, 1):
                    a, b = stays(one, 0), shifted(stays(other, 0, wait), begin)
                    found = list(conflicts(GRID, nodes(a), nodes(b), STEP))
                    told += bool(found)
                    holds = _core.CellHolds(WIDTH, HEIGHT, 2, STEP)
                    holds.put(1, b)
                    clashes = {(c.index, c.other_index) for c in holds.clashes(0, a)}
                    assert {(c.one, c.other) for c in found} <= clashes
    assert told > 500


def shifted(route, ticks):
    """The same route later."""
    return [
        _core.CellStay(
            s.cell, s.arrive + ticks, s.depart + (ticks if s.depart < _core.NEVER else 0)
        )
        for s in route
    ]


def nodes(route):
    """The same route as the conditions read it."""
    return [Node((s.cell % WIDTH, s.cell // WIDTH), s.arrive, s.depart) for s in route]
