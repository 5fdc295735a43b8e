"""Best routes between two cells of a lane grid."""

from clearway import _core
from clearway.world.lane_grid import STEPS, Cell, LaneGrid
from clearway.world.move_map import MoveMap


class RouteSearch:
    """A* over cells and headings; called with legal moves, start and goal, it returns the cells.

    The cost is time: ``step_ticks`` to the next cell, ``turn_ticks`` for each 90 degrees. Among
    equals straight ahead goes first, then along a lane; the same question has the same answer.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 4.1, eqs. (1)-(4).

    Deviations
    ----------
    Four neighbours: the paper says eight, but measures distance as Manhattan does, and along its
    bidirectional channels no diagonal step leads the right way round both its corners.
    """

    def __init__(self, grid: LaneGrid, step_ticks: int, turn_ticks: int) -> None:
        self._width, self._height = grid.size
        self._search = _core.RouteSearch(grid.lanes, step_ticks, turn_ticks)

    def __call__(
        self, moves: MoveMap, start: Cell, goal: Cell, heading: int | None
    ) -> tuple[Cell, ...] | None:
        """Return the cells from start to goal, both among them; ``None``: there is no way.

        Parameters
        ----------
        heading
            One of the directions of `clearway.world.lane_grid` in which the robot points at the
            start; ``None``: it may set out in any without turning.

        Raises
        ------
        ValueError
            If a cell or a move that comes up is not on the grid, or ``moves`` is of another size.
        """
        number = -1 if heading is None else tuple(STEPS).index(heading)
        found = self._search(moves, self._number(start), self._number(goal), number)
        return tuple((cell % self._width, cell // self._width) for cell in found) or None

    @property
    def expansions(self) -> int:
        """Nodes expanded in the last search."""
        return self._search.expansions

    def _number(self, cell: Cell) -> int:
        x, y = cell
        if not (0 <= x < self._width and 0 <= y < self._height):
            raise ValueError(
                f"cell {cell} is not on the grid of {self._width} x {self._height} cells"
            )
        return y * self._width + x
