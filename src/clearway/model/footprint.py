"""The shape a robot covers on the floor."""

import math
from dataclasses import dataclass

Point = tuple[float, float]
Polygon = tuple[Point, ...]


def _signed_area(polygon: Polygon) -> float:
    return 0.5 * sum(
        x0 * y1 - x1 * y0
        for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1], strict=True)
    )


def check_polygon(points: Polygon, what: str) -> Polygon:
    """Return the points counter-clockwise; refuse fewer than 3, non-finite or without area."""
    if len(points) < 3:
        raise ValueError(f"{what} needs at least 3 points, got {len(points)}")
    for point in points:
        if len(point) != 2 or not all(math.isfinite(v) for v in point):
            raise ValueError(f"{what} has a point that is not two finite numbers: {point}")
    area = _signed_area(points)
    if abs(area) < 1e-9:
        raise ValueError(f"{what} has no area")
    ordered = points if area > 0 else points[::-1]
    return tuple((float(x), float(y)) for x, y in ordered)


def check_convex(points: Polygon, what: str) -> Polygon:
    """Return the points counter-clockwise; refuse a polygon that is not convex."""
    polygon = check_polygon(points, what)
    n = len(polygon)
    turned = 0.0
    for i in range(n):
        (ax, ay), (bx, by), (cx, cy) = polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]
        ux, uy, vx, vy = bx - ax, by - ay, cx - bx, cy - by
        cross = ux * vy - uy * vx
        if cross < -1e-9:
            raise ValueError(
                f"{what} is not convex at point {(i + 1) % n}; split it into convex parts"
            )
        turned += math.atan2(cross, ux * vx + uy * vy)
    if turned > 2.0 * math.pi + 1e-6:
        raise ValueError(f"{what} winds around itself more than once")
    return polygon


@dataclass(frozen=True)
class Footprint:
    """Union of convex polygons in the body frame, or a disc about the reference point.

    Parameters
    ----------
    parts
        Convex polygons (m, body frame: x forward); empty for a disc.
    radius
        Radius of the disc (m); 0 for polygons.
    """

    parts: tuple[Polygon, ...] = ()
    radius: float = 0.0

    def __post_init__(self) -> None:
        if bool(self.parts) == bool(self.radius):
            raise ValueError(
                "a footprint is either convex polygons or a disc with a radius above 0"
            )
        if not (math.isfinite(self.radius) and self.radius >= 0.0):
            raise ValueError(f"a disc's radius must be above 0 and finite, got {self.radius}")
        checked = tuple(
            check_convex(part, f"footprint part {i}") for i, part in enumerate(self.parts)
        )
        object.__setattr__(self, "parts", checked)

    @classmethod
    def rectangle(cls, length: float, width: float, rear: float | None = None) -> "Footprint":
        """Return a rectangle along x; ``rear`` is how far it reaches behind the reference point."""
        back = length / 2.0 if rear is None else rear
        front, half = length - back, width / 2.0
        return cls(parts=(((front, half), (-back, half), (-back, -half), (front, -half)),))

    @property
    def circumradius(self) -> float:
        """Largest distance of a body point from the reference point (m)."""
        if self.radius:
            return self.radius
        return max(math.hypot(x, y) for part in self.parts for x, y in part)

    @property
    def length(self) -> float:
        """Extent along the body's x axis (m)."""
        if self.radius:
            return 2.0 * self.radius
        xs = [x for part in self.parts for x, _ in part]
        return max(xs) - min(xs)
