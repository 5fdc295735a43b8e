"""Sub-areas of a layout: the block and the channel that a cell belongs to."""

import numpy as np

from clearway.world.lane_grid import HORIZONTAL, LONGITUDINAL, Cell, LaneGrid


class SubAreas:
    """Numbers (n, m) of the sub-area of a cell, as in paper B, Sec. 5.2.

    ``n`` is 0 in and left of the first longitudinal channel, else the number of the block, with
    the channel to the right of it, from 1. ``m`` is the number, from 1 at the bottom, of the
    horizontal channel that the cell is part of or opens onto.

    Parameters
    ----------
    columns, rows
        First column of each longitudinal channel and first row of each horizontal one.
    breadth
        Cells across a channel.
    """

    columns: tuple[int, ...]
    rows: tuple[int, ...]
    breadth: int

    def __init__(self, grid: LaneGrid) -> None:
        across = np.flatnonzero((grid.region == LONGITUDINAL).any(axis=0))
        along = np.flatnonzero((grid.region == HORIZONTAL).any(axis=1))
        self.columns = _firsts(across)
        self.rows = _firsts(along)
        self.breadth = len(across) // len(self.columns)

    def __call__(self, cell: Cell) -> tuple[int, int]:
        """Return (n, m)."""
        x, y = cell
        n = sum(column + self.breadth <= x for column in self.columns)
        return n, sum(row - 1 <= y for row in self.rows)


def _firsts(numbers: np.ndarray[tuple[int], np.dtype[np.intp]]) -> tuple[int, ...]:
    """Return the first of each run of successive numbers."""
    given = {int(number) for number in numbers}
    return tuple(sorted(number for number in given if number - 1 not in given))
