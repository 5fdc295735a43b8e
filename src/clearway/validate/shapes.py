"""Shapes as convex parts: polygons, walls and discs alike."""

from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.typing import NDArray

from clearway.model import Footprint, Obstacle, Polygon

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Part:
    """Points of a convex polygon with all that lies within ``radius`` (m) of it.

    One point and a radius is a disc, two points are a wall. ``points`` has shape
    ``(num_points, 2)``, counter-clockwise; ``normals`` are the unit vectors out of its edges.
    """

    points: Floats
    radius: float = 0.0
    normals: Floats = field(init=False)

    def __post_init__(self) -> None:
        """Find the normals."""
        edges = np.roll(self.points, -1, axis=0) - self.points
        length = np.hypot(edges[:, 0], edges[:, 1])
        edges = edges[length > 1e-12] / length[length > 1e-12, None]
        normals = np.column_stack([edges[:, 1], -edges[:, 0]])
        # Any direction may serve as an axis of a point; it spares the case of none.
        object.__setattr__(self, "normals", normals if len(normals) else np.array([[1.0, 0.0]]))

    @property
    def reach(self) -> float:
        """Largest distance of a point of the part from the frame's origin (m)."""
        return float(np.hypot(self.points[:, 0], self.points[:, 1]).max()) + self.radius

    @property
    def outline(self) -> shapely.Polygon:
        """The part as a Shapely polygon; walls are given 0.1 mm."""
        around = self.radius if self.radius else 1e-4 if len(self.points) < 3 else 0.0
        return shapely.convex_hull(shapely.multipoints(self.points)).buffer(around)


def footprint_parts(footprint: Footprint) -> tuple[Part, ...]:
    """Return the parts of a footprint, in the body frame."""
    if footprint.radius:
        return (Part(np.zeros((1, 2)), footprint.radius),)
    polygons = [shapely.Polygon(part) for part in footprint.parts]
    return tuple(_part(polygon) for polygon in _joined(polygons))


def obstacle_parts(obstacle: Obstacle) -> tuple[Part, ...]:
    """Return the parts of an obstacle."""
    if obstacle.disc is not None:
        x, y, radius = obstacle.disc
        return (Part(np.array([[x, y]]), radius),)
    if obstacle.wall is not None:
        return (Part(np.array(obstacle.wall)),)
    return polygon_parts(obstacle.polygon or ())


def polygon_parts(polygon: Polygon) -> tuple[Part, ...]:
    """Return the convex parts of a simple polygon; flat sides stay whole."""
    return _convex(shapely.Polygon(polygon))


def outside_parts(bounds: Polygon, margin: float) -> tuple[Part, ...]:
    """Return parts that cover what lies outside ``bounds``, ``margin`` (m) far around it."""
    inside = shapely.Polygon(bounds)
    x0, y0, x1, y1 = inside.bounds
    box = shapely.box(x0 - margin, y0 - margin, x1 + margin, y1 + margin)
    return _convex(shapely.Polygon(box.exterior, [inside.simplify(0.0).exterior]))


def _convex(polygon: shapely.Polygon) -> tuple[Part, ...]:
    # Without points in the middle of flat sides no cut between parts ends on one, so that
    # a corner that enters a flat side meets that side whole.
    plain = polygon.simplify(0.0)
    if not plain.interiors and plain.convex_hull.area - plain.area <= 1e-12 * plain.area:
        return (_part(plain.convex_hull),)
    triangles = shapely.constrained_delaunay_triangles(plain)
    return tuple(_part(triangle) for triangle in triangles.geoms)


def _part(polygon: shapely.Polygon) -> Part:
    return Part(np.array(shapely.orient_polygons(polygon).exterior.coords)[:-1])


def _joined(polygons: list[shapely.Polygon]) -> list[shapely.Polygon]:
    """Replace pairs whose union is convex by their union, as long as there are any."""
    for i, one in enumerate(polygons):
        for j, other in enumerate(polygons[:i]):
            union = one.union(other)
            if union.convex_hull.area - union.area <= 1e-12 * union.area:
                rest = [p for k, p in enumerate(polygons) if k not in (i, j)]
                return _joined([*rest, union.convex_hull.simplify(0.0)])
    return polygons
