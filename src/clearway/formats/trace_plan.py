"""What was driven in a trace, as the plan that it turned out to be."""

from collections import defaultdict
from collections.abc import Mapping
from typing import Any

import numpy as np

from clearway.model import PlanRecord, Pose, Status, Trace, Track, Visit

STANDING = "stop"
_ENDED = {
    "ended": "was over before all orders were done",
    "stuck": "is stuck with orders open",
    "stopped": "was stopped as its budget was spent",
    "interrupted": "was interrupted",
}


def plan_of(trace: Trace) -> PlanRecord:
    """Return the motion and visits of a trace as a plan, made when all was over.

    It is solved where the trace tells that all is done; else it says how the run ended.
    """
    reason = _reason(trace)
    tracks = {robot: _joined(parts) for robot, parts in _motions(trace).items()}
    tours: dict[str, list[Visit]] = {robot.id: [] for robot in trace.robots}
    for event in trace.of("visit"):
        if event["state"] == "arrived":
            tours[event["robot"]].append(
                Visit(
                    event["task"],
                    Pose(*event["pose"]),
                    event["service"],
                    event.get("load"),
                    not_before=event["t"],
                )
            )
    ends = {robot: _last_arrival(track) for robot, track in tracks.items()}
    return PlanRecord(
        scenario=trace.scenario,
        system=trace.system,
        seed=trace.seed,
        status=Status.SOLVED if reason is None else Status.STOPPED,
        reason=reason,
        site=trace.site,
        robot_types=trace.robot_types,
        robots=trace.robots,
        tours={robot: tuple(visits) for robot, visits in tours.items()},
        tracks=tracks,
        assignment={
            robot: tuple(dict.fromkeys(v.task for v in visits if v.task is not None))
            for robot, visits in tours.items()
        },
        sum_of_costs=round(sum(ends.values()), 6),
        makespan=max(ends.values(), default=0.0),
        parameters=trace.parameters,
        version=trace.version,
    )


def _reason(trace: Trace) -> str | None:
    """Return why not all is done; ``None`` where it is."""
    endings = trace.of("end")
    if not endings:
        return "the trace is cut"
    ending = endings[-1]
    if ending["status"] == "done":
        return None
    return f"the run {_ENDED.get(ending['status'], ending['status'])}"


def _motions(trace: Trace) -> dict[str, list[Mapping[str, Any]]]:
    parts: dict[str, list[Mapping[str, Any]]] = defaultdict(list)
    for event in trace.of("motion"):
        parts[event["robot"]].append(event)
    return parts


def _joined(parts: list[Mapping[str, Any]]) -> Track:
    """Return pieces of motion one after another, with standing between them and before."""
    t, x, y, theta = (
        np.concatenate([np.asarray(part[name], dtype=np.float64) for part in parts])
        for name in ("t", "x", "y", "theta")
    )
    modes: list[str | None] = []
    for part in parts:
        named = part.get("mode")
        modes += [None] * len(part["t"]) if named is None else list(named)
        if named is not None:
            modes[-1] = STANDING
    if t[0] > 0.0:
        t = np.insert(t, 0, 0.0)
        x, y, theta = (np.insert(array, 0, array[0]) for array in (x, y, theta))
        modes.insert(0, None if modes[0] is None else STANDING)
    return Track(t, x, y, theta, tuple(modes))


def _last_arrival(track: Track) -> float:
    moved = np.flatnonzero(
        (np.abs(np.diff(track.x)) >= 5e-6)
        | (np.abs(np.diff(track.y)) >= 5e-6)
        | (np.abs(np.diff(track.theta)) >= 5e-6)
    )
    return float(track.t[moved[-1] + 1]) if len(moved) else 0.0
