"""The site as square cells: which are free for a body, and how far it is from one to another."""

import copy
import math

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from clearway.model import Site
from clearway.world.shapes import Shape, obstacle_shape

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Window = tuple[slice, slice]

# A point beside a blocked border of cells (a robot parked close to a wall) belongs to the
# nearest free cell at most this many cells away.
SNAP_CELLS = 2.0
# Searches that run at once: one bit of a 64-bit word each.
WORD = 64


class Grid:
    """Free cells of a site for one robot type in one load state, joined along their four sides.

    A cell is free when its centre lies within the bounds and at least ``inflate`` from every
    obstacle that blocks the type, and from the bounds too unless the site's border is open.
    No step from cell to cell crosses an obstacle.

    Parameters
    ----------
    type_name, loaded
        Whom the obstacles must block to count.
    inflate
        Distance (m) that a cell's centre keeps from obstacles; larger closes more passages.
    cell
        Side of a cell (m).
    """

    def __init__(
        self, site: Site, type_name: str, loaded: bool, inflate: float, cell: float = 1.0
    ) -> None:
        if not (math.isfinite(inflate) and inflate >= 0.0):
            raise ValueError(f"inflate must be 0 or above and finite, got {inflate}")
        if not (math.isfinite(cell) and cell > 0.0):
            raise ValueError(f"cell must be above 0 and finite, got {cell}")
        xs, ys = zip(*site.bounds, strict=True)
        self._x0, self._y0, self._cell = min(xs), min(ys), cell
        self._margin = max(inflate - 1e-9, 0.0)
        columns = math.ceil((max(xs) - min(xs)) / cell - 1e-9)
        rows = math.ceil((max(ys) - min(ys)) / cell - 1e-9)
        self._free = np.ones((rows, columns), dtype=np.bool_)
        # Whether nothing thin stands between a cell and the next one along x, along y.
        self._east, self._north = np.ones_like(self._free), np.ones_like(self._free)
        self._keep_within(site)
        for obstacle in site.obstacles:
            if obstacle.stops(type_name, loaded):
                self._block(obstacle_shape(obstacle))

    def distances(self, from_points: ArrayLike, to_points: ArrayLike) -> Floats:
        """Return the lengths of shortest paths over free cells.

        A point stands for the cell it lies in. One whose cell is not free uses the nearest
        free cell centre within two cells and pays the way to it.

        Parameters
        ----------
        from_points, to_points
            Positions (m), shapes ``(n, 2)`` and ``(m, 2)``.

        Returns
        -------
        Floats
            Shape ``(n, m)`` (m); infinite where there is no path.
        """
        sources, source_offsets = self._snap(from_points)
        targets, target_offsets = self._snap(to_points)
        steps = self._steps(sources, targets)
        return steps * self._cell + source_offsets[:, None] + target_offsets[None, :]

    def beside(self, shape: Shape) -> "Grid":
        """Return the grid with one more shape to keep away from."""
        grid = copy.copy(self)
        grid._free, grid._east, grid._north = (
            part.copy() for part in (self._free, self._east, self._north)
        )
        grid._block(shape)
        return grid

    def components(self, points: ArrayLike) -> Ints:
        """Return a number per point, equal where a path joins them; -1 where no cell is free."""
        cells, _ = self._snap(points)
        labels = self._label((slice(None), slice(None))).ravel()
        return np.where(cells >= 0, labels[cells], -1)

    def is_split_by(self, shape: Shape, reach: float) -> bool:
        """Whether a shape parts cells that are joined without leaving its neighbourhood.

        The neighbourhood is the shape's bounding box grown by ``reach`` (m): a longer way round
        does not count, so that the shape closes a passage if this is true.
        """
        window = self._window(shape, reach)
        closed = self.beside(shape)
        free = closed._free[window]
        old, new = self._label(window)[free], closed._label(window)[free]
        pieces = np.unique(np.stack([old, new]), axis=1)
        return bool(pieces.shape[1] > np.unique(old).size)

    def _keep_within(self, site: Site) -> None:
        everywhere = (slice(None), slice(None))
        bounds = shapely.Polygon(site.bounds)
        shapely.prepare(bounds)
        self._free &= shapely.covers(bounds, shapely.points(*self._centres(everywhere)))
        if site.border == "closed":
            self._keep_away(Shape(bounds.exterior), everywhere)

    def _block(self, shape: Shape) -> None:
        self._keep_away(shape, self._window(shape, self._margin + self._cell))

    def _keep_away(self, shape: Shape, window: Window) -> None:
        """Close the cells of a window that are too near a shape, and steps that cross it."""
        shapely.prepare(shape.geometry)
        x, y = self._centres(window)
        near = self._margin + shape.radius
        self._free[window] &= ~shapely.dwithin(shape.geometry, shapely.points(x, y), near)
        if self._margin < self._cell / 2.0:
            for steps, dx, dy in ((self._east, self._cell, 0.0), (self._north, 0.0, self._cell)):
                ends = np.stack([np.stack([x, y], -1), np.stack([x + dx, y + dy], -1)], -2)
                crossing = shapely.dwithin(shape.geometry, shapely.linestrings(ends), shape.radius)
                steps[window] &= ~crossing

    def _centres(self, window: Window) -> tuple[Floats, Floats]:
        """Return x and y (m) of the cells of a window."""
        rows, columns = self._free.shape
        y = self._y0 + (np.arange(rows)[window[0]] + 0.5) * self._cell
        x = self._x0 + (np.arange(columns)[window[1]] + 0.5) * self._cell
        across, along = np.meshgrid(x, y)
        return across, along

    def _window(self, shape: Shape, reach: float) -> Window:
        """Return the rows and columns whose cells come within ``reach`` of a shape's box."""
        x_min, y_min, x_max, y_max = shape.geometry.bounds
        grown = shape.radius + reach
        first = (y_min - grown - self._y0, x_min - grown - self._x0)
        last = (y_max + grown - self._y0, x_max + grown - self._x0)
        low = [max(math.floor(value / self._cell), 0) for value in first]
        high = [max(math.floor(value / self._cell) + 1, 0) for value in last]
        return slice(low[0], high[0]), slice(low[1], high[1])

    def _snap(self, points: ArrayLike) -> tuple[Ints, Floats]:
        """Return each point's free cell (flat index, -1: none) and the way to its centre (m)."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        rows, columns = self._free.shape
        column = np.floor((xy[:, 0] - self._x0) / self._cell).astype(np.int64)
        row = np.floor((xy[:, 1] - self._y0) / self._cell).astype(np.int64)
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        cells = np.where(inside, row * columns + column, -1)
        offsets = np.zeros(len(xy))
        free = np.flatnonzero(self._free)
        lost = np.flatnonzero(~(inside & self._free.ravel()[cells]))
        if lost.size == 0 or free.size == 0:
            cells[lost], offsets[lost] = -1, math.inf
            return cells, offsets
        centre_x = self._x0 + (free % columns + 0.5) * self._cell
        centre_y = self._y0 + (free // columns + 0.5) * self._cell
        gap = np.hypot(xy[lost, :1] - centre_x, xy[lost, 1:] - centre_y)
        nearest = gap.argmin(axis=1)
        offsets[lost] = gap[np.arange(lost.size), nearest]
        near = offsets[lost] <= SNAP_CELLS * self._cell
        cells[lost] = np.where(near, free[nearest], -1)
        offsets[lost[~near]] = math.inf
        return cells, offsets

    def _steps(self, sources: Ints, targets: Ints) -> Floats:
        """Return the number of cell-to-cell steps, by breadth-first search from 64 cells at once.

        Each cell holds one word; bit i tells whether the search from source i is there.
        """
        free, east, north = (
            np.where(part, ~np.uint64(0), np.uint64(0))
            for part in (self._free, self._east[:, :-1], self._north[:-1])
        )
        steps = np.full((len(sources), len(targets)), math.inf)
        known, ends = np.flatnonzero(sources >= 0), np.flatnonzero(targets >= 0)
        for first in range(0, len(known), WORD):
            rank = known[first : first + WORD]
            bits = np.uint64(1) << np.arange(len(rank), dtype=np.uint64)
            front = np.zeros_like(free)
            np.bitwise_or.at(front.reshape(-1), sources[rank], bits)
            unseen = free & ~front
            step = 0
            while front.any():
                arrived = front.reshape(-1)[targets[ends]]
                if arrived.any():
                    source, target = np.nonzero(arrived & bits[:, None])
                    steps[rank[source], ends[target]] = step
                spread = np.zeros_like(front)
                spread[:, 1:] |= front[:, :-1] & east
                spread[:, :-1] |= front[:, 1:] & east
                spread[1:] |= front[:-1] & north
                spread[:-1] |= front[1:] & north
                front = spread & unseen
                unseen &= ~front
                step += 1
        return steps

    def _label(self, window: Window) -> Ints:
        """Return a number per cell of a window, equal where cells are joined within it."""
        from scipy import ndimage

        free = self._free[window]
        # Cells lie on even rows and columns of the picture, the steps between them on odd ones.
        rows, columns = free.shape
        picture = np.zeros((2 * rows, 2 * columns), dtype=np.bool_)
        picture[::2, ::2] = free
        picture[::2, 1::2] = self._east[window]
        picture[1::2, ::2] = self._north[window]
        labels, _ = ndimage.label(picture)
        return np.asarray(labels[::2, ::2], dtype=np.int64)
