"""The dynamic map: which moves a route between two endpoints may make."""

from functools import cache
from typing import Literal

from clearway.world.lane_grid import STEPS, Cell, LaneGrid
from clearway.world.move_map import MoveMap, moves_along_lanes, moves_into
from clearway.world.open_cells import OpenCells
from clearway.world.sub_areas import SubAreas

__all__ = ["DynamicMap", "MapMode", "MoveMap"]

MapMode = Literal["literal", "completed"]

_Move = tuple[Cell, int]  # from a cell, in a direction


class DynamicMap:
    """Moves between two endpoints; called with start and goal, it returns a `MoveMap`.

    In a bidirectional layout, start and goal each have an apron: the two channel cells across
    from it, where robots may change lanes. Start and goal are left and entered from and to the
    channel cells beside them. A start on a channel has no apron.

    Parameters
    ----------
    mode
        ``completed``: moves between channel cells follow a lane, or stay within an apron.
        ``literal``: the paper's map of cells that are open or closed, for bidirectional layouts;
        any move between two open channel cells is legal.

    Raises
    ------
    ValueError
        If the mode is unknown, or ``literal`` for a one-way layout; when called, if no channel
        leads to start or goal.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 3, Algorithms 1, 2 and 3-1 to 3-4.

    Deviations
    ----------
    Aprons are kept open in the literal map too: without them many pairs of shelves have no way.
    Where the algorithms say nothing (same block or same channel), moves follow the lanes.
    """

    def __init__(self, grid: LaneGrid, mode: MapMode = "completed") -> None:
        self._grid = grid
        self._areas = SubAreas(grid)
        self._both_ways = grid.name == "bidirectional"
        if mode not in ("literal", "completed"):
            raise ValueError(f"map mode must be 'literal' or 'completed', got {mode!r}")
        if mode == "literal" and not self._both_ways:
            raise ValueError(
                f"map mode 'literal' is for bidirectional layouts, not {grid.name!r}; "
                "use 'completed'"
            )
        self._along_lanes = moves_along_lanes(grid)
        self._open_cells = OpenCells(grid, self._areas) if mode == "literal" else None
        # Endpoints are few and asked about often.
        self._apron_moves = cache(self._find_apron_moves)
        self._access = cache(self._find_access)

    def __call__(self, start: Cell, goal: Cell) -> MoveMap:
        """Return the moves that are legal from start to goal."""
        if self._open_cells is None:
            moves = self._along_lanes.copy()
            self._add(moves, self._apron_moves(start) + self._apron_moves(goal))
        else:
            moves = self._literal(self._open_cells, start, goal)
        self._add(moves, self._access(start, True) + self._access(goal, False))
        return moves

    def apron(self, end: Cell) -> tuple[Cell, ...]:
        """Return the channel cells among which a robot from or to an endpoint may change lanes."""
        if not self._both_ways or self._grid.is_channel(end):
            return ()
        n, m = self._areas(end)
        x, y = end
        if n == 0:
            return tuple((self._areas.columns[0] + i, y) for i in range(self._areas.breadth))
        return tuple((x, self._areas.rows[m - 1] + i) for i in range(self._areas.breadth))

    def _literal(self, open_cells: OpenCells, start: Cell, goal: Cell) -> MoveMap:
        cells = open_cells(start, goal)
        for x, y in self.apron(start) + self.apron(goal):
            cells[y, x] = True
        moves = moves_into(cells) * cells
        (n1, m1), (n2, m2) = self._areas(start), self._areas(goal)
        if n1 == n2 or m1 == m2:
            moves &= self._along_lanes
            self._add(moves, self._apron_moves(start) + self._apron_moves(goal))
        return moves

    def _find_apron_moves(self, end: Cell) -> tuple[_Move, ...]:
        apron = self.apron(end)
        return tuple(
            ((x, y), bit)
            for x, y in apron
            for bit, (dx, dy) in STEPS.items()
            if (x + dx, y + dy) in apron
        )

    def _find_access(self, end: Cell, leaving: bool) -> tuple[_Move, ...]:
        if self._grid.is_channel(end):
            return ()
        entrances = self._grid.entrances(end)
        if not entrances:
            raise ValueError(f"no channel leads to cell {end}; name an endpoint")
        moves: list[_Move] = []
        for bit, (dx, dy) in STEPS.items():
            if leaving and (end[0] + dx, end[1] + dy) in entrances:
                moves.append((end, bit))
            before = (end[0] - dx, end[1] - dy)
            if not leaving and before in entrances:
                moves.append((before, bit))
        return tuple(moves)

    def _add(self, moves: MoveMap, more: tuple[_Move, ...]) -> None:
        for (x, y), bit in more:
            moves[y, x] |= bit
