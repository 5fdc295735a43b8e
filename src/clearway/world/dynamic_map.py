"""The dynamic map: which moves a route between two endpoints may make."""

from typing import Literal

from clearway.world.lane_grid import STEPS, Cell, LaneGrid
from clearway.world.move_map import MoveMap, moves_along_lanes
from clearway.world.sub_areas import SubAreas

MapMode = Literal["literal", "completed"]


class DynamicMap:
    """Moves between two endpoints; called with start and goal, it returns a `MoveMap`.

    Parameters
    ----------
    mode
        ``completed``: moves between channel cells follow a lane, or stay within an apron: the two
        channel cells across from the start, or from the goal, where robots of a bidirectional
        layout may change lanes. ``literal``: the paper's map of cells that are open or closed, for
        bidirectional layouts; any move between two open channel cells is legal. In both modes,
        start and goal are left and entered from and to the channel cells beside them.

    Raises
    ------
    ValueError
        If the mode is unknown, or ``literal`` for a one-way layout.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Algorithms 1, 2 and 3-1 to 3-4.

    Deviations
    ----------
    Aprons are kept open: without them one in twenty pairs of shelves has no way. Where the
    algorithms say nothing (same block or same channel), moves follow the lanes.
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
        self._mode = mode
        self._along_lanes = moves_along_lanes(grid)

    def __call__(self, start: Cell, goal: Cell) -> MoveMap:
        """Return the moves that are legal from start to goal."""
        moves = self._along_lanes.copy()
        for end in (start, goal):
            self._add_apron(moves, end)
        self._add_access(moves, start, goal)
        return moves

    def apron(self, end: Cell) -> tuple[Cell, ...]:
        """Return the channel cells among which a robot to or from there may change lanes."""
        if not self._both_ways or self._grid.is_channel(end):
            return ()
        n, m = self._areas(end)
        x, y = end
        if n == 0:
            return tuple((self._areas.columns[0] + i, y) for i in range(self._areas.breadth))
        return tuple((x, self._areas.rows[m - 1] + i) for i in range(self._areas.breadth))

    def _add_apron(self, moves: MoveMap, end: Cell) -> None:
        apron = set(self.apron(end))
        for x, y in apron:
            for bit, (dx, dy) in STEPS.items():
                if (x + dx, y + dy) in apron:
                    moves[y, x] |= bit

    def _add_access(self, moves: MoveMap, start: Cell, goal: Cell) -> None:
        for bit, (dx, dy) in STEPS.items():
            if (start[0] + dx, start[1] + dy) in self._entrances(start):
                moves[start[1], start[0]] |= bit
            before = (goal[0] - dx, goal[1] - dy)
            if before in self._entrances(goal):
                moves[before[1], before[0]] |= bit

    def _entrances(self, end: Cell) -> tuple[Cell, ...]:
        """Return the channel cells beside an endpoint; none for a channel cell."""
        if self._grid.is_channel(end):
            return ()
        entrances = self._grid.entrances(end)
        if not entrances:
            raise ValueError(f"no channel leads to cell {end}; name an endpoint")
        return entrances
