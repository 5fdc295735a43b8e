"""Five kinds of seeded sites: open floor, shelves, rooms, corridors, yards."""

import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from random import Random

import shapely
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from clearway.model import Obstacle, Polygon, Site
from clearway.world.fleets import Lanes
from clearway.world.shapes import obstacle_shape

DISC_RADIUS = 0.8  # as in the CL-CBS benchmark (m)
SHELF_LENGTH = 25.0  # about (m)
SHELF_DEPTHS = tuple(k / 10.0 for k in range(10, 121))
SHELVES_AT_MOST = 0.9  # the seed leaves out the rest, where the density can be had without
WALL = 0.5  # thickness of the walls of rooms (m)
CROSS_EVERY = 60.0  # corridor between two cross corridors, about (m)
TRAILER = (7.0, 2.5)
MOST_TRIES = 2000

Size = tuple[float, float]
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class SiteKind:
    """How a kind of site is made: from its size, density, the fleet's lanes, a random source.

    ``density`` is the share of the floor under obstacles, from ``least`` to ``most``.
    """

    build: Callable[[Size, float, Lanes, Random], Site]
    density: float
    least: float
    most: float


def open_site(size: Size, density: float, lanes: Lanes, rng: Random) -> Site:
    """Return a floor with scattered discs that do not overlap; the lanes play no part."""
    width, height = size
    r = DISC_RADIUS
    count = round(density * width * height / (math.pi * r * r))
    if count and min(size) < 4.0 * r:
        raise ValueError(f"size: {_told(size)} is too small for discs; take 4 m or more")
    near: dict[tuple[int, int], list[tuple[float, float]]] = {}
    discs: list[tuple[float, float]] = []
    for _ in range(MOST_TRIES + 50 * count):
        if len(discs) == count:
            break
        x, y = round(rng.uniform(r, width - r), 3), round(rng.uniform(r, height - r), 3)
        i, j = int(x / (2.0 * r)), int(y / (2.0 * r))
        around = [(i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)]
        if all(math.dist((x, y), d) >= 2.0 * r for key in around for d in near.get(key, ())):
            near.setdefault((i, j), []).append((x, y))
            discs.append((x, y))
    if len(discs) < count:
        raise ValueError(
            f"density: only {len(discs)} of {count} discs fit; take less than {density:g}"
        )
    obstacles = tuple(Obstacle(disc=(x, y, r)) for x, y in discs)
    return Site(_polygon(shapely.box(0.0, 0.0, width, height)), obstacles)


def shelves_site(size: Size, density: float, lanes: Lanes, rng: Random) -> Site:
    """Return rows of shelves along x with aisles around each; density makes them deeper.

    One shelf in ten, drawn by the seed, is left out, more where even shelves of 1 m cover too
    much, none where the density cannot be had otherwise.
    """
    width, height = size
    aisle = lanes.aisle
    columns = max(1, round((width - aisle) / (SHELF_LENGTH + aisle)))
    length = (width - aisle) / columns - aisle

    def rows(depth: float) -> int:
        return max(0, math.floor((height - aisle) / (depth + aisle)))

    def share(depth: float) -> float:
        return rows(depth) * columns * depth * length / (width * height)

    if length < 1.0 or rows(SHELF_DEPTHS[0]) < 1:
        raise ValueError(
            f"size: {_told(size)} is too small for shelves between aisles of {aisle:.1f} m; "
            f"take {2.0 * aisle + 1.0:.0f} m or more"
        )
    enough = [depth for depth in SHELF_DEPTHS if SHELVES_AT_MOST * share(depth) >= density]
    depth = enough[0] if enough else max(SHELF_DEPTHS, key=share)
    places = [(row, column) for row in range(rows(depth)) for column in range(columns)]
    count = min(len(places), round(density * width * height / (depth * length)))
    pitch = (height - aisle) / rows(depth)
    shelves = []
    for row, column in sorted(rng.sample(places, count)):
        x, y = aisle + column * (length + aisle), row * pitch + (pitch + aisle - depth) / 2.0
        shelves.append(shapely.box(x, y, x + length, y + depth))
    return _site(shapely.box(0.0, 0.0, width, height), shelves)


def rooms_site(size: Size, density: float, lanes: Lanes, rng: Random) -> Site:
    """Return a grid of rooms; any two neighbours share a door somewhere in their wall.

    Density makes the rooms smaller: walls are 0.5 m thick.
    """
    width, height = size
    least = 1.5 * lanes.aisle
    if min(size) < least:
        raise ValueError(f"size: {_told(size)} is too small for a room; take {least:.0f} m or more")

    def miss(columns: int, rows: int) -> float:
        walls = (columns - 1) * (height - rows * lanes.door)
        walls += (rows - 1) * (width - columns * lanes.door)
        return abs(walls * WALL / (width * height) - density)

    sides = [least + 0.5 * k for k in range(math.ceil(2.0 * (max(size) - least)) + 1)]
    grids = {(max(1, int(width / side)), max(1, int(height / side))) for side in sides}
    columns, rows = min(sorted(grids), key=lambda grid: miss(*grid))
    xs = [width * k / columns for k in range(columns + 1)]
    ys = [height * k / rows for k in range(rows + 1)]
    walls = []
    for x in xs[1:-1]:
        low = 0.0
        for y0, y1 in itertools.pairwise(ys):
            begin = _door(y0, y1, lanes.door, rng)
            walls.append(shapely.box(x - WALL / 2.0, low, x + WALL / 2.0, begin))
            low = begin + lanes.door
        walls.append(shapely.box(x - WALL / 2.0, low, x + WALL / 2.0, height))
    for y in ys[1:-1]:
        for x0, x1 in itertools.pairwise(xs):
            # Walls along y run through; these ones end at their faces.
            left = x0 + WALL / 2.0 if x0 > 0.0 else 0.0
            right = x1 - WALL / 2.0 if x1 < width else width
            begin = _door(x0, x1, lanes.door, rng)
            walls.append(shapely.box(left, y - WALL / 2.0, begin, y + WALL / 2.0))
            walls.append(shapely.box(begin + lanes.door, y - WALL / 2.0, right, y + WALL / 2.0))
    return _site(shapely.box(0.0, 0.0, width, height), walls)


def corridors_site(size: Size, density: float, lanes: Lanes, rng: Random) -> Site:
    """Return corridors along x, cross corridors about every 60 m and dead ends with a room.

    All corridors are as wide as the fleet's aisles. Density makes the blocks between them
    deeper; blocks deep enough have dead ends: a passage as wide as a door with a room behind.
    """
    width, height = size
    aisle = lanes.aisle
    if width < 3.0 * aisle or height < 3.0 * aisle:
        raise ValueError(
            f"size: {_told(size)} is too small for corridors of {aisle:.1f} m; "
            f"take {math.ceil(3.0 * aisle)} m or more"
        )
    crossings = max(1, round(width / CROSS_EVERY))
    section = width / crossings

    def share(corridors: int) -> float:
        depth = (height - corridors * aisle) / (corridors - 1)
        room, length = _dead_end_room(lanes), width - crossings * aisle
        strip = length * depth
        if depth >= room + 2.0:
            hollow = room * room + lanes.door * (depth - 1.0 - room)
            strip -= hollow * (length / (2.0 * room + 2.0) - crossings / 2.0)
        return (corridors - 1) * strip / (width * height)

    # Blocks are at least a third of an aisle deep.
    counts = range(2, max(2, int((3.0 * height / aisle + 1.0) / 4.0)) + 1)
    corridors = min(counts, key=lambda count: abs(share(count) - density))
    depth = (height - corridors * aisle) / (corridors - 1)
    blocks: list[BaseGeometry] = []
    for k in range(corridors - 1):
        low = aisle + k * (depth + aisle)
        edge = 0.0
        for i in range(crossings):
            middle = section * i + _between(section, 1.5 * aisle, rng)
            blocks += _block((edge, low, middle - aisle / 2.0, low + depth), lanes, rng)
            edge = middle + aisle / 2.0
        blocks += _block((edge, low, width, low + depth), lanes, rng)
    return _site(shapely.box(0.0, 0.0, width, height), blocks)


def yards_site(size: Size, density: float, lanes: Lanes, rng: Random) -> Site:
    """Return an irregular yard with buildings and rows of parked trailers at any angle.

    Buildings cover about seven tenths of the density. Between any two of them, trailers and
    the border lies at least an aisle, but for the trailers of one row; what then does not fit
    is left out.
    """
    width, height = size
    if min(size) < 3.0 * lanes.aisle:
        mend = f"take {math.ceil(3.0 * lanes.aisle)} m or more"
        raise ValueError(f"size: {_told(size)} is too small for a yard; {mend}")
    bounds = shapely.Polygon(_rim(width, height, rng))
    wanted = density * bounds.area
    inside = bounds.buffer(-lanes.aisle)
    stand: list[BaseGeometry] = []
    area = 0.0
    for upto, draw in ((0.7 * wanted, _building), (wanted, _trailers)):
        for _ in range(MOST_TRIES):
            if area >= 0.98 * upto:
                break
            parts = draw(min(size), upto - area, rng)
            turn, x, y = rng.uniform(0.0, 360.0), rng.uniform(0.0, width), rng.uniform(0.0, height)
            put = [
                affinity.translate(affinity.rotate(part, turn, (0.0, 0.0)), x, y) for part in parts
            ]
            whole = shapely.union_all(put)
            if inside.contains(whole) and not shapely.dwithin(stand, whole, lanes.aisle).any():
                stand += put
                area += whole.area
    return _site(bounds, stand)


KINDS: Mapping[str, SiteKind] = {
    "open": SiteKind(open_site, density=0.02, least=0.0, most=0.3),
    "shelves": SiteKind(shelves_site, density=0.15, least=0.0, most=0.4),
    "rooms": SiteKind(rooms_site, density=0.03, least=0.0, most=0.1),
    "corridors": SiteKind(corridors_site, density=0.5, least=0.2, most=0.8),
    "yards": SiteKind(yards_site, density=0.1, least=0.0, most=0.25),
}


def covered(site: Site) -> float:
    """Return the share of the floor that is under obstacles."""
    shapes = map(obstacle_shape, site.obstacles)
    solid = shapely.union_all([shape.geometry.buffer(shape.radius) for shape in shapes])
    return float(solid.area / shapely.Polygon(site.bounds).area)


def _told(size: Size) -> str:
    return f"{size[0]:g} m x {size[1]:g} m"


def _polygon(geometry: BaseGeometry) -> Polygon:
    return tuple((round(x, 3), round(y, 3)) for x, y in geometry.exterior.coords[:-1])


def _site(bounds: BaseGeometry, solids: list[BaseGeometry]) -> Site:
    return Site(_polygon(bounds), tuple(Obstacle(polygon=_polygon(solid)) for solid in solids))


def _between(length: float, margin: float, rng: Random) -> float:
    """Draw a place along a length, not within ``margin`` of its ends where that is possible."""
    margin = min(margin, length / 2.0)
    return rng.uniform(margin, length - margin)


def _door(begin: float, end: float, door: float, rng: Random) -> float:
    """Draw where the door in a wall begins."""
    return begin + _between(end - begin, door / 2.0 + 2.0 * WALL, rng) - door / 2.0


def _dead_end_room(lanes: Lanes) -> float:
    """Return the side of the square at a dead end (m)."""
    return lanes.aisle + 1.0


def _block(box: Box, lanes: Lanes, rng: Random) -> list[BaseGeometry]:
    """Return a block between corridors, with dead ends cut into it from below and above."""
    x0, y0, x1, y1 = box
    if x1 - x0 < 0.5:
        return []
    solid = shapely.box(*box)
    room = _dead_end_room(lanes)
    if y1 - y0 < room + 2.0:
        return [solid]
    dead_ends = int((x1 - x0) / (2.0 * room + 2.0))
    part = (x1 - x0) / max(1, dead_ends)
    for k in range(dead_ends):
        x = x0 + k * part + _between(part, room / 2.0 + 1.0, rng)
        passage = (x - lanes.door / 2.0, y0 - 1.0, x + lanes.door / 2.0, y1 - room)
        end = (x - room / 2.0, y1 - 1.0 - room, x + room / 2.0, y1 - 1.0)
        cut = shapely.union(shapely.box(*passage), shapely.box(*end))
        if rng.random() < 0.5:
            cut = affinity.rotate(cut, 180.0, (x, (y0 + y1) / 2.0))
        solid = solid.difference(cut)
    return [solid]


def _rim(width: float, height: float, rng: Random) -> list[tuple[float, float]]:
    """Draw bounds that bulge in and out by up to an eighth of a side."""
    # Corners beyond that eighth on the other side too, so that the four sides never cross.
    across, up = (
        [0.125 + 0.75 * (k + rng.uniform(0.1, 0.9)) / 4.0 for k in range(4)] for _ in range(2)
    )
    rim = [(width * t, height * rng.uniform(0.0, 0.125)) for t in across]
    rim += [(width * (1.0 - rng.uniform(0.0, 0.125)), height * t) for t in up]
    rim += [(width * t, height * (1.0 - rng.uniform(0.0, 0.125))) for t in across[::-1]]
    return rim + [(width * rng.uniform(0.0, 0.125), height * t) for t in up[::-1]]


def _building(side: float, area: float, rng: Random) -> list[BaseGeometry]:
    """Draw a rectangle, an L, a T or a U about the origin, of at most about ``area`` (m^2)."""
    length = min(side * rng.uniform(0.15, 0.3), 80.0, 1.2 * math.sqrt(area) + 3.0)
    depth = length * rng.uniform(0.6, 1.0)
    x, y = length / 2.0, depth / 2.0
    whole = shapely.box(-x, -y, x, y)
    cut = rng.choice(
        (
            shapely.Polygon(),
            shapely.box(0.0, 0.0, x, y),
            shapely.box(-x, -y, -x / 3.0, 0.0).union(shapely.box(x / 3.0, -y, x, 0.0)),
            shapely.box(-x / 2.0, -y / 3.0, x / 2.0, y),
        )
    )
    return [whole.difference(cut)]


def _trailers(side: float, area: float, rng: Random) -> list[BaseGeometry]:
    """Draw a row of one to five trailers, side by side, 1 m apart."""
    length, width = TRAILER
    most = max(1, min(5, int(area / (length * width)), int(side / (3.0 * (width + 1.0)))))
    return [
        shapely.box(-length / 2.0, y, length / 2.0, y + width)
        for y in ((width + 1.0) * k for k in range(rng.randint(1, most)))
    ]
