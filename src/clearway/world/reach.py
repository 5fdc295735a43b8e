"""Proof that a disc cannot come from one place to another: a relaxed grid of its free centres."""

import math

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from clearway.model import Footprint, Point, Pose, Site
from clearway.world.shapes import obstacle_shape

MOST_CELLS = 1_000_000
POINTS_AT_ONCE = 20_000
# Plans may overlap obstacles by 1 mm and bounds by 2 mm and still be right.
ALLOWED_OVERLAP = 0.002


def inscribed_disc(footprint: Footprint) -> tuple[Point, float]:
    """Return centre (body frame, m) and radius (m) of the largest disc inside a footprint."""
    if footprint.radius:
        return (0.0, 0.0), footprint.radius
    body = shapely.union_all([shapely.Polygon(part) for part in footprint.parts])
    centre = shapely.Point(shapely.maximum_inscribed_circle(body).coords[0])
    return (centre.x, centre.y), float(body.boundary.distance(centre))


class Reach:
    """Where the centre of a disc may travel: a superset, so that "not connected" is a proof.

    A cell is passable if any of its points could be the centre of the free disc, judged at
    its middle with the radius reduced by half the cell's diagonal. A continuous motion of
    the disc passes through cells that touch, so cells in different 8-connected components
    have no motion between them. "Connected" proves nothing.

    Parameters
    ----------
    site
        Bounds bind only where the border is closed.
    type_name, loaded
        Whose obstacles count.
    radius
        Radius of the disc (m).
    cell
        Side of a cell (m); smaller proves more. Absent: 0.25 m, or half the radius where
        that is less. Raised so far that the grid has at most a million cells.
    """

    def __init__(
        self, site: Site, type_name: str, loaded: bool, radius: float, cell: float | None = None
    ) -> None:
        from scipy import ndimage

        shapes = [obstacle_shape(o) for o in site.obstacles if o.stops(type_name, loaded)]
        bounds = shapely.Polygon(site.bounds)
        boxes = (
            [bounds.bounds]
            if site.border == "closed"
            else [
                bounds.bounds,
                *(shape.geometry.buffer(shape.radius + radius).bounds for shape in shapes),
            ]
        )
        x_min, y_min = (min(box[k] for box in boxes) for k in (0, 1))
        x_max, y_max = (max(box[k] for box in boxes) for k in (2, 3))
        wanted = min(0.25, radius / 2.0) if cell is None else cell
        side = max(wanted, math.sqrt((x_max - x_min) * (y_max - y_min) / (0.9 * MOST_CELLS)))
        # On an open site the outermost ring stands for everything outside.
        margin = 2.0 * side if site.border == "open" else 0.0
        self.cell = side
        self._origin = (x_min - margin, y_min - margin)
        columns = max(1, math.ceil((x_max - x_min + 2.0 * margin) / side))
        rows = max(1, math.ceil((y_max - y_min + 2.0 * margin) / side))
        xs = self._origin[0] + side * (np.arange(columns) + 0.5)
        ys = self._origin[1] + side * (np.arange(rows) + 0.5)
        keep_off = radius - ALLOWED_OVERLAP - side / math.sqrt(2.0)
        passable = np.ones((rows, columns), dtype=np.bool_)
        for shape in shapes:
            _block(passable, xs, ys, shape.geometry, shape.radius + keep_off)
        if site.border == "closed":
            passable &= _inside(bounds, xs, ys, keep_off)
        self._is_open = site.border == "open"
        self._labels, _ = ndimage.label(passable, structure=np.ones((3, 3), dtype=np.int_))

    def component(self, centre: Point) -> int:
        """Return the number of the component that a disc centre lies in; 0 where it cannot be."""
        column = math.floor((centre[0] - self._origin[0]) / self.cell)
        row = math.floor((centre[1] - self._origin[1]) / self.cell)
        rows, columns = self._labels.shape
        if 0 <= row < rows and 0 <= column < columns:
            return int(self._labels[row, column])
        return int(self._labels[0, 0]) if self._is_open else 0

    def connected(self, p: Point, q: Point) -> bool:
        """Whether a way from ``p`` to ``q`` (disc centres, m) is not excluded."""
        return self.component(p) == self.component(q) != 0


class BodyReach:
    """`Reach` of a body by the largest disc inside it, asked about poses of the body."""

    def __init__(self, site: Site, type_name: str, loaded: bool, footprint: Footprint) -> None:
        (x, y), self.radius = inscribed_disc(footprint)
        self._centre = Pose(x, y, 0.0)
        self._reach = Reach(site, type_name, loaded, self.radius)

    def component(self, pose: Pose) -> int:
        """Return the number of the component that the body is in; 0 where it cannot be."""
        at = pose.compose(self._centre)
        return self._reach.component((at.x, at.y))


def _block(
    passable: NDArray[np.bool_],
    xs: NDArray[np.float64],
    ys: NDArray[np.float64],
    geometry: BaseGeometry,
    keep_off: float,
) -> None:
    """Mark the cells whose middle is closer than ``keep_off``, or deeper inside than minus that."""
    pad = max(keep_off, 0.0)
    x0, y0, x1, y1 = geometry.bounds
    columns = slice(*np.searchsorted(xs, (x0 - pad, x1 + pad)))
    rows = slice(*np.searchsorted(ys, (y0 - pad, y1 + pad)))
    window = passable[rows, columns]
    if window.size == 0:
        return
    shapely.prepare(geometry)
    if keep_off > 0.0:
        window &= ~_within(geometry, xs[columns], ys[rows], keep_off)
    elif geometry.area:
        grid_x, grid_y = np.meshgrid(xs[columns], ys[rows])
        deep = shapely.contains_xy(geometry, grid_x, grid_y)
        at_rim = _within(geometry.boundary, xs[columns], ys[rows], -keep_off)
        window &= ~(deep & ~at_rim)


def _within(
    geometry: BaseGeometry, xs: NDArray[np.float64], ys: NDArray[np.float64], distance: float
) -> NDArray[np.bool_]:
    """Return which grid points are that near, some rows at a time: points take much memory."""
    shapely.prepare(geometry)
    found = np.empty((len(ys), len(xs)), dtype=np.bool_)
    rows = max(1, POINTS_AT_ONCE // max(1, len(xs)))
    for first in range(0, len(ys), rows):
        points = shapely.points(*np.meshgrid(xs, ys[first : first + rows]))
        found[first : first + rows] = shapely.dwithin(geometry, points, distance)
    return found


def _inside(
    bounds: shapely.Polygon, xs: NDArray[np.float64], ys: NDArray[np.float64], keep_off: float
) -> NDArray[np.bool_]:
    """Cells whose middle is at least ``keep_off`` inside, or at most minus that outside."""
    grid_x, grid_y = np.meshgrid(xs, ys)
    inside = shapely.contains_xy(bounds, grid_x, grid_y)
    at_rim = _within(bounds.exterior, xs, ys, abs(keep_off))
    near: NDArray[np.bool_] = inside & ~at_rim if keep_off > 0.0 else inside | at_rim
    return near
