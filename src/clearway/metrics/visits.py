"""When each robot makes its visits."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from clearway.metrics.motion import REST, arrival_sample, runs, track_of
from clearway.model import PlanRecord, Pose, Robot, Track, Visit, to_seconds

# A robot is at a visit within 1 cm and 1 degree (plan.json's promise).
NEAR = 0.01
ALIGNED = math.radians(1.0)
# Sample times are written with six decimals.
CLOCK_ERROR = 1e-6


class VisitTime(NamedTuple):
    """A visit that was made: its index in the robot's tour, and seconds of arrival and leaving."""

    visit: int
    arrive: float
    leave: float


class _Rest(NamedTuple):
    """A rest: the sample that shows its pose, and its first and last second."""

    sample: int
    start: float
    end: float


def visit_times(record: PlanRecord, robot: Robot) -> tuple[VisitTime, ...]:
    """Return the visits that the robot makes, in order.

    They are read from the record's exact paths. Where those are absent, a visit is made
    when the robot first stands at its pose, after the visit before, for its whole service;
    the list ends before the first visit that never happens.
    """
    if robot.id in record.paths:
        return tuple(
            VisitTime(stop.visit, to_seconds(stop.arrive), to_seconds(stop.leave))
            for stop in record.paths[robot.id].stops
        )
    return tuple(_seen(track_of(record, robot), record.tours.get(robot.id, ())))


def _seen(track: Track, tour: tuple[Visit, ...]) -> Iterator[VisitTime]:
    rests = _rests(track)
    clock = 0.0
    for index, visit in enumerate(tour):
        clock = max(clock, visit.not_before)
        near = _is_at(track, visit.pose)
        candidates = [
            max(clock, rest.start)
            for rest in rests
            if near[rest.sample]
            and rest.end - max(clock, rest.start) >= visit.service - CLOCK_ERROR
        ]
        if visit.service == 0.0:
            candidates += track.t[near & (track.t >= clock - CLOCK_ERROR)][:1].tolist()
        if not candidates:
            return
        arrive = max(clock, min(candidates))
        clock = arrive + visit.service
        yield VisitTime(index, arrive, clock)


def _rests(track: Track) -> list[_Rest]:
    rests = [
        _Rest(run.first, float(track.t[run.first]), float(track.t[run.last]))
        for run in runs(track)
        if run.kind == REST
    ]
    final = arrival_sample(track)
    return [*rests, _Rest(final, float(track.t[final]), math.inf)]


def _is_at(track: Track, pose: Pose) -> np.ndarray:
    turn = track.theta - pose.theta
    turn = turn - 2.0 * np.pi * np.round(turn / (2.0 * np.pi))
    near = np.hypot(track.x - pose.x, track.y - pose.y) <= NEAR
    return np.asarray(near & (np.abs(turn) <= ALIGNED))
