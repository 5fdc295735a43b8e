"""Events of a trace, as mappings that any recorder takes; times in seconds."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from clearway.formats.sampling import sample
from clearway.model import (
    Commitment,
    Obstacle,
    Order,
    Trajectory,
    Trip,
    to_seconds,
)
from clearway.protocols import Refusal, Told

Event = Mapping[str, Any]
Record = Callable[[Event], None]

MOST_ALTERNATIVES = 8


def motion(driven: Trajectory, modes: bool) -> Event | None:
    """Return what a robot has driven; nothing where it stood."""
    if not driven.pieces:
        return None
    track = sample(driven, modes)
    # What comes before the first piece is standing, which needs no samples.
    first = int(np.searchsorted(track.t, to_seconds(driven.timing[0][0]) - 1e-9))
    event: dict[str, Any] = {
        "event": "motion",
        "robot": driven.robot,
        "t": track.t[first:],
        "x": track.x[first:],
        "y": track.y[first:],
        "theta": track.theta[first:],
    }
    if modes:
        event["mode"] = list(track.mode[first:])
    return event


def order(now: int, id_: str, state: str, **more: Any) -> Event:
    """Return what has become of an order."""
    told = {key: value for key, value in more.items() if value is not None}
    return {"event": "order", "t": to_seconds(now), "order": id_, "state": state, **told}


def released(now: int, new: Order) -> Event:
    """Return that an order has come, with what it asks."""
    return {
        "event": "order",
        "t": to_seconds(now),
        "order": new.task.id,
        "state": "released",
        "fetches": new.task.fetches,
        "visits": len(new.task.visits),
        "due": new.due,
        "priority": new.priority,
    }


def visit(now: int, robot: str, trip: Trip, number: int, state: str, order: str | None) -> Event:
    """Return that a robot has arrived at a visit of its trip, or left it; for an open order."""
    made = trip.visits[number]
    event: dict[str, Any] = {
        "event": "visit",
        "t": to_seconds(now),
        "robot": robot,
        "task": made.task,
        "order": order,
        "state": state,
    }
    if state == "arrived":
        event |= {
            "pose": list(made.pose),
            "service": made.service,
            "load": made.load,
            "place": trip.goals[number],
            "purpose": trip.purpose,
        }
    return event


def wait(
    now: int, robot: str, causes: Sequence[str], until: int | None = None, because: str = ""
) -> Event:
    """Return that a robot stands, and for whom or what."""
    return {
        "event": "wait",
        "t": to_seconds(now),
        "robot": robot,
        "for": list(causes) or ["plan"],
        "until": None if until is None else to_seconds(until),
        "because": because,
    }


def load(now: int, robot: str, objects: Sequence[str]) -> Event:
    """Return what is on board from now on."""
    return {"event": "load", "t": to_seconds(now), "robot": robot, "objects": list(objects)}


def energy(now: int, robot: str, level: float) -> Event:
    """Return a battery's level."""
    return {"event": "energy", "t": to_seconds(now), "robot": robot, "level": round(level, 6)}


def stop(now: int, robot: str, state: str) -> Event:
    """Return that a robot has ``stopped`` by itself, or is ``moving`` again."""
    return {"event": "fault", "t": to_seconds(now), "kind": "stop", "robot": robot, "state": state}


def obstacle(now: int, name: str, found: Obstacle) -> Event:
    """Return that something stands where nothing was known to."""
    shape: dict[str, Any] = {"polygon": [list(point) for point in outline(found)]}
    return {
        "event": "fault",
        "t": to_seconds(now),
        "kind": "obstacle",
        "zone": name,
        "state": "closed",
        **shape,
    }


def outline(found: Obstacle) -> list[tuple[float, float]]:
    """Return a polygon that an obstacle fills; a disc's has 32 corners on its circle.

    A wall has no thickness; its polygon is 1 mm thick.
    """
    if found.polygon is not None:
        return [(x, y) for x, y in found.polygon]
    if found.disc is not None:
        x, y, r = found.disc
        angles = np.arange(32) * (2.0 * np.pi / 32)
        return [(x + r * float(np.cos(a)), y + r * float(np.sin(a))) for a in angles]
    assert found.wall is not None
    (x0, y0), (x1, y1) = found.wall
    length = math.hypot(x1 - x0, y1 - y0)
    a, b = -0.5e-3 * (y1 - y0) / length, 0.5e-3 * (x1 - x0) / length
    return [(x0 + a, y0 + b), (x0 - a, y0 - b), (x1 - a, y1 - b), (x1 + a, y1 + b)]


def decision(now: int, told: Told) -> Event:
    """Return a decision: what was chosen, what else might have been, and what came of it."""
    choice, outcome = told.choice, told.outcome
    event: dict[str, Any] = {
        "event": "decision",
        "t": to_seconds(now),
        "kind": choice.kind,
        "robot": choice.trip.robot,
        "order": choice.trip.order,
        "purpose": choice.trip.purpose,
        "chosen": choice.chosen,
        "score": _rounded(choice.score),
        "alternatives": [
            {"name": other.name, "score": _rounded(other.score)}
            for other in choice.alternatives[:MOST_ALTERNATIVES]
        ],
        "because": choice.because,
    }
    if isinstance(outcome, Refusal):
        event |= {"outcome": "refused", "reason": outcome.reason, "causes": list(outcome.causes)}
    else:
        event |= {"outcome": "committed", "route": _turning_points(outcome)}
        event |= {"rest": outcome.rest}
        event["arrive"] = [to_seconds(stop.arrive) for stop in outcome.trajectory.stops]
    event["cpu_s"] = round(told.cpu_s, 6)
    return event


def detour(now: int, trip: Trip | None, commitment: Commitment) -> Event:
    """Return that an obstacle stood in a robot's way, and what it does now."""
    goes_on = trip is not None and commitment.trip is trip
    ahead = [s for s in commitment.trajectory.stops if s.leave > now] if goes_on else []
    return {
        "event": "decision",
        "t": to_seconds(now),
        "kind": "detour",
        "robot": commitment.robot,
        "order": trip.order if trip is not None and goes_on else None,
        "purpose": trip.purpose if trip is not None and goes_on else "park",
        "chosen": "goes on another way" if goes_on else "gives way",
        "score": 0.0,
        "alternatives": [],
        "because": "an obstacle that nobody knew of stands in its way",
        "outcome": "committed",
        "route": _turning_points(commitment),
        "rest": commitment.rest,
        "arrive": [to_seconds(max(stop.arrive, now)) for stop in ahead],
        "cpu_s": 0.0,
    }


def _turning_points(commitment: Commitment) -> list[list[float]]:
    """Return where straight stretches of a route begin and end, to a centimetre."""
    points: list[list[float]] = []
    for pose in [commitment.trajectory.start, *(p.end for p in commitment.trajectory.pieces)]:
        point = [round(pose.x, 2) + 0.0, round(pose.y, 2) + 0.0]
        if points and point == points[-1]:
            continue
        if len(points) > 1 and _between(points[-2], points[-1], point):
            points.pop()
        points.append(point)
    return points


def _between(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> bool:
    cross = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
    along = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])
    return abs(cross) < 1e-3 and along > 0.0


def _rounded(score: float) -> float:
    return round(score, 6)
