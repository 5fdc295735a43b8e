"""When each robot was on which trip, as the events of a trace tell."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from clearway.model.trace import Trace

CLOSED = ("done", "failed", "cancelled")


@dataclass(frozen=True)
class TripSpan:
    """A robot is on a trip from second ``begin`` to ``end``.

    Parameters
    ----------
    purpose
        As in `Trip`: ``order``, ``fetch``, ``deliver``, ``store``, ``charge``, ``park``.
    order
        Id of the order it serves, if any.
    is_complete
        Whether all its visits were made before ``end``.
    """

    robot: str
    purpose: str
    order: str | None
    begin: float
    end: float
    is_complete: bool


def trip_spans(trace: Trace) -> tuple[TripSpan, ...]:
    """Return all trips by robot and time.

    A trip begins with the decision that commits a robot to it, unless that expects no visits
    (``arrive`` is empty). It ends when the robot has left
    as many visits as the decision expects (``arrive``; one where it does not say), when its
    order has failed or is called off, with the robot's next trip, or with the trace.
    """
    running: dict[str, tuple[Mapping[str, Any], int]] = {}
    at_visit: set[str] = set()
    given_up: set[str] = set()  # at visits of trips that they are no longer on
    found: dict[str, list[TripSpan]] = {robot.id: [] for robot in trace.robots}

    def close(robot: str, end: float, is_complete: bool) -> None:
        decision, _ = running.pop(robot)
        purpose, order = decision.get("purpose") or "order", decision.get("order")
        begin = float(decision["t"])
        found[robot].append(TripSpan(robot, purpose, order, begin, end, is_complete))

    last = 0.0
    for event in trace.events:
        kind, robot = event["event"], event.get("robot")
        if kind == "motion":
            last = max(last, float(event["t"][-1]))
            continue
        t = float(event["t"])
        last = max(last, t)
        if kind == "decision" and robot and event.get("outcome", "committed") == "committed":
            if robot in running:
                close(robot, t, False)
            given_up |= at_visit & {robot}
            arrive = event.get("arrive")
            if arrive != []:  # else it has nothing to visit any more
                running[robot] = event, len(arrive or (None,))
        elif kind == "visit" and event["state"] == "arrived" and robot:
            at_visit.add(robot)
        elif kind == "visit" and robot in given_up:
            given_up.discard(robot)
            at_visit.discard(robot)
        elif kind == "visit" and robot:
            at_visit.discard(robot)
            if robot not in running:
                continue
            decision, missing = running[robot]
            running[robot] = decision, missing - 1
            if missing == 1:
                close(robot, t, True)
        elif kind == "order" and event["state"] in CLOSED:
            for name in [n for n, (d, _) in running.items() if d.get("order") == event["order"]]:
                close(name, t, event["state"] == "done")
    for robot in [*running]:
        close(robot, last, False)
    return tuple(span for spans in found.values() for span in spans)
