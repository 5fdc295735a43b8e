"""Hundreds of plans that are wrong by construction; the judge must catch them all."""

import math
from collections.abc import Iterator
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from clearway.model import Footprint, Limits, Obstacle, PlanRecord, Pose, Robot, RobotType, Track
from clearway.validate import validate_plan

SEEDS = range(10)
PUCK = RobotType("puck", Footprint(radius=0.2), "holonomic", Limits(speed=1.0))


def body_mutants(case) -> Iterator[tuple[str, PlanRecord]]:
    """Overlaps of 5 mm with something put in the way of a body."""
    for name in case.types:
        time, pose = case.moment(name)
        middle, out = case.side(name, pose)
        inside, along = middle - 0.005 * out, np.array([-out[1], out[0]])
        x, y = inside + 0.2 * out
        yield "obstacle", case.with_obstacle(Obstacle(disc=(x, y, 0.2)))
        yield (
            "obstacle",
            case.with_obstacle(Obstacle(wall=(tuple(inside), tuple(inside + 0.3 * out)))),
        )
        ring = [inside - 0.1 * along, inside + 0.1 * along, inside + 0.3 * out]
        yield "obstacle", case.with_obstacle(Obstacle(polygon=tuple(tuple(p) for p in ring)))
        # A horseshoe whose one end is in the body.
        horseshoe = [
            (0, 0.02),
            (0, 0.1),
            (0.3, 0.1),
            (0.3, -0.1),
            (0, -0.1),
            (0, -0.02),
            (0.2, -0.02),
            (0.2, 0.02),
        ]
        ring = [inside + u * out + v * along for u, v in horseshoe]
        yield "obstacle", case.with_obstacle(Obstacle(polygon=tuple(tuple(p) for p in ring)))
        yield "bounds", pushed_bounds(case, name, pose)
        yield from partners(case, time, middle, out)


def pushed_bounds(case, name: str, pose: Pose) -> PlanRecord:
    """Bounds that end 5 mm inside of a body, with a dent or along a whole side."""
    _, y0, _, y1 = case.body(name, pose).bounds
    side = case.width
    if case.rng.random() < 0.5:
        bounds = ((0, y0 + 0.005), (side, y0 + 0.005), (side, side), (0, side))
    else:
        corners = np.array(case.body(name, pose).convex_hull.exterior.coords)
        x = float(corners[corners[:, 1].argmax(), 0])
        bounds = (
            (0, 0),
            (side, 0),
            (side, side),
            (x + 0.3, side),
            (x + 0.3, y1 - 0.005),
            (x - 0.3, y1 - 0.005),
            (x - 0.3, side),
            (0, side),
        )
    return replace(case.record, site=replace(case.record.site, bounds=bounds))


def partners(case, time: float, middle, out) -> Iterator[tuple[str, PlanRecord]]:
    """Another body, standing or driving by, 5 mm deep in the first at ``time``."""
    record = case.record
    x, y = middle + (0.2 - 0.005) * out
    velocity = case.rng.uniform(-0.7, 0.7, 2)
    t = np.append(np.arange(0.0, time, 0.1), time)
    track = Track(
        t, x + velocity[0] * (t - time), y + velocity[1] * (t - time), 0.0 * t, (None,) * len(t)
    )
    for start, tracks in (
        (Pose(x, y, 0.0), {}),
        (Pose(float(track.x[0]), float(track.y[0]), 0.0), {"puck": track}),
    ):
        yield (
            "conflict",
            replace(
                record,
                robot_types={**record.robot_types, "puck": PUCK},
                robots=(*record.robots, Robot("puck", "puck", start)),
                tours={**record.tours, "puck": ()},
                tracks={**record.tracks, **tracks},
            ),
        )


def limit_mutants(case) -> Iterator[tuple[str, PlanRecord]]:
    """Limits of which one is 10 % below what is driven."""
    for name, kind in case.types.items():
        moving = [leg for leg in case.legs[name] if not isinstance(leg, float)]
        limits = kind.limits
        slower = replace(kind, limits=replace(limits, speed=limits.speed / 1.1))
        ahead = [leg for leg in moving if name != "car" or leg[1][0] > 0]
        if any(math.hypot(*leg[1][:2]) > 0.1 for leg in ahead):
            yield "speed", case.with_type(slower)
        if name == "car":
            if any(leg[1][0] < 0 for leg in moving):
                back = replace(limits, reverse_speed=limits.reverse_speed / 1.1)
                yield "reverse_speed", case.with_type(replace(kind, limits=back))
                never = replace(limits, reverse_speed=0.0)
                yield "reverse_speed", case.with_type(replace(kind, limits=never))
        elif any(abs(leg[1][2]) > 0.1 for leg in moving):
            lazy = replace(limits, yaw_rate=limits.yaw_rate / 1.1)
            yield "yaw_rate", case.with_type(replace(kind, limits=lazy))
        arcs = [leg for leg in moving if math.hypot(*leg[1][:2]) > 0.1 and abs(leg[1][2]) > 0.1]
        if limits.turning_radius and arcs:
            wide = replace(limits, turning_radius=limits.turning_radius * 1.1)
            yield "turning_radius", case.with_type(replace(kind, limits=wide))
        # From rest to full speed at once is speed / 0.2 s, at least 3.5 m/s^2 here.
        if any(math.hypot(*leg[1][:2]) > 0.4 for leg in moving):
            heavy = replace(limits, acceleration=2.5)
            yield "acceleration", case.with_type(replace(kind, limits=heavy))
            weak = replace(limits, deceleration=2.5)
            yield "deceleration", case.with_type(replace(kind, limits=weak))
    used = {leg[0] for leg in case.legs["crab"] if not isinstance(leg, float)}
    for mode in sorted(used):
        rest = tuple(m for m in ("stop", "forward", "reverse", "lateral-left") if m != mode)
        yield "mode", case.with_type(replace(case.types["crab"], modes=rest[:1]))


def sample_mutants(case) -> Iterator[tuple[str, PlanRecord]]:
    """Samples that are shifted, dropped or given another mode."""
    for name in case.types:
        track = case.record.tracks[name]
        moving = np.hypot(np.diff(track.x), np.diff(track.y)) > 0.01
        inner = np.flatnonzero(moving[:-1] & moving[1:]) + 1
        full = inner[track.t[inner + 1] - track.t[inner - 1] > 0.11]
        if len(full):
            keep = np.arange(len(track.t)) != case.rng.choice(full)
            mode = tuple(m for m, k in zip(track.mode, keep, strict=True) if k)
            arrays = {key: getattr(track, key)[keep] for key in ("t", "x", "y", "theta")}
            yield "step", case.with_track(name, **arrays, mode=mode)
        if len(inner) and name in ("car", "crab"):
            # 6 mm to the side of the way, in one sample.
            i = int(case.rng.choice(inner))
            dx, dy = track.x[i + 1] - track.x[i - 1], track.y[i + 1] - track.y[i - 1]
            shift = np.zeros(len(track.t))
            shift[i] = 0.006 / math.hypot(dx, dy)
            yield "slip", case.with_track(name, x=track.x - dy * shift, y=track.y + dx * shift)
        i = int(case.rng.integers(1, len(track.t)))
        away = np.where(np.arange(len(track.t)) == i, 0.3, 0.0)
        yield "speed", case.with_track(name, x=track.x + away)
        yield "start", case.with_track(name, x=track.x + 0.0011)
    track = case.record.tracks["crab"]
    moving = np.hypot(np.diff(track.x), np.diff(track.y)) > 0.01
    opposite = {"forward": "reverse", "reverse": "forward", "lateral": "rotate"}
    for i in case.rng.choice(np.flatnonzero(moving), 3):
        family, *side = track.mode[i].split("-")
        other = "-".join([opposite[family], *side])
        mode = (*track.mode[:i], other, *track.mode[i + 1 :])
        yield "mode", case.with_track("crab", mode=mode)


def work_mutants(case) -> Iterator[tuple[str, PlanRecord]]:
    """Visits that are missed, cut short or out of order, and figures that are wrong."""
    record = case.record
    for name, visits in record.tours.items():
        k = int(case.rng.integers(len(visits)))
        angle, pose = float(case.rng.uniform(-3, 3)), visits[k].pose
        away = Pose(pose.x + 0.011 * math.cos(angle), pose.y + 0.011 * math.sin(angle), pose.theta)
        turned = pose._replace(theta=pose.theta + math.copysign(math.radians(1.1), angle))
        changed = {
            "visit": [replace(visits[k], pose=away), replace(visits[k], pose=turned)],
            "service": [replace(visits[k], service=visits[k].service + 0.05)],
        }
        for kind, others in changed.items():
            for other in others:
                # The robot stays at its last visit for ever: no service there is too long.
                last = kind == "service" and k == len(visits) - 1
                last = last and isinstance(case.legs[name][-1], float)
                tour = (*visits[:k], other, *visits[k + 1 :])
                if not last:
                    yield kind, replace(record, tours={**record.tours, name: tour})
        tracks = {other: track for other, track in record.tracks.items() if other != name}
        yield "visit", replace(record, tracks=tracks)
    yield "sum_of_costs", replace(record, sum_of_costs=record.sum_of_costs * 1.001)
    yield "makespan", replace(record, makespan=record.makespan * 1.001)
    yield "lower_bound", replace(record, lower_bound=record.sum_of_costs * 1.001)
    names = dict(zip(record.assignment, reversed(record.assignment.values()), strict=True))
    yield "assignment", replace(record, assignment=names)


@pytest.mark.parametrize("seed", SEEDS)
def test_mutants_of_a_right_plan_are_caught(
    seed: int, by_hand: ModuleType, random_plans: ModuleType
) -> None:
    """A plan right by construction is right; more than sixty wrong ones are found wrong."""
    case = random_plans.Case(seed, by_hand)
    assert validate_plan(case.record) == []
    mutants = [
        *body_mutants(case),
        *limit_mutants(case),
        *sample_mutants(case),
        *work_mutants(case),
    ]
    missed = []
    for i, (kind, record) in enumerate(mutants):
        found = validate_plan(record)
        # A pose beside the way may be passed for a moment, and a service that lasts longer
        # may leave no time for the visit after it.
        work = {"visit", "service"}
        kinds = work if kind in work else {kind}
        if not kinds & {violation.kind for violation in found}:
            missed.append((i, kind, [str(violation) for violation in found[:2]]))
    assert len(mutants) > 60
    assert missed == []
