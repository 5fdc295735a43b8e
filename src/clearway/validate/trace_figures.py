"""Whether the figures that a trace ends with are those of its events."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from clearway.model import Trace, Track, trip_spans
from clearway.validate.steps import Floats, moves
from clearway.validate.violation import Violation

TIME = 1e-3
# Distance and waiting are sums over many stored samples, each rounded to 1e-6.
SHARE = 1e-4


def judge_end(trace: Trace, tracks: dict[str, Track]) -> list[Violation]:
    """Return what is wrong with the ``end`` event; nothing where the trace has none."""
    endings = trace.of("end")
    if not endings:
        return []
    ending = endings[-1]
    t = float(ending["t"])
    found = []
    if len(endings) > 1 or trace.events[-1]["event"] != "end":
        found.append(_wrong(t, "the trace goes on after its end"))
    for name, true in _figures(trace, tracks).items():
        stated = ending.get(name)
        if stated is not None and abs(stated - true) > TIME + SHARE * abs(true):
            found.append(_wrong(t, f"{name} stated as {stated:.6g}, by the events {true:.6g}"))
    left = _figures(trace, tracks)["orders_open"]
    if ending["status"] == "done" and left:
        found.append(_wrong(t, f"it says done, but {left:.0f} orders are open"))
    return found


def _wrong(t: float, text: str) -> Violation:
    return Violation("end", (), t, (0.0, 0.0), None, text)


def _figures(trace: Trace, tracks: dict[str, Track]) -> dict[str, float]:
    states: dict[str, str] = {}
    makespan = 0.0
    for event in trace.of("order"):
        if states.get(event["order"]) != "done":
            states[event["order"]] = event["state"]
        if event["state"] == "done":
            makespan = float(event["t"])
    ways = [
        float(np.hypot(np.diff(track.x), np.diff(track.y))[moves(track)].sum())
        for track in tracks.values()
    ]
    return {
        "makespan": makespan,
        "orders_done": sum(state == "done" for state in states.values()),
        "orders_open": sum(
            state in ("released", "assigned", "started") for state in states.values()
        ),
        "distance": sum(ways),
        "waiting": _waiting(trace, tracks),
    }


def _waiting(trace: Trace, tracks: dict[str, Track]) -> float:
    """Return the time (s) that robots stand on trips without being at a visit."""
    services = _services(trace)
    total = 0.0
    for span in trip_spans(trace):
        track = tracks[span.robot]
        stands = np.append(~moves(track), True)
        edges = np.append(track.t, max(float(track.t[-1]), span.end) + 1.0)
        stood = np.concatenate([[0.0], np.cumsum(np.diff(edges) * stands)])

        def standing(
            begin: float, end: float, edges: Floats = edges, stood: Floats = stood
        ) -> float:
            low, high = np.interp([begin, max(begin, end)], edges, stood)
            return float(high - low)

        total += standing(span.begin, span.end)
        for begin, end in services.get(span.robot, ()):
            total -= standing(max(begin, span.begin), min(end, span.end))
    return total


def _services(trace: Trace) -> Mapping[str, list[tuple[float, float]]]:
    found: dict[str, list[tuple[float, float]]] = {}
    begun: dict[str, Mapping[str, Any]] = {}
    for event in trace.of("visit"):
        if event["state"] == "arrived":
            begun[event["robot"]] = event
        elif event["robot"] in begun:
            begin = float(begun.pop(event["robot"])["t"])
            found.setdefault(event["robot"], []).append((begin, float(event["t"])))
    for robot, event in begun.items():
        found.setdefault(robot, []).append((float(event["t"]), np.inf))
    return found
