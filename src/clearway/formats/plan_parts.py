"""Site, shapes and visits as plan files write them."""

from collections.abc import Callable
from typing import TypeVar

import shapely

from clearway.formats.atomic import FormatError
from clearway.formats.json_node import Node
from clearway.model import Footprint, Limits, Obstacle, Polygon, Pose, Site, Visit, Zone

# The model wants a top speed; where a file gives none, nothing that drives reaches this (m/s).
UNLIMITED_SPEED = 1e6

T = TypeVar("T")


def built(node: Node, build: Callable[[], T]) -> T:
    """Return what ``build`` builds; what the model refuses is told of ``node``."""
    try:
        return build()
    except FormatError:
        raise
    except ValueError as error:
        node.fail(str(error), "correct the value")


def polygon_of(node: Node) -> Polygon:
    """Return a list of points."""
    return tuple(_point(p) for p in node.elements())


def outline_of(node: Node) -> Polygon:
    """Return the points of a polygon that does not cross or touch itself."""
    points = polygon_of(node)
    if len(points) > 3 and not shapely.Polygon(points).is_valid:
        node.fail("the polygon crosses or touches itself", "give a simple polygon")
    return points


def _point(node: Node) -> tuple[float, float]:
    x, y = node.figures(2)
    return x, y


def pose_of(node: Node) -> Pose:
    """Return a pose ``[x, y, theta]``."""
    return Pose(*node.figures(3))


def footprint_of(node: Node) -> Footprint:
    """Return a disc, a convex polygon, or the union of several."""
    if isinstance(node.value, dict):
        return built(node, lambda: Footprint(radius=node["disc"].figure()))
    parts = node.elements()
    nested = bool(parts) and all(
        isinstance(p.value, list) and p.value and isinstance(p.value[0], list) for p in parts
    )
    polygons = tuple(polygon_of(p) for p in parts) if nested else (polygon_of(node),)
    return built(node, lambda: Footprint(parts=polygons))


def limits_of(node: Node) -> Limits:
    """Return the limits; what is absent or null does not bind."""
    speed = node["speed"].number_or_none()
    values = {
        name: node[name].number_or_none()
        for name in ("reverse_speed", "yaw_rate", "turning_radius", "acceleration", "deceleration")
    }
    top = UNLIMITED_SPEED if speed is None else speed
    return built(node, lambda: Limits(speed=top, **values))


def site_of(node: Node) -> Site:
    """Return the site."""
    border = node["border"]
    if border.given and border.value not in ("open", "closed"):
        border.fail("unknown border", 'write "closed" or "open"')
    obstacles, zones = node["obstacles"], node["zones"]
    bounds = outline_of(node["bounds"])
    blocks = tuple(_obstacle(o) for o in obstacles.elements()) if obstacles.given else ()
    areas = tuple(_zone(z) for z in zones.elements()) if zones.given else ()
    return built(
        node["bounds"],
        lambda: Site(bounds, blocks, areas, "open" if border.value == "open" else "closed"),
    )


def _obstacle(node: Node) -> Obstacle:
    polygon, disc, wall, blocks = (node[k] for k in ("polygon", "disc", "wall", "blocks"))
    names = tuple(b.text() for b in blocks.elements()) if blocks.given else ()
    if blocks.given and not names:
        blocks.fail("an obstacle that blocks nobody", "leave blocks out to block everyone")
    outline = outline_of(polygon) if polygon.given else None
    circle = (*_point_and_radius(disc),) if disc.given else None
    ends = (_point(wall.elements(2)[0]), _point(wall.elements(2)[1])) if wall.given else None
    return built(node, lambda: Obstacle(outline, circle, ends, names))


def _point_and_radius(node: Node) -> tuple[float, float, float]:
    x, y, radius = node.figures(3)
    return x, y, radius


def _zone(node: Node) -> Zone:
    pose = pose_of(node["pose"]) if node["pose"].given else None
    name, kind, polygon = node["name"].text(), node["kind"].text(), outline_of(node["polygon"])
    value = node["value"].number_or_none()
    return built(node, lambda: Zone(name, kind, polygon, pose, value))


def visits_of(node: Node, robots: set[str]) -> tuple[Visit, ...]:
    """Return the visits of one robot; ``robots`` are the ids that ``with`` may name."""
    return tuple(_visit(v, robots) for v in node.elements()) if node.given else ()


def _visit(node: Node, robots: set[str]) -> Visit:
    task, service, load, needs, others = (
        node[k] for k in ("task", "service", "load", "needs", "with")
    )
    partners = others.elements() if others.given else []
    for partner in partners:
        if partner.text() not in robots:
            partner.fail("unknown robot", f"known: {', '.join(sorted(robots))}")
    if load.given and load.value not in ("pick", "drop"):
        load.fail("unknown load change", 'write "pick" or "drop", or leave it out')
    after = node["after"]
    return Visit(
        task=task.text() if task.given else None,
        pose=pose_of(node["pose"]),
        service=_seconds(service) or 0.0,
        load=load.value if load.given else None,
        needs=needs.text() if needs.given else None,
        together=tuple(p.text() for p in partners),
        not_before=_seconds(node["not_before"]) or 0.0,
        after=tuple(task.text() for task in after.elements()) if after.given else (),
        due=_seconds(node["due"]),
    )


def _seconds(node: Node) -> float | None:
    if not node.given:
        return None
    seconds = node.figure()
    if seconds < 0.0:
        node.fail("must be 0 or above", "give the time in s")
    return seconds
