"""A site's obstacles as the native core wants them: edges, discs and outlines."""

import shapely

from clearway import _core
from clearway.model import Footprint, Point, Polygon, Site

OPEN_MARGIN = 20.0  # how far beyond open bounds robots may go (m)
# Bodies may legally reach 2 mm over the bounds but only 1 mm into obstacles: the core, which knows
# one tolerance, gets bounds that lie this much farther out (m).
BOUNDS_SHIFT = 0.9e-3


def edges(polygon: Polygon) -> list[tuple[Point, Point]]:
    """Return the edges of a closed polygon."""
    return list(zip(polygon, polygon[1:] + polygon[:1], strict=True))


def native_body(footprint: Footprint) -> _core.Body:
    """Return the core's body of a footprint."""
    return _core.Body([list(part) for part in footprint.parts], footprint.radius)


def native_obstacles(site: Site, type_name: str, loaded: bool) -> _core.Obstacles:
    """Return what stands in the way of a robot type."""
    xs = [x for x, _ in site.bounds]
    ys = [y for _, y in site.bounds]
    margin = OPEN_MARGIN if site.border == "open" else 0.0
    box = (min(xs) - margin, min(ys) - margin, max(xs) + margin, max(ys) + margin)
    bounds = _shifted(site.bounds)
    if site.border == "open":
        bounds = ((box[0], box[1]), (box[2], box[1]), (box[2], box[3]), (box[0], box[3]))
    walls = edges(bounds)
    discs, solids = [], []
    for obstacle in site.obstacles:
        if not obstacle.stops(type_name, loaded):
            continue
        if obstacle.polygon is not None:
            walls += edges(obstacle.polygon)
            solids.append(obstacle.polygon)
        elif obstacle.wall is not None:
            walls.append(obstacle.wall)
        elif obstacle.disc is not None:
            discs.append(obstacle.disc)
    segments = [(*p, *q) for p, q in walls]
    return _core.Obstacles(box, segments, discs, solids, bounds)


def _shifted(bounds: Polygon) -> Polygon:
    outline = shapely.Polygon(bounds).buffer(BOUNDS_SHIFT, join_style="mitre").exterior
    return tuple((float(x), float(y)) for x, y in outline.coords[:-1])
