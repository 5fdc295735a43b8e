"""Warehouses of shelves between channels, made by rule: the layouts of system B's paper."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from clearway.model import Battery, Footprint, Layout, Limits, Polygon, RobotType, Site, Zone
from clearway.world.lane_grid import (
    CROSSING,
    EAST,
    ENDPOINT,
    HORIZONTAL,
    LONGITUDINAL,
    NORTH,
    SOUTH,
    T_CROSSING,
    VOID,
    WEST,
    Cell,
    Endpoint,
    LaneGrid,
)
from clearway.world.move_map import cut_off

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
# Shelves, stations, chargers, width and height (cells) at the paper's size.
PAPER_COUNTS = {
    "bidirectional": (406, 30, 33, 36, 31),
    "compact": (406, 22, 32, 34, 23),
    "one_way": (406, 30, 35, 38, 31),
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


def site_of(layout: Layout) -> Site:
    """Return a layout as a site: a zone of one cell for each endpoint, its pose in the middle.

    Raises
    ------
    ValueError
        As `lane_grid`.
    """
    grid = lane_grid(layout)
    width, height = grid.size
    zones = tuple(
        Zone(point.name, point.kind, _box(grid, point.cell, (1, 1)), grid.centre(point.cell))
        for point in grid.endpoints.values()
    )
    return Site(_box(grid, (0, 0), (width, height)), zones=zones, layout=layout)


def agv_type(layout: Layout, turn_seconds: float = 0.0) -> RobotType:
    """Return the robot of system B: a square that turns within its cell, one cell a second.

    Its diagonal is 0.99 of a cell. A full battery lasts for 5000 s.

    Parameters
    ----------
    turn_seconds
        For a turn by 90 degrees; 0: turning takes no time.

    Raises
    ------
    ValueError
        If the time is below 0.
    """
    if turn_seconds < 0.0:
        raise ValueError(f"turn_seconds must be 0 or above, got {turn_seconds}")
    return RobotType(
        name="agv",
        footprint=Footprint.rectangle(0.7 * layout.cell, 0.7 * layout.cell),
        kinematics="differential",
        limits=Limits(
            speed=layout.cell,
            reverse_speed=0.0,
            yaw_rate=math.pi / 2.0 / turn_seconds if turn_seconds else None,
        ),
        battery=Battery(capacity=5000.0, reserve=0.2, charging=500.0, full=0.95),
    )


def _box(grid: LaneGrid, cell: Cell, size: tuple[int, int]) -> Polygon:
    """Return the rectangle of cells whose lower left one is given."""
    x0, y0 = cell[0] * grid.cell, cell[1] * grid.cell
    x1, y1 = (cell[0] + size[0]) * grid.cell, (cell[1] + size[1]) * grid.cell
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


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
        assert counts + grid.size == PAPER_COUNTS[layout.rule], counts
    # Every shelf opens onto one horizontal channel, below or above it.
    x, y = np.array([point.cell for point in grid.of_kind("shelf")]).T
    channel = grid.region == HORIZONTAL
    assert (channel[y - 1, x] ^ channel[y + 1, x]).all()
    left_out = cut_off(grid)
    if not rule.right_wall:
        # Nothing leads round the far end of the last block: robots turn round in aprons there.
        last = left_out[:, -layout.blocks[-1] :]
        assert np.count_nonzero(last) == rule.breadth * (layout.bands + 1) * layout.blocks[-1]
        last[:] = False
    assert not left_out.any()
