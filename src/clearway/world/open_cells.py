"""Algorithms 1, 2 and 3-1 to 3-4 of paper B: the map of open cells for a start and a goal."""

import numpy as np
from numpy.typing import NDArray

from clearway.world.lane_grid import HORIZONTAL, LONGITUDINAL, Cell, LaneGrid
from clearway.world.sub_areas import SubAreas

Cells = NDArray[np.bool_]


class OpenCells:
    """Closes lanes that lead the wrong way; called with start and goal, it returns what is open.

    A map is shape ``(height, width)``, true where a channel cell is open. Rows are closed along
    blocks and columns beside them only, since crossings are re-opened; those of the leftmost
    column are not, where it is closed for a station.

    Parameters
    ----------
    grid
        Of a bidirectional layout: the lower row of a channel leads east, the left column south.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 5.2. ``m`` and ``n`` are those of
    `SubAreas`, 1 the start and 2 the goal, as there; its two periods (L+1 and L+2) are read as one.
    """

    def __init__(self, grid: LaneGrid, areas: SubAreas) -> None:
        self._areas = areas
        self._channel: Cells = grid.region >= HORIZONTAL
        self._rows: Cells = grid.region == HORIZONTAL
        self._columns: Cells = grid.region == LONGITUDINAL
        self._south = list(areas.columns)
        self._north = [column + 1 for column in areas.columns]

    def __call__(self, start: Cell, goal: Cell) -> Cells:
        """Return the open cells; aprons are the caller's to open."""
        cells = self._channel.copy()
        self._between(cells, start, goal)
        self._around_start(cells, start)
        self._around_goal(cells, goal)
        return cells

    def _around_start(self, cells: Cells, start: Cell) -> None:
        """Algorithm 1: whoever sets out may move away from the start only."""
        (x1, y1), (n1, m1) = start, self._areas(start)
        if n1 == 0:
            self._close_left_channel(cells, above=self._south[0], below=self._north[0], y=y1)
            return
        east = self._areas.rows[m1 - 1]
        west = east + 1
        cells[east, :x1] &= ~self._rows[east, :x1]
        cells[west, x1 + 1 :] &= ~self._rows[west, x1 + 1 :]
        self._close_columns(cells, self._north, slice(None, east))
        self._close_columns(cells, self._south[1:], slice(west + 1, None))

    def _around_goal(self, cells: Cells, goal: Cell) -> None:
        """Algorithm 2: whoever arrives may move towards the goal only."""
        (x2, y2), (n2, m2) = goal, self._areas(goal)
        if n2 == 0:
            self._close_left_channel(cells, above=self._north[0], below=self._south[0], y=y2)
            return
        east = self._areas.rows[m2 - 1]
        west = east + 1
        cells[west, :x2] &= ~self._rows[west, :x2]
        cells[east, x2 + 1 :] &= ~self._rows[east, x2 + 1 :]
        self._close_columns(cells, self._south[1:], slice(None, east))
        self._close_columns(cells, self._north, slice(west + 1, None))

    def _between(self, cells: Cells, start: Cell, goal: Cell) -> None:
        """Algorithms 3-1 to 3-4: between two channels nobody turns back."""
        (n1, m1), (n2, m2) = self._areas(start), self._areas(goal)
        if n1 == n2 or m1 == m2:
            return
        low, high = min(m1, m2), max(m1, m2)
        # Of the channel of a station, Algorithms 1 and 2 close no row.
        channels = [*range(low + 1, high), *(m for n, m in ((n1, m1), (n2, m2)) if n == 0)]
        for m in channels:
            wrong = self._areas.rows[m - 1] + (n1 < n2)
            cells[wrong] &= ~self._rows[wrong]
        columns = self._south if m2 > m1 else self._north
        self._close_columns(
            cells, columns, slice(self._areas.rows[low - 1] + 2, self._areas.rows[high - 1])
        )

    def _close_columns(self, cells: Cells, columns: list[int], rows: slice) -> None:
        for x in columns:
            cells[rows, x] &= ~self._columns[rows, x]

    def _close_left_channel(self, cells: Cells, *, above: int, below: int, y: int) -> None:
        """Close one column of the left channel above a row, the other below it."""
        for x, rows in ((above, slice(y + 1, None)), (below, slice(None, y))):
            reopened = self._channel[rows, x] & ~self._columns[rows, x]
            cells[rows, x] &= reopened if x == self._north[0] else False
