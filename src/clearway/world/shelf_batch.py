"""Batches of orders for a warehouse whose robots carry shelves: the experiments of system B."""

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from clearway.model import Layout, Order, Pose, Robot, Scenario, Task, Zone
from clearway.world.channels import agv_type, site_of

AGV = "agv"


def shelf_batch(
    layout: Layout,
    robots: int,
    orders: int,
    seed: int,
    *,
    zone: Sequence[int] | None = None,
    repeat: bool = False,
    turn_seconds: float = 0.0,
    energy: tuple[float, float] = (1.0, 1.0),
    everywhere: bool = False,
    speed: float | None = None,
    settings: Mapping[str, Any] | None = None,
) -> Scenario:
    """Return orders that are all released at 0 for shelves drawn by number (R-B14, R-B15, R-B43).

    Robots begin idle under shelves of the lowest row, equally spaced (R-B20). The same seed draws
    the same shelves in each layout that numbers its shelves alike.

    Parameters
    ----------
    zone
        Numbers of the shelves, from 1 on, that orders are drawn from; ``None``: all.
    repeat
        Draw with replacement.
    energy
        Lowest and highest level of a battery at the start, drawn evenly.
    everywhere
        Spread the robots over all places instead.
    speed
        In m/s; ``None``: one cell a second.
    settings
        Of the system.

    Raises
    ------
    ValueError
        If there are fewer shelves than orders, or places in the lowest row than robots.
    """
    site = site_of(layout)
    places = site.zones_of("shelf")
    numbers = list(zone) if zone is not None else list(range(1, len(places) + 1))
    if not repeat and orders > len(numbers):
        raise ValueError(f"orders: {orders} are more than the {len(numbers)} shelves to draw from")
    drawn = random.Random(f"{seed}/orders")
    shelves = drawn.choices(numbers, k=orders) if repeat else drawn.sample(numbers, orders)
    levels = random.Random(f"{seed}/energy")
    kind = replace(agv_type(layout, turn_seconds), name=AGV)
    if speed is not None:
        kind = replace(kind, limits=replace(kind.limits, speed=speed))
    return Scenario(
        name=f"{layout.rule}-{robots}x{orders}",
        site=site,
        robot_types={AGV: kind},
        robots=tuple(
            Robot(f"agv-{i + 1}", AGV, pose, energy=round(levels.uniform(*energy), 4))
            for i, pose in enumerate(_spread(places, robots, everywhere))
        ),
        orders=tuple(
            Order(Task(f"o{i + 1}", (), fetches=f"g{number}")) for i, number in enumerate(shelves)
        ),
        system="bidirectional",
        settings=dict(settings or {}),
        seed=seed,
    )


def lower_left(layout: Layout) -> list[int]:
    """Return the numbers of the shelves of the first block in its lowest three pairs of rows.

    That is the area of experiment E19 (R-B42): 54 shelves at the paper's size.
    """
    per_row = sum(layout.blocks)
    return [row * per_row + column + 1 for row in range(6) for column in range(layout.blocks[0])]


def _spread(places: Sequence[Zone], robots: int, everywhere: bool) -> list[Pose]:
    """Return places, equally spaced, in the lowest row, or in all."""
    poses = sorted(
        (zone.pose for zone in places if zone.pose is not None), key=lambda p: (p.y, p.x)
    )
    row = poses if everywhere else [pose for pose in poses if pose.y == poses[0].y]
    if robots > len(row):
        raise ValueError(f"robots: {robots} are more than the {len(row)} places to start at")
    return [row[(2 * i + 1) * len(row) // (2 * robots)] for i in range(robots)]
