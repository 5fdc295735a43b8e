"""Bodies against obstacles, bounds and closed zones."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import shapely

from clearway.model import Robot, RobotType, Site
from clearway.validate.overlap import Encounters, Overlap, overlaps
from clearway.validate.shapes import (
    Part,
    footprint_parts,
    obstacle_parts,
    outside_parts,
    polygon_parts,
)
from clearway.validate.steps import Bools, Floats, Ints, Steps
from clearway.validate.sweep import Side, gap_at, overlapping
from clearway.validate.violation import Violation

CHUNK = 16


@dataclass(frozen=True)
class Thing:
    """Something fixed: its kind of violation, name, parts, and the depth (m) that is let pass."""

    kind: str
    name: str
    parts: tuple[Part, ...]
    tolerance: float


def margin_around(site: Site, kinds: Iterable[RobotType], motions: Iterable[Steps]) -> float:
    """Return how far around the bounds bodies can be (m)."""
    bounds = np.array(site.bounds)
    shapes = [kind.shape(loaded) for kind in kinds for loaded in (False, True)]
    reach = max((shape.circumradius for shape in shapes), default=0.0)
    beyond = [0.0]
    for motion in motions:
        xy = motion.pose[:, :2]
        beyond += [*(bounds.min(axis=0) - xy.min(axis=0)), *(xy.max(axis=0) - bounds.max(axis=0))]
    return float(max(beyond)) + 2.0 * reach + 1.0


class Surroundings:
    """All that stands on a site, ready to be asked."""

    def __init__(self, site: Site, overlap: float, border: float, margin: float) -> None:
        self._site = site
        self._things = [
            Thing("obstacle", f"obstacle {i}", obstacle_parts(obstacle), overlap)
            for i, obstacle in enumerate(site.obstacles)
        ]
        self._things += [
            Thing("zone", f"closed zone {zone.name}", polygon_parts(zone.polygon), overlap)
            for zone in site.zones_of("closed")
        ]
        if site.border == "closed":
            outside = outside_parts(site.bounds, margin)
            self._things.append(Thing("bounds", "the bounds", outside, border))
        self._stops: dict[str, Bools] = {}
        self._parts = [part for thing in self._things for part in thing.parts]
        self._owner = np.array(
            [i for i, thing in enumerate(self._things) for _ in thing.parts], dtype=np.intp
        )
        self._tolerance = np.array([thing.tolerance for thing in self._things])
        self._sizes = np.array([len(part.points) for part in self._parts], dtype=np.intp)
        self._tree = shapely.STRtree([part.outline for part in self._parts])

    def judge(self, robot: Robot, kind: RobotType, steps: Steps) -> list[Violation]:
        """Return where the robot's body is in something, each contact once."""
        bodies = (footprint_parts(kind.shape(False)), footprint_parts(kind.shape(True)))
        found: list[Encounters] = []
        empty, loaded = (max(part.reach for part in body) for body in bodies)
        step, part = self._near(steps, steps.where_loaded(loaded, empty))
        wanted = self._blocking(kind.name)[steps.loaded[step].astype(np.intp), self._owner[part]]
        step, part = step[wanted], part[wanted]
        for state, body in enumerate(bodies):
            for size in np.unique(self._sizes[part]):
                chosen = (steps.loaded[step] == bool(state)) & (self._sizes[part] == size)
                for piece in body:
                    found += self._deep(piece, steps, step[chosen], part[chosen])
        # Only bodies that were outside must stay out of a closed zone.
        within = {e.owner[i] for e in found for i in np.flatnonzero(self._starts_in_zone(e))}
        return [
            self._violation(robot, owner, worst)
            for owner, begin, worst in overlaps(found)
            if not (begin == 0.0 and owner in within)
        ]

    def _near(self, steps: Steps, reach: Floats) -> tuple[Ints, Ints]:
        """Return the pairs of step and part that may meet."""
        if not self._parts:
            return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
        first = np.arange(0, len(steps), CHUNK)
        ends = np.stack([steps.pose[:, :2], steps.pose[:, :2] + steps.change[:, :2]])
        low = np.minimum.reduceat(ends.min(axis=0) - reach[:, None], first)
        high = np.maximum.reduceat(ends.max(axis=0) + reach[:, None], first)
        boxes = shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
        chunk, part = self._tree.query(boxes, predicate="intersects")
        step = (first[chunk][:, None] + np.arange(CHUNK)).ravel()
        part = np.repeat(part, CHUNK)
        step, part = step[step < len(steps)], part[step < len(steps)]
        return self._within_reach(steps, reach, step, part)

    def _within_reach(
        self, steps: Steps, reach: Floats, step: Ints, part: Ints
    ) -> tuple[Ints, Ints]:
        keep = np.zeros(len(step), dtype=bool)
        order = np.argsort(part, kind="stable")
        cuts = np.flatnonzero(np.diff(part[order])) + 1
        for run in np.split(order, cuts):
            if not len(run):
                continue
            one, chosen = self._parts[part[run[0]]], steps.pick(step[run])
            middle = chosen.pose[:, :2] + 0.5 * chosen.change[:, :2]
            half = 0.5 * np.hypot(chosen.change[:, 0], chosen.change[:, 1])
            # Distance to the widest side; never more than the true one.
            support = (one.normals @ one.points.T).max(axis=1)
            away = (middle @ one.normals.T - support).max(axis=1) - one.radius
            if len(one.points) == 1:
                away = np.hypot(*(middle - one.points[0]).T) - one.radius
            keep[run] = away <= reach[step[run]] + half
        return step[keep], part[keep]

    def _deep(self, piece: Part, steps: Steps, step: Ints, part: Ints) -> list[Encounters]:
        if not len(step):
            return []
        local = np.unique(part)
        a = Side.moving(piece, steps.pick(step))
        b = Side.fixed([self._parts[i] for i in local], np.searchsorted(local, part))
        deep = overlapping(a, b, self._tolerance[self._owner[part]])
        if not deep.any():
            return []
        owner = self._owner[part[deep]]
        return [Encounters(owner, steps.pick(step[deep]), a.pick(deep), b.pick(deep))]

    def _blocking(self, kind: str) -> Bools:
        """Return what stops a type, empty and loaded; shape ``(2, num_things)``."""
        if kind not in self._stops:
            self._stops[kind] = np.array(
                [
                    [self._blocks(thing, kind, state) for thing in range(len(self._things))]
                    for state in (False, True)
                ],
                dtype=bool,
            )
        return self._stops[kind]

    def _blocks(self, thing: int, kind: str, loaded: bool) -> bool:
        if thing < len(self._site.obstacles):
            return self._site.obstacles[thing].stops(kind, loaded)
        return True

    def _starts_in_zone(self, encounters: Encounters) -> Bools:
        zone = np.array([self._things[owner].kind == "zone" for owner in encounters.owner])
        deep = gap_at(encounters.a, encounters.b, 0.0) < -self._tolerance[encounters.owner]
        return np.asarray(zone & deep & (encounters.steps.t0 == 0.0))

    def _violation(self, robot: Robot, owner: int, worst: Overlap) -> Violation:
        thing = self._things[owner]
        verb = "leaves" if thing.kind == "bounds" else "is in"
        text = (
            f"the body {verb} {thing.name} by {worst.depth * 1e3:.1f} mm, "
            f"more than {thing.tolerance * 1e3:.0f} mm"
        )
        return Violation(thing.kind, (robot.id,), worst.time, worst.place, worst.depth, text)
