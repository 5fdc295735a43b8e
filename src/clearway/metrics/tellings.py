"""What the events of a trace tell of orders, visits, loads, batteries and decisions."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from clearway.metrics.course import Span
from clearway.model import Trace


@dataclass
class OrderStory:
    """One order in time (s); ``closed`` when it was done, failed or called off."""

    state: str
    released: float
    due: float | None = None
    closed: float | None = None
    robot: str | None = None


def order_stories(trace: Trace) -> dict[str, OrderStory]:
    """Return all orders by id, in the order of their arrival."""
    stories: dict[str, OrderStory] = {}
    for event in trace.of("order"):
        t, state = float(event["t"]), event["state"]
        story = stories.setdefault(event["order"], OrderStory(state, t, event.get("due")))
        story.state = state
        story.robot = event.get("robot") or story.robot
        if state in ("done", "failed", "cancelled"):
            story.closed = t
    return stories


def visit_spans(trace: Trace, end: float) -> dict[str, list[Span]]:
    """Return when each robot is at visits; up to ``end`` (s) at one that it has not left."""
    spans: dict[str, list[Span]] = {robot.id: [] for robot in trace.robots}
    begun: dict[str, float] = {}
    for event in trace.of("visit"):
        if event["state"] == "arrived":
            begun[event["robot"]] = float(event["t"])
        elif event["robot"] in begun:
            spans[event["robot"]].append((begun.pop(event["robot"]), float(event["t"])))
    for robot, begin in begun.items():
        spans[robot].append((begin, end))
    return spans


def loaded_spans(trace: Trace, end: float) -> dict[str, list[Span]]:
    """Return when each robot has something on board."""
    spans: dict[str, list[Span]] = {robot.id: [] for robot in trace.robots}
    begun: dict[str, float] = {}
    for event in trace.of("load"):
        robot, t = event["robot"], float(event["t"])
        if event["objects"]:
            begun.setdefault(robot, t)
        elif robot in begun:
            spans[robot].append((begun.pop(robot), t))
    for robot, begin in begun.items():
        spans[robot].append((begin, end))
    return spans


def energy_levels(trace: Trace) -> dict[str, list[float]]:
    """Return each robot's levels in [0, 1], that of its start first."""
    levels = {robot.id: [robot.energy] for robot in trace.robots}
    for event in trace.of("energy"):
        levels[event["robot"]].append(float(event["level"]))
    return levels


def real_waits(trace: Trace) -> tuple[Mapping[str, Any], ...]:
    """Return the waits of robots that have something to do."""
    return tuple(event for event in trace.of("wait") if list(event["for"]) != ["order"])


def end_of(trace: Trace) -> float:
    """Return the last second that the trace tells of."""
    times = (event["t"][-1] if event["event"] == "motion" else event["t"] for event in trace.events)
    return max((float(t) for t in times), default=0.0)
