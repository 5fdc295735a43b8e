"""The ways a fleet's widest disc has between obstacles, and whether a standing body closes one."""

import copy
import math

import numpy as np
import shapely
from numpy.typing import NDArray

from clearway.model import Footprint, Polygon, Pose, Site

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Window = tuple[slice, slice]

SPARE = 0.1  # beyond the disc's radius (m)
LARGEST_CELL = 0.5


class Passages:
    """Cells of a closed site whose middle may be the disc's centre, joined along their sides.

    Unlike `Reach`, which grants too much in order to prove that there is no way, this grants
    too little: cells that are joined have a way between them.

    Parameters
    ----------
    radius
        Radius of the disc (m).
    """

    def __init__(self, site: Site, radius: float) -> None:
        self._keep_off = radius + SPARE
        self._cell = min(LARGEST_CELL, radius / 2.0)
        x0, y0, x1, y1 = shapely.Polygon(site.bounds).bounds
        self._xs = np.arange(x0 + self._cell / 2.0, x1, self._cell)
        self._ys = np.arange(y0 + self._cell / 2.0, y1, self._cell)
        self._free = np.ones((len(self._ys), len(self._xs)), dtype=np.bool_)
        self._free &= self._inside(site.bounds, (slice(None), slice(None)))
        self._block_edges(site.bounds)
        for obstacle in site.obstacles:
            if obstacle.polygon is not None:
                window = self._window(np.array(obstacle.polygon), 0.0)
                self._free[window] &= ~self._inside(obstacle.polygon, window)
                self._block_edges(obstacle.polygon)
            elif obstacle.wall is not None:
                self._block_edges(obstacle.wall)
            elif obstacle.disc is not None:
                x, y, r = obstacle.disc
                self._block_body(Footprint(radius=r), Pose(x, y, 0.0))
        self._main = self._near_main(radius)

    def beside(self) -> "Passages":
        """Return a copy in which other bodies may come to stand."""
        other = copy.copy(self)
        other._free = self._free.copy()
        return other

    def leads_to(self, x: float, y: float) -> bool:
        """Whether the largest connected part of the site, without bodies, comes to a point."""
        row = round((y - self._ys[0]) / self._cell)
        column = round((x - self._xs[0]) / self._cell)
        rows, columns = self._main.shape
        return 0 <= row < rows and 0 <= column < columns and bool(self._main[row, column])

    def is_closed_by(self, footprint: Footprint, pose: Pose, reach: float) -> bool:
        """Whether a body would part cells that are joined near it.

        A way round that leaves the body's box grown by ``reach`` (m) does not count.
        """
        from scipy import ndimage

        window = self._window(_corners(footprint, pose), self._keep_off + reach)
        before = self._free[window]
        after = before & ~self._covered(footprint, pose, window)
        old, new = ndimage.label(before)[0][after], ndimage.label(after)[0][after]
        return len(set(zip(old.tolist(), new.tolist(), strict=True))) > len(set(old.tolist()))

    def take(self, footprint: Footprint, pose: Pose) -> None:
        """Let a body stand there."""
        self._block_body(footprint, pose)

    def _near_main(self, reach: float) -> Bools:
        """Return the cells within ``reach`` (m) of the largest connected part."""
        from scipy import ndimage

        labels, count = ndimage.label(self._free)
        if not count:
            return np.zeros_like(self._free)
        main = labels == np.bincount(labels[labels > 0]).argmax()
        return np.asarray(ndimage.maximum_filter(main, 2 * math.ceil(reach / self._cell) + 1))

    def _window(self, points: Floats, reach: float) -> Window:
        low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
        columns = slice(*np.searchsorted(self._xs, (low[0], high[0])))
        return slice(*np.searchsorted(self._ys, (low[1], high[1]))), columns

    def _inside(self, polygon: Polygon, window: Window) -> Bools:
        xs, ys = np.meshgrid(self._xs[window[1]], self._ys[window[0]])
        area = shapely.Polygon(polygon)
        shapely.prepare(area)
        inside: Bools = shapely.contains_xy(area, xs, ys)
        return inside

    def _block_edges(self, points: Polygon) -> None:
        corners = np.array(points)
        for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            window = self._window(np.stack([p, q]), self._keep_off)
            x, y = self._xs[window[1]] - p[0], self._ys[window[0], None] - p[1]
            dx, dy = q - p
            along = np.clip((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0)
            gap = np.hypot(x - along * dx, y - along * dy)
            self._free[window] &= gap > self._keep_off

    def _block_body(self, footprint: Footprint, pose: Pose) -> None:
        window = self._window(_corners(footprint, pose), self._keep_off)
        self._free[window] &= ~self._covered(footprint, pose, window)

    def _covered(self, footprint: Footprint, pose: Pose, window: Window) -> Bools:
        """Return the cells that a body denies, a little more at its corners."""
        x, y = self._xs[window[1]] - pose.x, self._ys[window[0], None] - pose.y
        if footprint.radius:
            return np.asarray(np.hypot(x, y) <= footprint.radius + self._keep_off)
        c, s = math.cos(pose.theta), math.sin(pose.theta)
        ahead, left = c * x + s * y, c * y - s * x
        covered = np.zeros(ahead.shape, dtype=np.bool_)
        for part in footprint.parts:
            # A convex part is where all its edges have it on their left.
            beyond = np.full(ahead.shape, -math.inf)
            for (px, py), (qx, qy) in zip(part, part[1:] + part[:1], strict=True):
                length = math.dist((px, py), (qx, qy))
                dx, dy = (qx - px) / length, (qy - py) / length
                np.maximum(beyond, dy * (ahead - px) - dx * (left - py), out=beyond)
            covered |= beyond <= self._keep_off
        return covered


def _corners(footprint: Footprint, pose: Pose) -> Floats:
    """Return points whose box holds the body."""
    r = footprint.circumradius
    if footprint.radius:
        return np.array([[pose.x - r, pose.y - r], [pose.x + r, pose.y + r]])
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    corners = np.array([corner for part in footprint.parts for corner in part])
    return np.asarray(corners @ np.array([[c, s], [-s, c]]) + pose[:2])
