"""Bodies and obstacles as exact planar shapes: how far apart they are, how deep they overlap."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from clearway.model import Footprint, Obstacle, Polygon, Pose


@dataclass(frozen=True)
class Shape:
    """All points within ``radius`` (m) of a geometry: a disc needs no corners."""

    geometry: BaseGeometry
    radius: float = 0.0

    def gap(self, other: "Shape") -> float:
        """Distance to another shape (m); 0 or below where they touch or overlap."""
        return float(self.geometry.distance(other.geometry)) - self.radius - other.radius

    def eroded(self, depth: float) -> "Shape":
        """Return the points deeper than ``depth`` (m) inside this shape."""
        if self.radius:
            return Shape(
                self.geometry if depth <= self.radius else shapely.Point(), self.radius - depth
            )
        return Shape(self.geometry.buffer(-depth, join_style="mitre"))

    def overlap(self, other: "Shape") -> float:
        """How far one of them must move to undo the deepest overlap of convex parts (m)."""
        if self.gap(other) > 0.0:
            return 0.0
        pairs = (
            (a, b) for a in _convex_parts(self.geometry) for b in _convex_parts(other.geometry)
        )
        return max(0.0, max(self.radius + other.radius - _apart(a, b) for a, b in pairs))

    @property
    def area(self) -> float:
        """Area (m^2)."""
        disc = math.pi * self.radius**2 if self.radius > 0.0 else 0.0
        return float(self.geometry.area) + disc


def _convex_parts(geometry: BaseGeometry) -> list[BaseGeometry]:
    if geometry.convex_hull.area - geometry.area <= 1e-12 * geometry.area:
        return [geometry]
    return list(shapely.constrained_delaunay_triangles(geometry).geoms)


def _apart(a: BaseGeometry, b: BaseGeometry) -> float:
    """Return the distance of two convex geometries (m); minus the way out where they overlap."""
    distance = float(a.distance(b))
    if distance > 0.0:
        return distance
    corners, others = shapely.get_coordinates(a), shapely.get_coordinates(b)
    edges = np.concatenate([np.diff(corners, axis=0), np.diff(others, axis=0)])
    edges = edges[np.hypot(edges[:, 0], edges[:, 1]) > 1e-12]
    if not len(edges):
        return 0.0
    axes = (
        np.column_stack([edges[:, 1], -edges[:, 0]]) / np.hypot(edges[:, 0], edges[:, 1])[:, None]
    )
    along, beside = corners @ axes.T, others @ axes.T
    ways_out = np.minimum(
        along.max(axis=0) - beside.min(axis=0), beside.max(axis=0) - along.min(axis=0)
    )
    return -float(ways_out.min())


def body_shape(footprint: Footprint, pose: Pose) -> Shape:
    """Return the floor that a body covers at ``pose``."""
    if footprint.radius:
        return Shape(shapely.Point(pose.x, pose.y), footprint.radius)
    c, s = np.cos(pose.theta), np.sin(pose.theta)
    turn = np.array([[c, s], [-s, c]])
    parts = [shapely.Polygon(np.array(part) @ turn + pose[:2]) for part in footprint.parts]
    return Shape(parts[0] if len(parts) == 1 else shapely.union_all(parts))


def obstacle_shape(obstacle: Obstacle) -> Shape:
    """Return the floor that an obstacle covers."""
    if obstacle.disc is not None:
        x, y, radius = obstacle.disc
        return Shape(shapely.Point(x, y), radius)
    if obstacle.wall is not None:
        return Shape(shapely.LineString(obstacle.wall))
    return Shape(shapely.Polygon(obstacle.polygon))


def room_inside(bounds: Polygon, shape: Shape) -> float:
    """Least distance from a shape to the bounds around it (m); below 0: how far it is outside."""
    inside = shapely.Polygon(bounds)
    rim = float(inside.exterior.distance(shape.geometry))
    if inside.covers(shape.geometry):
        return rim - shape.radius
    outside = shapely.get_coordinates(shape.geometry.difference(inside))
    farthest = max((float(inside.distance(shapely.Point(p))) for p in outside), default=0.0)
    return -farthest - shape.radius


class ShapeIndex:
    """Shapes that can be asked which of them is nearest."""

    def __init__(self, shapes: Sequence[Shape]) -> None:
        self.shapes = tuple(shapes)
        self._largest = max((shape.radius for shape in shapes), default=0.0)
        self._tree = shapely.STRtree([shape.geometry for shape in shapes])

    def near(self, shape: Shape, gap: float = 0.0) -> list[tuple[float, int]]:
        """Return ``(gap, index)`` of all shapes not farther than ``gap`` (m), in index order."""
        reach = gap + shape.radius + self._largest + 1e-9
        found = self._tree.query(shape.geometry, predicate="dwithin", distance=reach)
        gaps = ((shape.gap(self.shapes[i]), int(i)) for i in sorted(found))
        return [(value, i) for value, i in gaps if value <= gap + 1e-9]

    def nearest(self, shape: Shape, but: int | None = None) -> tuple[float, int] | None:
        """Return ``(gap, index)`` of the nearest shape, leaving out the one at index ``but``."""
        found = self._tree.query_nearest(
            shape.geometry, exclusive=but is not None, all_matches=False
        )
        widest = max((shape.gap(self.shapes[i]) for i in found), default=0.0)
        others = [(gap, i) for gap, i in self.near(shape, max(widest, 0.0)) if i != but]
        return min(others, default=None)
