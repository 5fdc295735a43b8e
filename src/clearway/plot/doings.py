"""What a robot does at each moment of a trace."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clearway.metrics.motion import REST, TURN, runs
from clearway.model import Track

Event = Mapping[str, Any]

# A turn on the way that is over sooner (s) is a part of the drive.
_SHORT = 0.05
# Standing on a trip for less (s), before anything else: orders take a moment to reach a robot.
_REACTION = 0.25


class Span(NamedTuple):
    """From ``start`` until ``end`` (s), with the event that it began with."""

    start: float
    end: float
    event: Event


class Doing(NamedTuple):
    """What a robot does from ``start`` until ``end`` (s).

    ``kind`` is ``drive``, ``turn``, ``service``, ``charge``, ``stop`` (of its own), ``wait``,
    ``refused`` (no plan for its next trip), ``idle`` (nothing to do) or ``stand`` (the trace does
    not say why). ``event`` is the visit, the fault, the wait or the refused decision behind it.
    """

    kind: str
    start: float
    end: float
    event: Event


def doings(
    track: Track,
    visits: Sequence[Span],
    trips: Sequence[Span],
    told: Mapping[str, Sequence[Event]],
    duration: float,
) -> list[Doing]:
    """Return what a robot does, without gaps and overlaps from 0 to ``duration`` (s).

    Time is cut where anything begins or ends; in each part the weightiest holds: a stop of its
    own, then visits, then moving, then waits as the trace tells them.

    Parameters
    ----------
    told
        The robot's events by kind.
    """
    moves: dict[str, list[Span]] = {"drive": [], "turn": []}
    for run in runs(track):
        start, end = float(track.t[run.first]), float(track.t[run.last])
        if run.kind != REST:
            is_turn = run.kind == TURN and end - start >= _SHORT
            moves["turn" if is_turn else "drive"].append(Span(start, end, {}))
    begins = sorted(s.start for spans in moves.values() for s in spans)
    waits = _until_it_moves(told.get("wait", ()), begins, duration)
    refused = [
        span
        for span in _until_it_moves(told.get("decision", ()), begins, duration)
        if span.event.get("outcome") == "refused"
    ]
    layers: list[tuple[str, Sequence[Span]]] = [
        ("stop", _stops(told.get("fault", ()), duration)),
        ("charge", [s for s in visits if s.event.get("purpose") == "charge"]),
        ("service", [s for s in visits if s.event.get("purpose") != "charge"]),
        *moves.items(),
        ("stop", [s for s in waits if "stop" in s.event["for"]]),
        ("wait", [s for s in waits if not {"order", "stop"} & set(s.event["for"])]),
        ("refused", refused),
        ("stand", trips),
    ]
    edges = {0.0, duration, *(edge for _, spans in layers for s in spans for edge in s[:2])}
    cuts = np.array(sorted(edge for edge in edges if 0.0 <= edge <= duration))
    middles = 0.5 * (cuts[:-1] + cuts[1:])
    kinds: list[tuple[str, Event]] = [("idle", {})] * len(middles)
    for kind, spans in reversed(layers):
        for place, span in zip(*_inside(spans, middles), strict=True):
            kinds[place] = (kind, {} if kind == "stand" else span.event)
    found: list[Doing] = []
    for start, end, (kind, event) in zip(cuts[:-1].tolist(), cuts[1:].tolist(), kinds, strict=True):
        # Moves, idleness and standing have no event of their own: theirs are all empty.
        if found and found[-1].kind == kind and (found[-1].event is event or not event):
            found[-1] = found[-1]._replace(end=end)
            continue
        if found and found[-1].kind == "stand" and found[-1].end - found[-1].start < _REACTION:
            start = found.pop().start
        found.append(Doing(kind, start, end, event))
    return found or [Doing("idle", 0.0, duration, {})]


def _inside(spans: Sequence[Span], middles: NDArray[np.float64]) -> tuple[list[int], list[Span]]:
    """Return which moments lie in a span, and in which; the spans do not overlap."""
    if not spans:
        return [], []
    index = np.searchsorted([span.start for span in spans], middles, side="right") - 1
    within = (index >= 0) & (middles < np.array([span.end for span in spans])[index])
    places = np.flatnonzero(within).tolist()
    return places, [spans[int(index[place])] for place in places]


def _until_it_moves(told: Sequence[Event], begins: Sequence[float], duration: float) -> list[Span]:
    """Return what holds from each event until the next one, or until the robot moves."""
    ends = [*(float(event["t"]) for event in told[1:]), duration]
    found: list[Span] = []
    for event, end in zip(told, ends[: len(told)], strict=True):
        index = bisect_right(begins, float(event["t"]) - 1e-6)
        move = begins[index] if index < len(begins) else duration
        found.append(Span(float(event["t"]), min(move, end), event))
    return found


def _stops(told: Sequence[Event], duration: float) -> list[Span]:
    found: list[Span] = []
    for event in told:
        if event["state"] == "stopped":
            found.append(Span(event["t"], duration, event))
        elif found and found[-1].end == duration:
            found[-1] = found[-1]._replace(end=event["t"])
    return found
