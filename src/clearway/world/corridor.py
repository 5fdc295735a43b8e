"""The corridor experiment's sites: two halves of a fleet cross to the middle of the warehouse."""

import random

import numpy as np

from clearway.model import Order, Pose, Robot, Scenario, Site, Task, Visit
from clearway.world.standing import Standing
from clearway.world.warehouse import (
    HEADINGS,
    HEIGHT,
    MOST_TRIES,
    WIDTH,
    body_box,
    four_wheel_carrier,
    gap_between,
    warehouse_site,
)

# Where reference points may start: this far (m) from the wall on either side.
NEAREST, FARTHEST = 1.5, 8.5
# Targets stand in a row on the middle line, in slots this far apart (m).
MIDDLE, LOWEST, SLOT, SLOTS = 50.0, 3.0, 3.6, 16
APART = 0.5  # between bodies at their starts (m), as in `random_warehouse`


def random_corridor(robots: int, seed: int) -> Scenario:
    """Return robots on both sides of the warehouse, each with a target on its middle line.

    Half of them (one more where the number is odd) start in x from 1.5 to 8.5 m, the others
    in 91.5 to 98.5 m, anywhere that is clear by 0.1 m of walls and shelves and by 0.5 m of
    each other, with headings of whole quarter turns. Targets are distinct slots 3.6 m apart
    on x = 50, shuffled, with heading 0 or pi; whoever crosses does so through the aisles.

    Raises
    ------
    ValueError
        If there are more robots than the 16 slots, or none.
    """
    if not 1 <= robots <= SLOTS:
        raise ValueError(f"the corridor has {SLOTS} targets for 1 to {SLOTS} robots, not {robots}")
    rng = random.Random(seed)
    site = warehouse_site()
    starts = _starts(robots, site, rng)
    slots = rng.sample(range(SLOTS), robots)
    goals = [
        Pose(MIDDLE, round(LOWEST + SLOT * slot, 9), rng.choice((HEADINGS[0], HEADINGS[2])))
        for slot in slots
    ]
    return Scenario(
        name=f"corridor-{robots}",
        site=site,
        robot_types={"carrier": four_wheel_carrier()},
        robots=tuple(Robot(f"r{i}", "carrier", pose) for i, pose in enumerate(starts, start=1)),
        orders=tuple(
            Order(Task(f"t{i}", (Visit(f"t{i}", goal),), f"r{i}"))
            for i, goal in enumerate(goals, start=1)
        ),
        settings={"park": "never"},
        seed=seed,
    )


def _starts(robots: int, site: Site, rng: random.Random) -> list[Pose]:
    """Draw a legal start for each robot, by turns on the left and on the right."""
    standing, kind = Standing(site), four_wheel_carrier()
    found: list[Pose] = []
    for number in range(robots):
        for _ in range(MOST_TRIES):
            across = rng.uniform(NEAREST, FARTHEST)
            x = round(across if number % 2 == 0 else WIDTH - across, 2)
            pose = Pose(x, round(rng.uniform(0.0, HEIGHT), 2), rng.choice(HEADINGS))
            box = body_box(pose)
            if all(gap_between(box, body_box(other)) >= APART for other in found) and bool(
                standing.allows(kind, np.array([pose]))[0]
            ):
                found.append(pose)
                break
        else:
            raise ValueError(f"only {number} of {robots} starts fit; take fewer robots")
    return found
