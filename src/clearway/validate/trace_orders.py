"""Whether orders go their way, and what is told of loads, batteries and waits can be."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from clearway.model import Trace
from clearway.validate.violation import Violation

NEXT = {
    None: ("released",),
    "released": ("assigned", "failed", "cancelled"),
    "assigned": ("started", "released", "failed", "cancelled"),
    "started": ("done", "released", "failed", "cancelled"),
}
STATES = ("released", "assigned", "started", "failed", "cancelled", "done")
NOWHERE = (0.0, 0.0)


@dataclass
class _Course:
    """How far an order has come."""

    state: str | None = None
    robot: str | None = None
    visits: int = 1
    made: int = 0
    at: str | None = None


def judge_orders(trace: Trace) -> list[Violation]:
    """Return states out of turn, visits by others, and orders done before their visits."""
    courses: dict[str, _Course] = {}
    found: list[Violation] = []

    def wrong(event: Mapping[str, Any], text: str) -> None:
        robot = event.get("robot")
        who = (robot,) if robot else ()
        told = f"order {event['order']} {text}"
        found.append(Violation("order", who, float(event["t"]), NOWHERE, None, told))

    for event in trace.events:
        if event["event"] == "order":
            course = courses.setdefault(event["order"], _Course())
            for text in _step(course, event):
                wrong(event, text)
        elif event["event"] == "visit" and event.get("order") is not None:
            course = courses.setdefault(event["order"], _Course())
            for text in _visit(course, event):
                wrong(event, text)
    return found


def _step(course: _Course, event: Mapping[str, Any]) -> list[str]:
    state, robot, texts = event["state"], event.get("robot"), []
    before = course.state
    if state not in NEXT.get(before, ()):
        texts.append(f"is {state} when it {_was(before)}")
    elif state == "done":
        if course.at is not None:
            texts.append(f"is done while {course.at} is at a visit of it")
        elif course.made < course.visits:
            texts.append(f"is done after {course.made} of {course.visits} visits")
    if state == "released" and event.get("visits") is not None:
        course.visits = event["visits"]
    if state == "assigned":
        course.robot = robot
    elif robot is not None and course.robot not in (None, robot):
        texts.append(f"is {state} by {robot}, though {course.robot} has it")
    # What is out of turn is told once: an order goes back only where its robot gives it back.
    if state == "released" and before in ("assigned", "started"):
        course.state, course.robot, course.made = state, None, 0
    elif before is None or STATES.index(state) > STATES.index(before):
        course.state = state
    return texts


def _visit(course: _Course, event: Mapping[str, Any]) -> list[str]:
    robot = event["robot"]
    if event["state"] == "left":
        course.made += 1
        course.at = None
        return []
    course.at = robot
    if course.state not in ("assigned", "started"):
        return [f"is visited by {robot} when it {_was(course.state)}"]
    if course.robot not in (None, robot):
        return [f"is visited by {robot}, though {course.robot} has it"]
    return []


def _was(state: str | None) -> str:
    return "is unknown yet" if state is None else f"was {state}"


def judge_tellings(trace: Trace) -> list[Violation]:
    """Return levels outside [0, 1], impossible loads, and waits for nobody and nothing."""
    capacity = {robot.id: trace.robot_types[robot.type].capacity for robot in trace.robots}
    carrier: dict[str, str] = {}
    found: list[Violation] = []

    def wrong(kind: str, event: Mapping[str, Any], text: str) -> None:
        t = float(event["t"])
        found.append(Violation(kind, (event["robot"],), t, NOWHERE, None, text))

    for event in trace.events:
        if event["event"] == "energy" and not 0.0 <= event["level"] <= 1.0:
            wrong("energy", event, f"a level of {event['level']:.6f}, not in [0, 1]")
        elif event["event"] == "wait" and not event["for"]:
            wrong("wait", event, "it waits for nobody and nothing")
        elif event["event"] == "load":
            robot, objects = event["robot"], event["objects"]
            if len(objects) > capacity[robot]:
                wrong("load", event, f"{len(objects)} objects on board, room for {capacity[robot]}")
            carrier = {name: who for name, who in carrier.items() if who != robot}
            for name in objects:
                if name in carrier:
                    wrong("load", event, f"{name} is on board of {carrier[name]} as well")
                carrier[name] = robot
    return found
