"""A warehouse in which orders never end: pick places between shelves, stations, bays to rest in."""

import math
import random
from collections.abc import Sequence
from dataclasses import replace

from clearway.model import (
    Draw,
    OrderStream,
    Polygon,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Simulation,
    Zone,
)
from clearway.world.fleets import FLEETS
from clearway.world.shapes import body_shape
from clearway.world.warehouse import (
    BODY_LENGTH,
    BODY_WIDTH,
    HEIGHT,
    SHELF_DEPTH,
    SHELF_LEFT,
    SHELF_LENGTH,
    SHELF_ROWS,
    WIDTH,
    warehouse_site,
)

WALL_ROWS = tuple(round(2.4 * (j + 1), 9) for j in range(24))  # of bodies along an outer wall
PICK_GAP = 0.3  # between two pick places (m)
MOST_TRIES = 20_000


def lifelong_warehouse(
    robots: int,
    seed: int,
    *,
    fleet: str = "cars",
    picks: int = 100,
    open_orders: int = 10,
    minutes: float = 30.0,
    service: float = 5.0,
) -> Scenario:
    """Return a fleet in its bays, and orders from a pick place between shelves to a station.

    Eight stations stand across along each outer wall, and two bays between any two of them, with
    0.4 m between bodies; five bays in line in the middle cross aisle, and six along the wall of
    each half of the end aisles. Pick places lie in the aisles of
    4.5 m, 0.15 m from a shelf and in line with it, where another car can just pass; carriers
    also stand across, where none can.

    Parameters
    ----------
    fleet
        ``cars`` or ``carriers``; carriers also pick across an aisle.
    picks
        Number of pick places; bodies at any two are 0.3 m apart.
    open_orders
        Orders waiting at all times.
    service
        Time at a pick place and at a station (s).

    Raises
    ------
    ValueError
        If robots or pick places do not fit, or the fleet is unknown.
    """
    if fleet not in ("cars", "carriers"):
        raise ValueError(f"fleet: cars or carriers drive in the warehouse, not {fleet!r}")
    kind = FLEETS[fleet][0]
    bays = _spread(_bay_centres(), robots)
    stations = [place for y in WALL_ROWS[1::3] for place in _at_walls(y)]
    headings = (0.0, math.pi) if fleet == "cars" else (0.0, math.pi, math.pi / 2, -math.pi / 2)
    places = {
        "parking": bays,
        "station": stations,
        "shelf": _picks(picks, kind, headings, random.Random(seed)),
    }
    names = {"parking": "bay", "station": "station", "shelf": "pick"}
    zones = tuple(
        _zone(f"{names[what]}-{i + 1}", what, kind, _reference(kind, centre))
        for what, centres in places.items()
        for i, centre in enumerate(centres)
    )
    draws = (Draw("shelf", service), Draw("station", service))
    return Scenario(
        name=f"lifelong-{robots}{fleet}",
        site=replace(warehouse_site(), zones=zones),
        robot_types={kind.name: kind},
        robots=tuple(
            Robot(f"r{i + 1}", kind.name, _reference(kind, centre)) for i, centre in enumerate(bays)
        ),
        orders=(),
        seed=seed,
        simulation=Simulation(
            until=60.0 * minutes,
            streams=(OrderStream("orders", open=open_orders, draws=draws),),
        ),
    )


def _reference(kind: RobotType, centre: Pose) -> Pose:
    """Return where the reference point is of a body whose middle is at ``centre``."""
    x0, y0, x1, y1 = body_shape(kind.footprint, Pose(0.0, 0.0, 0.0)).geometry.bounds
    return centre.compose(Pose(-(x0 + x1) / 2.0, -(y0 + y1) / 2.0, 0.0))


def _zone(name: str, what: str, kind: RobotType, pose: Pose) -> Zone:
    corners = kind.footprint.parts[0]
    outline: Polygon = tuple(
        (round(at.x, 9), round(at.y, 9))
        for at in (pose.compose(Pose(x, y, 0.0)) for x, y in corners)
    )
    return Zone(name, what, outline, pose)


def _at_walls(y: float) -> tuple[Pose, Pose]:
    return Pose(1.7, y, 0.0), Pose(WIDTH - 1.7, y, math.pi)


def _bay_centres() -> list[Pose]:
    bays = [bay for j, y in enumerate(WALL_ROWS) if j % 3 != 1 for bay in _at_walls(y)]
    bays += [Pose(50.0, y, math.pi / 2.0) for y in SHELF_ROWS[::2]]
    for left in SHELF_LEFT:
        for share in (1, 2, 3, 4, 5, 6):
            x = left + SHELF_LENGTH * share / 7.0
            bays += [Pose(x, 1.2, 0.0), Pose(x, HEIGHT - 1.2, math.pi)]
    return bays


def _spread(poses: Sequence[Pose], count: int) -> list[Pose]:
    """Return some poses, each the farthest from those before."""
    if not 0 < count <= len(poses):
        raise ValueError(f"robots: 1 to {len(poses)} have a bay in the warehouse, not {count}")
    chosen, rest = [poses[0]], list(poses[1:])
    while len(chosen) < count:
        far = max(rest, key=lambda pose: min(pose.distance(other) for other in chosen))
        rest.remove(far)
        chosen.append(far)
    return chosen


def _picks(
    count: int, kind: RobotType, headings: Sequence[float], rng: random.Random
) -> list[Pose]:
    """Draw middles of bodies in the aisles between shelves."""
    chosen: list[Pose] = []
    bodies: list[Polygon] = []
    for _ in range(MOST_TRIES):
        if len(chosen) == count:
            return chosen
        x = round(rng.choice(SHELF_LEFT) + rng.uniform(2.0, SHELF_LENGTH - 2.0), 1)
        theta = rng.choice(headings)
        half = (BODY_WIDTH if abs(math.cos(theta)) > 0.5 else BODY_LENGTH) / 2.0
        beside = SHELF_DEPTH / 2.0 + PICK_GAP / 2.0 + half
        y = rng.choice(SHELF_ROWS[:-1]) + rng.choice((beside, 6.0 - beside))
        pose = Pose(x, round(y, 9), theta)
        shape = body_shape(kind.footprint, _reference(kind, pose)).geometry
        if all(shape.distance(other) >= PICK_GAP - 1e-9 for other in bodies):
            chosen.append(pose)
            bodies.append(shape)
    raise ValueError(f"picks: only {len(chosen)} of {count} fit between the shelves; take fewer")
