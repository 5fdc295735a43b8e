"""Seeded instances for planners: a site, a fleet, and a start and a goal for each robot."""

import itertools
import math
from collections.abc import Iterator
from random import Random

import numpy as np

from clearway.model import Order, Pose, Robot, RobotType, Scenario, Site, Task, Visit
from clearway.world.fleets import FLEETS, lanes_of, widest_disc
from clearway.world.passages import Passages
from clearway.world.reach import inscribed_disc
from clearway.world.shapes import Shape, body_shape
from clearway.world.sites import KINDS, Size
from clearway.world.standing import Standing

GAP = 0.3  # between two starts, and between two goals (m)
FAR = 0.25  # of the larger side lies between start and goal where a place is found
LARGEST_SIDE = 2000.0
MOST_TRIES = 4000  # poses drawn for one robot
BATCH = 256


def generate(
    kind: str,
    *,
    robots: int,
    size: Size,
    fleet: str = "cars",
    density: float | None = None,
    seed: int = 0,
) -> Scenario:
    """Return an instance in which each robot has one goal of its own.

    Bodies keep 0.1 m from obstacles and bounds, 0.3 m from each other at starts and at goals.
    Between all of them, standing at their starts or at their goals, the widest disc inside a
    body of the fleet can still pass. Robots that steer like cars have 2 m of straight way.

    Parameters
    ----------
    kind
        One of `KINDS`.
    size
        Extent along x and y (m).
    fleet
        One of `FLEETS`.
    density
        Share of the floor under obstacles, got as near as the kind's pattern allows; absent:
        the kind's own.

    Raises
    ------
    ValueError
        If a value is out of range or the robots do not fit; begins with the parameter's name.
    """
    name = f"{kind}-{size[0]:g}x{size[1]:g}-{robots}{fleet}-seed{seed}"
    chosen = _checked(kind, robots, size, fleet, density)
    rng = Random(seed)
    types = FLEETS[fleet][:robots]
    made = KINDS[kind].build(size, chosen, lanes_of(types), rng)
    team = [types[i % len(types)] for i in range(robots)]
    starts, goals = _Places(made, types, rng).starts_and_goals(team)
    return Scenario(
        name=name,
        site=made,
        robot_types={each.name: each for each in types},
        robots=tuple(
            Robot(f"r{i}", each.name, start)
            for i, (each, start) in enumerate(zip(team, starts, strict=True), start=1)
        ),
        orders=tuple(
            Order(Task(f"t{i}", (Visit(f"t{i}", goal),), f"r{i}"))
            for i, goal in enumerate(goals, start=1)
        ),
        settings={"park": "never"},
        seed=seed,
    )


def _checked(kind: str, robots: int, size: Size, fleet: str, density: float | None) -> float:
    """Return the density to use, once all values are in range."""
    if kind not in KINDS:
        raise ValueError(f"kind: there is no {kind!r}; take one of {', '.join(KINDS)}")
    if fleet not in FLEETS:
        raise ValueError(f"fleet: there is no {fleet!r}; take one of {', '.join(FLEETS)}")
    if not all(0.0 < side <= LARGEST_SIDE for side in size):
        told = " ".join(f"{side:g}" for side in size)
        raise ValueError(f"size: both sides must be above 0 and at most 2000 m, got {told}")
    if robots < 1:
        raise ValueError(f"robots: must be 1 or more, got {robots}")
    least = min(body_shape(each.footprint, Pose(0.0, 0.0, 0.0)).area for each in FLEETS[fleet])
    if robots * least > size[0] * size[1]:
        raise ValueError(
            f"robots: {robots} bodies cover more than {size[0]:g} m x {size[1]:g} m; "
            "take fewer robots or a larger size"
        )
    chosen = KINDS[kind].density if density is None else density
    if not KINDS[kind].least <= chosen <= KINDS[kind].most:
        raise ValueError(
            f"density: for {kind} take a share of the floor from {KINDS[kind].least:g} "
            f"to {KINDS[kind].most:g}, got {chosen:g}"
        )
    return chosen


class _Places:
    """Draws poses on a site."""

    def __init__(self, site: Site, types: tuple[RobotType, ...], rng: Random) -> None:
        self._standing = Standing(site)
        self._passages = Passages(site, widest_disc(types))
        self._aisle = lanes_of(types).aisle
        self._rng = rng
        xs, ys = zip(*site.bounds, strict=True)
        self._box = (min(xs), min(ys), max(xs), max(ys))
        self._far = FAR * max(self._box[2] - self._box[0], self._box[3] - self._box[1])
        self._legal = {each.name: self._draw(each) for each in types}

    def starts_and_goals(self, team: list[RobotType]) -> tuple[list[Pose], list[Pose]]:
        """Return a start and a goal for each robot."""
        starts = self._place(team, "starts", None)
        return starts, self._place(team, "goals", starts)

    def _place(self, team: list[RobotType], what: str, away: list[Pose] | None) -> list[Pose]:
        """Draw a pose for each robot in turn, at first only far from the one in ``away``."""
        crowd, passages = _Crowd(team), self._passages.beside()
        found: list[Pose] = []
        for i, kind in enumerate(team):
            for least in (self._far, 0.0) if away else (0.0,):
                tried = itertools.islice(self._legal[kind.name], MOST_TRIES)
                far = (p for p in tried if p and (not away or p.distance(away[i]) >= least))
                pose = next((p for p in far if self._fits(kind, p, crowd, passages)), None)
                if pose:
                    break
            if not pose:
                raise ValueError(
                    f"robots: {i} of {len(team)} {what} fit, then there was none for a {kind.name} "
                    f"in {MOST_TRIES} tries; take fewer robots, a larger size or a lower density"
                )
            crowd.add(kind, pose)
            passages.take(kind.footprint, pose)
            found.append(pose)
        return found

    def _fits(self, kind: RobotType, pose: Pose, crowd: "_Crowd", passages: Passages) -> bool:
        return crowd.has_room(kind, pose) and not passages.is_closed_by(
            kind.footprint, pose, self._aisle
        )

    def _draw(self, kind: RobotType) -> Iterator[Pose | None]:
        """Draw poses without end; ``None`` stands for one that obstacles or bounds forbid."""
        (x, y), _ = inscribed_disc(kind.footprint)
        middle = Pose(x, y, 0.0)
        x0, y0, x1, y1 = self._box
        while True:
            # Three decimals of an angle below pi.
            drawn = [
                Pose(
                    round(self._rng.uniform(x0, x1), 3),
                    round(self._rng.uniform(y0, y1), 3),
                    round(self._rng.uniform(-3.141, 3.141), 3),
                )
                for _ in range(BATCH)
            ]
            allowed = self._standing.allows(kind, np.array(drawn))
            for pose, stands in zip(drawn, allowed.tolist(), strict=True):
                at = pose.compose(middle)
                yield pose if stands and self._passages.leads_to(at.x, at.y) else None


class _Crowd:
    """Bodies that stand, asked whether another one keeps its distance from them."""

    def __init__(self, team: list[RobotType]) -> None:
        self._cell = 2.0 * max(kind.footprint.circumradius for kind in team) + GAP
        self._near: dict[tuple[int, int], list[Shape]] = {}

    def has_room(self, kind: RobotType, pose: Pose) -> bool:
        body, (i, j) = body_shape(kind.footprint, pose), self._key(pose)
        around = [(i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)]
        return all(body.gap(other) >= GAP for key in around for other in self._near.get(key, ()))

    def add(self, kind: RobotType, pose: Pose) -> None:
        body = body_shape(kind.footprint, pose)
        self._near.setdefault(self._key(pose), []).append(body)

    def _key(self, pose: Pose) -> tuple[int, int]:
        return math.floor(pose.x / self._cell), math.floor(pose.y / self._cell)
