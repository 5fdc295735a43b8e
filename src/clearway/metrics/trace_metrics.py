"""The figures of a run through time, computed from its trace alone."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from clearway.metrics.course import Course, Span, common, spans_of
from clearway.metrics.tellings import (
    OrderStory,
    end_of,
    energy_levels,
    loaded_spans,
    order_stories,
    real_waits,
    visit_spans,
)
from clearway.model import Trace, TripSpan, tracks_of, trip_spans

HOUR = 3600.0


@dataclass(frozen=True)
class RobotFigures:
    """One robot's share; lengths in m, times in s, shares of ``duration`` in [0, 1].

    Parameters
    ----------
    utilisation
        Share of the time on trips.
    service
        Time at visits.
    waiting
        Standing on trips without being at a visit.
    empty
        Driven with nothing on board on trips for orders.
    energy_used
        Sum of all drops of its level: full charges.
    """

    robot: str
    trips: int
    orders_done: int
    utilisation: float
    service: float
    waiting: float
    wait_share: float
    distance: float
    empty: float
    energy_used: float
    lowest_energy: float


@dataclass(frozen=True)
class DecisionFigures:
    """How many decisions were told, how many refused, and the CPU time (s) that they took."""

    count: int
    refused: int
    cpu_total: float
    cpu_median: float
    cpu_p99: float


@dataclass(frozen=True)
class TraceMetrics:
    """The figures of one run; lengths in m, times in s.

    Parameters
    ----------
    status
        As the trace ends; ``cut short`` where it has no end.
    duration
        Last second of the trace.
    makespan
        When the last order that is done was done; 0 if none is.
    orders_failed
        Failed or called off.
    throughput
        Orders done per hour of ``duration``.
    service_time_mean, service_time_p95
        From release to done; ``None`` if no order is done.
    tardiness
        Sum over orders done of the time after they were due; ``None`` where none has a due time.
    orders_late
        Orders done late, or open though they are due.
    utilisation, wait_share
        Means of the robots' shares.
    pickups
        How often a robot got something on board; where none ever did, all travel is empty.
    empty_share
        Part of ``distance`` driven with nothing on board on trips for orders.
    waits, waits_for_robots
        Number of times that robots with something to do had to wait, and for another robot.
    """

    status: str
    robots: int
    duration: float
    makespan: float
    orders: int
    orders_done: int
    orders_open: int
    orders_failed: int
    throughput: float
    service_time_mean: float | None
    service_time_p95: float | None
    tardiness: float | None
    orders_late: int
    utilisation: float
    waiting: float
    wait_share: float
    distance: float
    pickups: int
    empty: float
    empty_share: float
    energy_used: float
    lowest_energy: float
    waits: int
    waits_for_robots: int
    decisions: DecisionFigures
    per_robot: tuple[RobotFigures, ...]


def trace_metrics(trace: Trace) -> TraceMetrics:
    """Return the figures of a trace, whoever wrote it and wherever it ends."""
    end = end_of(trace)
    stories = order_stories(trace)
    per_robot = _per_robot(trace, stories, end)
    done = [story for story in stories.values() if story.state == "done"]
    served = [story.closed - story.released for story in done if story.closed is not None]
    endings, waits, count = trace.of("end"), real_waits(trace), max(len(per_robot), 1)
    distance = sum(each.distance for each in per_robot)
    empty = sum(each.empty for each in per_robot)
    known = {robot.id for robot in trace.robots}
    return TraceMetrics(
        status=endings[-1]["status"] if endings else "cut short",
        robots=len(trace.robots),
        duration=end,
        makespan=max((story.closed or 0.0 for story in done), default=0.0),
        orders=len(stories),
        orders_done=len(done),
        orders_open=sum(story.closed is None for story in stories.values()),
        orders_failed=sum(story.state in ("failed", "cancelled") for story in stories.values()),
        throughput=HOUR * len(done) / end if end else 0.0,
        service_time_mean=float(np.mean(served)) if served else None,
        service_time_p95=float(np.percentile(served, 95)) if served else None,
        tardiness=_tardiness(stories),
        orders_late=_late(stories, end),
        utilisation=sum(each.utilisation for each in per_robot) / count,
        waiting=sum(each.waiting for each in per_robot),
        wait_share=sum(each.wait_share for each in per_robot) / count,
        distance=distance,
        pickups=sum(len(spans) for spans in loaded_spans(trace, end).values()),
        empty=empty,
        empty_share=empty / distance if distance else 0.0,
        energy_used=sum(each.energy_used for each in per_robot),
        lowest_energy=min((each.lowest_energy for each in per_robot), default=1.0),
        waits=len(waits),
        waits_for_robots=sum(not known.isdisjoint(wait["for"]) for wait in waits),
        decisions=_decisions(trace),
        per_robot=per_robot,
    )


def ending(trace: Trace) -> dict[str, Any]:
    """Return the figures that the ``end`` event of a trace carries, from its other events.

    They are ``makespan, orders_done, orders_open, distance, waiting``, rounded to 1e-6, as the
    judge computes them.
    """
    metrics = trace_metrics(trace)
    return {
        "makespan": round(metrics.makespan, 6),
        "orders_done": metrics.orders_done,
        "orders_open": metrics.orders_open,
        "distance": round(metrics.distance, 6),
        "waiting": round(metrics.waiting, 6),
    }


def trace_to_json(metrics: TraceMetrics) -> dict[str, Any]:
    """Return the content of ``metrics.json``; CPU times, never twice the same, are ``timings``."""
    content = asdict(metrics)
    decisions = content["decisions"]
    content["timings"] = {key: decisions.pop(key) for key in list(decisions) if "cpu" in key}
    content["per_robot"] = {entry.pop("robot"): entry for entry in content["per_robot"]}
    return content


def _per_robot(
    trace: Trace, stories: dict[str, OrderStory], end: float
) -> tuple[RobotFigures, ...]:
    tracks, levels = tracks_of(trace), energy_levels(trace)
    visits, loads = visit_spans(trace, end), loaded_spans(trace, end)
    trips: dict[str, list[TripSpan]] = {robot.id: [] for robot in trace.robots}
    for trip in trip_spans(trace):
        trips[trip.robot].append(trip)
    done = [story.robot for story in stories.values() if story.state == "done"]
    return tuple(
        _robot(
            name,
            Course(track, end),
            trips[name],
            visits[name],
            loads[name],
            levels[name],
            done.count(name),
            end,
        )
        for name, track in tracks.items()
    )


def _robot(
    name: str,
    course: Course,
    trips: Sequence[TripSpan],
    visits: Sequence[Span],
    loads: Sequence[Span],
    levels: Sequence[float],
    done: int,
    end: float,
) -> RobotFigures:
    spans = spans_of((trip.begin, trip.end) for trip in trips)
    at_work = spans[[trip.order is not None for trip in trips]]
    at_visits, loaded = spans_of(visits), spans_of(loads)
    waiting = course.stood(spans) - course.stood(common(spans, at_visits))
    empty = course.driven(at_work) - course.driven(common(at_work, loaded))
    return RobotFigures(
        robot=name,
        trips=sum(trip.is_complete for trip in trips),
        orders_done=done,
        utilisation=float(np.diff(spans).sum()) / end if end else 0.0,
        service=float(np.diff(at_visits).sum()),
        waiting=max(waiting, 0.0),
        wait_share=max(waiting, 0.0) / end if end else 0.0,
        distance=course.distance,
        empty=max(empty, 0.0),
        energy_used=float(np.maximum(-np.diff(levels), 0.0).sum()),
        lowest_energy=min(levels),
    )


def _tardiness(stories: dict[str, OrderStory]) -> float | None:
    due = [story for story in stories.values() if story.due is not None]
    if not due:
        return None
    return sum(
        max(story.closed - story.due, 0.0)
        for story in due
        if story.state == "done" and story.closed is not None and story.due is not None
    )


def _late(stories: dict[str, OrderStory], end: float) -> int:
    return sum(
        (end if story.closed is None else story.closed) > story.due
        for story in stories.values()
        if story.due is not None and story.state not in ("failed", "cancelled")
    )


def _decisions(trace: Trace) -> DecisionFigures:
    told = trace.of("decision")
    cpu = [float(event.get("cpu_s") or 0.0) for event in told]
    return DecisionFigures(
        count=len(told),
        refused=sum(event.get("outcome") == "refused" for event in told),
        cpu_total=sum(cpu),
        cpu_median=float(np.median(cpu)) if cpu else 0.0,
        cpu_p99=float(np.percentile(cpu, 99)) if cpu else 0.0,
    )
