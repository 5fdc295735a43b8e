"""Warehouses of shelves between channels, made by rule: the layouts of system B's paper."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from clearway.model import Layout
from clearway.world.lane_grid import (
    CROSSING,
    EAST,
    ENDPOINT,
    HORIZONTAL,
    LONGITUDINAL,
    NORTH,
    SOUTH,
    STEPS,
    T_CROSSING,
    VOID,
    WEST,
    Cell,
    Endpoint,
    LaneGrid,
)

BESIDE = 2  # rows of shelves between two channels, one opening onto each


@dataclass(frozen=True)
class Rule:
    """How channels are built: cells across, traffic both ways in each, one at the right wall."""

    breadth: int
    both_ways: bool
    right_wall: bool


RULES = {
    "bidirectional": Rule(breadth=2, both_ways=True, right_wall=False),
    "compact": Rule(breadth=1, both_ways=False, right_wall=True),
    "one_way": Rule(breadth=2, both_ways=False, right_wall=True),
}
PAPER = Layout("bidirectional")
# Shelves, stations and chargers at the paper's size.
PAPER_COUNTS = {
    "bidirectional": (406, 30, 33),
    "compact": (406, 22, 32),
    "one_way": (406, 30, 35),
}


def lane_grid(layout: Layout) -> LaneGrid:
    """Return the cells, lanes and endpoints of a layout.

    Stations ``p1``, ... stand along the left wall from bottom to top, chargers ``c1``, ... along
    the upper one from left to right, places for shelves ``g1``, ... in rows from the bottom. In a
    bidirectional channel robots keep right, so that crossings turn anticlockwise; one-way channels
    take turns: the lowest leads east and the leftmost south.

    Raises
    ------
    ValueError
        If the rule is unknown or the numbers give no such warehouse.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Dynamic scheduling optimization method for multi-AGV-based
    intelligent warehouse considering bidirectional channel. Systems 12(1), 9. Secs. 3 and 5.3;
    the one-way counterparts are our reconstruction.
    """
    _check(layout)
    rule = RULES[layout.rule]
    columns, rows = _starts(layout)
    width = 1 + sum(layout.blocks) + rule.breadth * len(columns)
    height = rows[-1] + rule.breadth + 1
    lanes = np.zeros((height, width), np.uint8)
    region = np.full((height, width), VOID, np.int8)
    for i, x in enumerate(columns):
        for j in range(rule.breadth):
            south = j == 0 if rule.both_ways else i % 2 == 0
            lanes[:-1, x + j] |= SOUTH if south else NORTH
        region[:-1, x : x + rule.breadth] = LONGITUDINAL
    for i, y in enumerate(rows):
        for j in range(rule.breadth):
            east = j == 0 if rule.both_ways else i % 2 == 0
            lanes[y + j, 1:] |= EAST if east else WEST
        region[y : y + rule.breadth, 1:] = HORIZONTAL
        for x in columns:
            outer = y in (rows[0], rows[-1]) or x == columns[0]
            outer = outer or (rule.right_wall and x == columns[-1])
            crossing = np.s_[y : y + rule.breadth, x : x + rule.breadth]
            region[crossing] = T_CROSSING if outer else CROSSING
    endpoints = _endpoints(layout, width, height)
    for point in endpoints:
        region[point.cell[1], point.cell[0]] = ENDPOINT
    grid = LaneGrid(
        layout.rule, layout.cell, region, lanes, {point.name: point for point in endpoints}
    )
    _assert_facts(layout, grid)
    return grid


def _check(layout: Layout) -> None:
    if layout.rule not in RULES:
        raise ValueError(f"layout.rule must be one of {', '.join(RULES)}, got {layout.rule!r}")
    if not layout.blocks or min(layout.blocks) < 1:
        raise ValueError(
            f"layout.blocks must be lengths of at least 1 cell, got {list(layout.blocks)}; "
            f"the paper's are {list(PAPER.blocks)}"
        )
    if layout.bands < 1:
        raise ValueError(f"layout.bands must be at least 1, got {layout.bands}; give 1 or more")
    if not layout.cell > 0.0:
        raise ValueError(f"layout.cell must be above 0 m, got {layout.cell}; the paper has 1")
    if not RULES[layout.rule].both_ways:
        for key, number in (("blocks", len(layout.blocks)), ("bands", layout.bands)):
            if number % 2 == 0:
                raise ValueError(
                    f"layout.{key}: rule {layout.rule!r} needs an odd number of {key}, got "
                    f"{number}, or the outer channels are no loop; add one or take one away"
                )


def _starts(layout: Layout) -> tuple[list[int], list[int]]:
    """Return the first column of each longitudinal and the first row of each other channel."""
    rule = RULES[layout.rule]
    columns = [1]
    for block in layout.blocks:
        columns.append(columns[-1] + rule.breadth + block)
    if not rule.right_wall:
        columns.pop()
    return columns, [(rule.breadth + BESIDE) * i for i in range(layout.bands + 1)]


def _endpoints(layout: Layout, width: int, height: int) -> list[Endpoint]:
    breadth = RULES[layout.rule].breadth
    columns, rows = _starts(layout)
    shelves = [
        (x, y + breadth + row)
        for y in rows[:-1]
        for row in range(BESIDE)
        for start, block in zip(columns, layout.blocks, strict=False)
        for x in range(start + breadth, start + breadth + block)
    ]
    stations = [(0, y) for y in range(height - 1)]
    chargers = [(x, height - 1) for x in range(1 + breadth, width)]
    return [
        *_named("p", "station", stations),
        *_named("g", "shelf", shelves),
        *_named("c", "charger", chargers),
    ]


def _named(letter: str, kind: str, cells: Iterable[Cell]) -> list[Endpoint]:
    return [Endpoint(f"{letter}{i + 1}", kind, cell) for i, cell in enumerate(cells)]


def _assert_facts(layout: Layout, grid: LaneGrid) -> None:
    """Hold a layout against what is known of it."""
    rule = RULES[layout.rule]
    if (layout.blocks, layout.bands) == (PAPER.blocks, PAPER.bands):
        counts = tuple(len(grid.of_kind(kind)) for kind in ("shelf", "station", "charger"))
        assert counts == PAPER_COUNTS[layout.rule], counts
    left_out = ~one_component(grid)
    if rule.right_wall:
        assert not left_out.any()
    else:
        # Nothing leads round the far end of the last block: one turns in aprons only.
        last = grid.region == HORIZONTAL
        last[:, : grid.size[0] - layout.blocks[-1]] = False
        assert (left_out == last).all()


def one_component(grid: LaneGrid) -> NDArray[np.bool_]:
    """Mark what is not cut off by lanes: the largest strongly connected part, and no channel.

    Returns
    -------
    Shape ``(height, width)``: false for channel cells outside that part only.
    """
    channel = grid.region >= HORIZONTAL
    height, width = channel.shape
    number = np.arange(height * width).reshape(height, width)
    tails, heads = [], []
    for bit, (dx, dy) in STEPS.items():
        y, x = np.nonzero(channel & ((grid.lanes & bit) != 0))
        inside = (0 <= x + dx) & (x + dx < width) & (0 <= y + dy) & (y + dy < height)
        y, x = y[inside], x[inside]
        leads = channel[y + dy, x + dx]
        tails.append(number[y, x][leads])
        heads.append(number[y + dy, x + dx][leads])
    tail, head = np.concatenate(tails), np.concatenate(heads)
    graph = coo_array((np.ones(len(tail)), (tail, head)), shape=(channel.size, channel.size))
    _, label = connected_components(graph, connection="strong")
    label = np.asarray(label).reshape(height, width)
    largest = np.bincount(label[channel]).argmax()
    return np.asarray((label == largest) | ~channel)
