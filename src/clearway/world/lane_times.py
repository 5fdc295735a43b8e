"""Least driving times between endpoints of a lane grid, nobody else being there."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from clearway.model import Scenario
from clearway.world.channels import lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import STEPS, Cell, LaneGrid

Floats = NDArray[np.float64]


class LaneTimes:
    """Durations of the fastest routes between endpoints (s), any heading at start and goal.

    Moves follow lanes, or stay within the apron of the start or of the goal, as on the completed
    dynamic map. Routes through one start are searched when they are first asked for.

    Parameters
    ----------
    speed
        Of straight driving (m/s).
    turn
        Time per turn of 90 degrees on the way (s).
    """

    def __init__(self, grid: LaneGrid, speed: float = 1.0, turn: float = 0.0) -> None:
        self.names = tuple(grid.endpoints)
        self.number = {name: k for k, name in enumerate(self.names)}
        self._step = grid.cell / speed
        self._turn = turn
        self._headings = 4 if turn > 0.0 else 1
        self._tails: list[int] = []
        self._heads: list[int] = []
        self._costs: list[float] = []
        self._size = 0
        self._build(grid)
        shape = (self._size, self._size)
        edges = (np.array(self._tails), np.array(self._heads))
        self._graph = csr_array((np.array(self._costs), edges), shape=shape)
        self._rows: dict[int, Floats] = {}

    @classmethod
    def of(cls, scenario: Scenario) -> "LaneTimes":
        """Return the times of a scenario's robots, all of the first one's type, on its layout.

        Raises
        ------
        ValueError
            If the site has no layout.
        """
        if scenario.site.layout is None:
            raise ValueError(f"scenario {scenario.name}: give the site a layout to have lanes")
        limits = scenario.type_of(scenario.robots[0]).limits
        turn = 0.0 if limits.yaw_rate is None else math.pi / 2.0 / limits.yaw_rate
        return cls(lane_grid(scenario.site.layout), limits.speed, turn)

    def __call__(self, start: str, goal: str) -> float:
        """Return the least driving time (s) from one endpoint to another; 0 to itself."""
        return float(self.row(start)[self.number[goal]])

    def row(self, start: str) -> Floats:
        """Return the least driving times (s) from an endpoint to all, in the order of ``names``."""
        k = self.number[start]
        if k not in self._rows:
            self._search([k])
        return self._rows[k]

    def matrix(self) -> Floats:
        """Return the least driving times (s) between all endpoints, ``(starts, goals)``."""
        self._search([k for k in range(len(self.names)) if k not in self._rows])
        return np.array([self._rows[k] for k in range(len(self.names))])

    def _search(self, starts: list[int]) -> None:
        if not starts:
            return
        far = dijkstra(self._graph, indices=[self._out + k for k in starts])
        for k, reached in zip(starts, far, strict=True):
            row = reached[self._in : self._in + len(self.names)].copy()
            row[k] = 0.0
            self._rows[k] = row

    def _nodes(self, cells: list[Cell]) -> dict[Cell, int]:
        """Return the first of new nodes for each cell, one per heading."""
        first = {cell: self._size + i * self._headings for i, cell in enumerate(cells)}
        self._size += len(cells) * self._headings
        return first

    def _edge(self, tail: int, head: int, cost: float) -> None:
        self._tails.append(tail)
        self._heads.append(head)
        self._costs.append(cost)

    def _move(self, tail: int, head: int, direction: int, is_end: bool = False) -> None:
        """Add a move out of a cell's nodes into those of another, or into an endpoint."""
        for heading in range(self._headings):
            quarters = abs(direction - heading) % 4 if self._headings > 1 else 0
            cost = self._step + self._turn * min(quarters, 4 - quarters)
            self._edge(tail + heading, head if is_end else head + self._into(direction), cost)

    def _into(self, direction: int) -> int:
        return direction if self._headings > 1 else 0

    def _build(self, grid: LaneGrid) -> None:
        height, width = grid.region.shape
        cells = [(x, y) for y in range(height) for x in range(width) if grid.is_channel((x, y))]
        main = self._nodes(cells)
        for x, y in cells:
            for direction, (bit, (dx, dy)) in enumerate(STEPS.items()):
                beside = (x + dx, y + dy)
                if grid.lanes[y, x] & bit and beside in main:
                    self._move(main[x, y], main[beside], direction)
        self._out = self._size
        self._in = self._size + len(grid.endpoints)
        self._size += 2 * len(grid.endpoints)
        maps = DynamicMap(grid)
        for k, point in enumerate(grid.endpoints.values()):
            apron = list(maps.apron(point.cell))
            # Within its apron a route may go against lanes: copies of those cells, before and
            # after the part that follows lanes.
            before, after = self._nodes(apron), self._nodes(apron)
            for x, y in apron:
                for heading in range(self._headings):
                    self._edge(before[x, y] + heading, main[x, y] + heading, 0.0)
                    self._edge(main[x, y] + heading, after[x, y] + heading, 0.0)
                for direction, (dx, dy) in enumerate(STEPS.values()):
                    if (x + dx, y + dy) in before:
                        for copy in (before, after):
                            self._move(copy[x, y], copy[x + dx, y + dy], direction)
            for direction, (dx, dy) in enumerate(STEPS.values()):
                beside = (point.cell[0] + dx, point.cell[1] + dy)
                if beside not in main:
                    continue
                out = before.get(beside, main[beside])
                self._edge(self._out + k, out + self._into(direction), self._step)
                back = (direction + 2) % 4
                self._move(after.get(beside, main[beside]), self._in + k, back, is_end=True)
