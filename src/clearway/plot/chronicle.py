"""What each robot of a trace did when, as spans of time that can be looked up."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from clearway.model import Robot, Trace, Track, tracks_of, trip_spans
from clearway.plot.doings import Doing, Event, Span, doings


class Hold(NamedTuple):
    """A place that is a robot's from ``promised`` until ``left``; it stands there from ``come``."""

    promised: float
    come: float
    left: float
    robot: str


@dataclass(frozen=True)
class Diary:
    """One robot's part of a trace.

    Parameters
    ----------
    doings
        Without gaps and overlaps from 0 to the end of the run.
    trips
        With the decisions that committed the robot to them.
    loads, energy
        Events of these kinds, in order.
    """

    robot: Robot
    track: Track
    doings: list[Doing]
    trips: list[Span]
    visits: list[Span]
    loads: list[Event]
    energy: list[Event]

    def doing(self, time: float) -> Doing:
        """Return what it does at a moment of the run."""
        return self.doings[max(0, bisect_right(self.doings, time, key=lambda d: d.start) - 1)]

    def trip(self, time: float) -> Span | None:
        """Return the trip that it is on."""
        index = bisect_right(self.trips, time, key=lambda trip: trip.start) - 1
        return self.trips[index] if index >= 0 and time < self.trips[index].end else None

    def last_trip(self, time: float) -> Span | None:
        """Return the trip that has ended last."""
        index = bisect_right(self.trips, time, key=lambda trip: trip.end) - 1
        return self.trips[index] if index >= 0 else None


@dataclass(frozen=True)
class Chronicle:
    """A trace by robot, by order and by place.

    Parameters
    ----------
    orders
        Events of each order, in order.
    decisions
        Committed decisions for each order, in order.
    obstacles
        Obstacles that were there for a while; the event holds name and polygon.
    holds
        Who had which place, by rising ``promised``.
    """

    trace: Trace
    duration: float
    diaries: dict[str, Diary]
    orders: dict[str, list[Event]]
    decisions: dict[str, list[Event]]
    obstacles: list[Span]
    holds: dict[str, list[Hold]]

    def holder(self, place: str, time: float, but: str) -> Hold | None:
        """Return who has a place, or has it first of those to whom it is promised."""
        having = [
            hold
            for hold in self.holds.get(place, ())
            if hold.promised <= time < hold.left and hold.robot != but
        ]
        return min(having, key=lambda hold: hold.come, default=None)


def chronicle(trace: Trace) -> Chronicle:
    """Return what happened, ordered for look-ups."""
    by_robot: dict[str, dict[str, list[Event]]] = {robot.id: {} for robot in trace.robots}
    orders: dict[str, list[Event]] = {}
    decisions: dict[str, list[Event]] = {}
    for event in trace.events:
        kind = event["event"]
        if event.get("robot") in by_robot:
            by_robot[event["robot"]].setdefault(kind, []).append(event)
        if kind == "order":
            orders.setdefault(event["order"], []).append(event)
        if kind == "decision" and event.get("order") and event.get("outcome") != "refused":
            decisions.setdefault(event["order"], []).append(event)
    duration = max((float(np.max(event["t"])) for event in trace.events), default=0.0)
    tracks, trips = tracks_of(trace), _trips(trace)
    diaries = {
        robot.id: _diary(robot, tracks[robot.id], trips[robot.id], by_robot[robot.id], duration)
        for robot in trace.robots
    }
    return Chronicle(
        trace,
        duration,
        diaries,
        orders,
        decisions,
        _obstacles(trace, duration),
        _holds(diaries, duration),
    )


def _diary(
    robot: Robot,
    track: Track,
    trips: list[Span],
    told: Mapping[str, Sequence[Event]],
    duration: float,
) -> Diary:
    visits = _visits(told.get("visit", ()), duration)
    return Diary(
        robot,
        track,
        doings(track, visits, trips, told, duration),
        trips,
        visits,
        list(told.get("load", ())),
        list(told.get("energy", ())),
    )


def _trips(trace: Trace) -> dict[str, list[Span]]:
    """Pair trips with their decisions: each committed one begins a trip of its robot."""
    found: dict[str, list[Span]] = {robot.id: [] for robot in trace.robots}
    decisions: dict[str, list[Event]] = {robot.id: [] for robot in trace.robots}
    for event in trace.of("decision"):
        if event.get("robot") in decisions and event.get("outcome", "committed") == "committed":
            decisions[event["robot"]].append(event)
    for trip in trip_spans(trace):
        made = found[trip.robot]
        made.append(Span(trip.begin, trip.end, decisions[trip.robot][len(made)]))
    return found


def _visits(told: Sequence[Event], duration: float) -> list[Span]:
    found: list[Span] = []
    for event in told:
        if event["state"] == "arrived":
            found.append(Span(event["t"], duration, event))
        elif found and found[-1].end == duration:
            found[-1] = found[-1]._replace(end=event["t"])
    return found


def _obstacles(trace: Trace, duration: float) -> list[Span]:
    found: dict[str, Span] = {}
    ended: list[Span] = []
    for event in trace.of("fault"):
        name = event.get("zone")
        if name is None:
            continue
        if event["state"] == "closed":
            found.setdefault(name, Span(event["t"], duration, event))
        elif name in found:
            ended.append(found.pop(name)._replace(end=event["t"]))
    return sorted([*ended, *found.values()], key=lambda span: span.start)


def _holds(diaries: Mapping[str, Diary], duration: float) -> dict[str, list[Hold]]:
    """Return who has which place, from the decision to go there until the robot drives off."""
    found: dict[str, list[Hold]] = {}
    for robot, diary in diaries.items():
        begins = [doing.start for doing in diary.doings if doing.kind == "drive"]
        for visit in diary.visits:
            place = visit.event.get("place")
            if place is None:
                continue
            trip = diary.trip(visit.start)
            index = bisect_right(begins, visit.end - 1e-6)
            left = begins[index] if index < len(begins) else duration
            promised = min(trip.start, visit.start) if trip else visit.start
            found.setdefault(place, []).append(Hold(promised, visit.start, left, robot))
    return {place: sorted(holds) for place, holds in found.items()}
