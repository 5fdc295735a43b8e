"""Where a body may stand on a site: many poses at once, against what never moves."""

import numpy as np
import shapely
from numpy.typing import NDArray

from clearway.model import Footprint, RobotType, Site
from clearway.world.shapes import obstacle_shape

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

GAP = 0.1  # between a body and obstacles or bounds (m)
# A robot that cannot turn on the spot has this much straight way behind or before it (m).
STRAIGHT = 2.0
# A disc's obstacle is drawn as a polygon of this many corners around it.
CORNERS = 64


class Standing:
    """Asks of poses whether a body stands there 0.1 m clear of obstacles and bounds."""

    def __init__(self, site: Site) -> None:
        solids = []
        for obstacle in site.obstacles:
            shape = obstacle_shape(obstacle)
            around = shape.radius / np.cos(np.pi / CORNERS)
            solid = shape.geometry.buffer(around, CORNERS // 4) if around else shape.geometry
            solids.append(solid)
        corners = np.array(site.bounds)
        rim = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
        self._tree = shapely.STRtree([*solids, *shapely.linestrings(rim)])
        self._bounds = shapely.Polygon(site.bounds)
        shapely.prepare(self._bounds)

    def allows(self, kind: RobotType, poses: Floats) -> Bools:
        """Return for each pose, shape ``(n, 3)``, whether a body stands there and can leave.

        A robot of a kind that steers like a car can leave if 2 m of straight way are clear,
        forwards or backwards; the other kinds can turn on the spot or move sideways.
        """
        clear = self._is_clear(kind.footprint, poses)
        if kind.kinematics == "ackermann":
            ahead, back = (_driven(kind.footprint, way) for way in (STRAIGHT, -STRAIGHT))
            clear &= self._is_clear(ahead, poses) | self._is_clear(back, poses)
        return clear

    def _is_clear(self, footprint: Footprint, poses: Floats) -> Bools:
        clear: Bools = shapely.contains_xy(self._bounds, poses[:, 0], poses[:, 1])
        if footprint.radius:
            bodies = [shapely.points(poses[:, :2])]
        else:
            bodies = [shapely.polygons(_at(np.array(part), poses)) for part in footprint.parts]
        for parts in bodies:
            near, _ = self._tree.query(parts, "dwithin", distance=GAP + footprint.radius)
            clear[near] = False
        return clear


def _at(corners: Floats, poses: Floats) -> Floats:
    """Return body-frame points, shape ``(k, 2)``, at poses: shape ``(n, k, 2)``."""
    c, s = np.cos(poses[:, 2, None]), np.sin(poses[:, 2, None])
    x, y = corners[:, 0], corners[:, 1]
    return np.stack([poses[:, 0, None] + c * x - s * y, poses[:, 1, None] + s * x + c * y], -1)


def _driven(footprint: Footprint, distance: float) -> Footprint:
    """Return the floor, in the body frame, that a straight drive covers."""
    hulls = [
        shapely.MultiPoint([*part, *((x + distance, y) for x, y in part)]).convex_hull
        for part in footprint.parts
    ]
    return Footprint(parts=tuple(tuple(hull.exterior.coords[:-1]) for hull in hulls))
