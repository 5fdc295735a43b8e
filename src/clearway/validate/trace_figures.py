"""Whether the figures that a trace ends with are those of its events."""

import numpy as np

from clearway.model import Trace, Track, trip_spans
from clearway.validate.steps import Bools, Floats, moves
from clearway.validate.violation import Violation

TIME = 1e-3
# Distance and waiting are sums over many stored samples, each rounded to 1e-6.
SHARE = 1e-4

Span = tuple[float, float]


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
    figures = _figures(trace, tracks)
    for name, true in figures.items():
        stated = ending.get(name)
        if stated is not None and abs(stated - true) > TIME + SHARE * abs(true):
            found.append(_wrong(t, f"{name} stated as {stated:.6g}, by the events {true:.6g}"))
    if ending["status"] == "done" and figures["orders_open"]:
        found.append(_wrong(t, f"it says done, but {figures['orders_open']:.0f} orders are open"))
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
    trips: dict[str, list[Span]] = {name: [] for name in tracks}
    for trip in trip_spans(trace):
        trips[trip.robot].append((trip.begin, trip.end))
    visits = _visits(trace)
    return sum(_stood(track, trips[name], visits[name]) for name, track in tracks.items())


def _visits(trace: Trace) -> dict[str, list[Span]]:
    found: dict[str, list[Span]] = {robot.id: [] for robot in trace.robots}
    begun: dict[str, float] = {}
    for event in trace.of("visit"):
        if event["state"] == "arrived":
            begun[event["robot"]] = float(event["t"])
        elif event["robot"] in begun:
            found[event["robot"]].append((begun.pop(event["robot"]), float(event["t"])))
    for robot, begin in begun.items():
        found[robot].append((begin, np.inf))
    return found


def _stood(track: Track, trips: list[Span], visits: list[Span]) -> float:
    """Return how long a robot stands within its trips, outside its visits."""
    ends = np.array([time for span in (*trips, *visits) for time in span if time < np.inf])
    grid = np.unique(np.concatenate([track.t, ends]))
    middle = 0.5 * (grid[:-1] + grid[1:])
    step = np.searchsorted(track.t, middle, side="right") - 1
    counts = (
        np.append(~moves(track), True)[step] & _within(middle, trips) & ~_within(middle, visits)
    )
    return float(np.diff(grid)[counts].sum())


def _within(times: Floats, spans: list[Span]) -> Bools:
    """Return which times lie in one of the spans, which follow on each other."""
    if not spans:
        return np.zeros(len(times), dtype=bool)
    begin, end = np.array(spans).T
    index = np.searchsorted(begin, times, side="right") - 1
    return np.asarray((index >= 0) & (times < end[index]))
