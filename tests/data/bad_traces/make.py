"""Writes the wrong traces beside this file.

Each wrong trace is a right one with one thing wrong; its file is named after the kind of
violation, with a variant after two dashes. Run ``python -m tests.data.bad_traces.make``.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

from tests.data.bad_traces.story import (
    CART,
    FLOOR,
    SPILL,
    Event,
    Story,
    changed,
    closing,
    errand,
    errand_story,
    right,
    with_events,
)

from clearway.formats.trace_file import dump_trace
from clearway.model import Limits, Obstacle, Pose, Robot, Site, Trace


def told(event: str, t: float, **content: Any) -> Trace:
    """Return `errand` with something more happening at ``t``."""
    story = errand_story()
    story.tell(event, t, **content)
    return story.trace(**closing())


def drives(*metres: float, speed: float = 1.0, site: Site = FLOOR, **ways: Pose) -> Story:
    """Return a story in which each cart drives a way from its start (``a`` 5, 5 if not given)."""
    story = Story(ways or {"a": Pose(5.0, 5.0, 0.0)}, site)
    for robot, way in zip(story.robots, metres, strict=True):
        if way:
            story.drive(robot, way, speed)
    return story


def spilt(begin: float, end: float | None = None, **changes: Any) -> Story:
    """Return a cart's way through what is a closed zone from ``begin`` to ``end`` (s)."""
    story = drives(3.0, a=Pose(13.0, 5.0, 0.0))
    spill = {"kind": "obstacle", "zone": "spill", "polygon": SPILL, "state": "closed"}
    story.tell("fault", begin, **spill)
    if end is not None:
        story.tell("fault", end, **spill | {"state": "open"} | changes)
    return story


def side_by_side(load: float, unload: float | None = None) -> Story:
    """Return two carts 0.75 m apart, of which one is wider than that from ``load`` (s) on.

    Empty bodies are 0.15 m apart; with a load, half a metre wide to each side, they overlap by
    0.05 m. They pass each other from second 1 to 3.
    """
    story = drives(0.0, 4.0, a=Pose(5.0, 5.0, 0.0), b=Pose(3.0, 5.75, 0.0))
    story.tell("load", load, robot="a", objects=["S1"])
    if unload is not None:
        story.tell("load", unload, robot="a", objects=[])
    return story


def without(trace: Trace, *wanted: Event) -> Trace:
    """Return a trace in which some events do not happen."""
    out = {id(event) for event in wanted}
    return with_events(trace, *(event for event in trace.events if id(event) not in out))


def done_at_a_visit() -> Trace:
    """Return an order of one visit, done after it has been visited but during another visit."""
    story = Story({"a": Pose(2.0, 2.0, 0.0)})
    story.release("o1", 0.0)
    story.take("a", "o1", "order")
    story.serve("a", "o1", "order", 1.0)
    story.tell("order", 1.5, order="o1", state="done", robot="a")
    story.serve("a", "o1", "order", 1.0)
    return story.trace(status="done")


def wrong_traces() -> dict[str, Trace]:
    """Return all wrong traces by the name of their file."""
    kinked = drives(1.0)
    kinked.kind = replace(CART, limits=Limits(speed=1.0, yaw_rate=1.0))
    kinked.at["a"] = Pose(6.0, 5.0, 0.01)
    kinked.drive("a", 1.0)
    skipping = drives(1.0)
    skipping.at["a"] = Pose(6.02, 5.0, 0.0)
    skipping.stand("a", 1.0)
    skipping.drive("a", 1.0)
    hasty = drives(1.0)
    hasty.clock["a"] = 0.5
    hasty.drive("a", 1.0)
    leaving = Story({"a": Pose(2.0, 2.0, 0.0)})
    leaving.serve("a", None, "park", 2.0)
    leaving.clock["a"] = 1.5
    leaving.drive("a", 1.0)
    back_in_time = Story({"a": Pose(2.0, 2.0, 0.0)})
    back_in_time.serve("a", None, "park", 2.0)
    back_in_time.clock["a"] = 0.5
    back_in_time.drive("a", 0.5)
    back_in_time.drive("a", -0.5)
    gone = Story({"a": Pose(2.0, 2.0, 0.0)})
    gone.serve("a", None, "park", 1.0)
    gone.events.pop()
    gone.drive("a", 0.5)
    untaken = Story({"a": Pose(2.0, 2.0, 0.0)})
    untaken.release("o1", 0.0)
    untaken.serve("a", "o1", "order", 1.0)
    staying = errand_story()
    staying.serve("a", None, "park", 1.0)
    staying.events.pop()
    stolen = Story({"a": Pose(2.0, 2.0, 0.0), "b": Pose(2.0, 5.0, 0.0)})
    stolen.release("o1", 0.0)
    stolen.take("a", "o1", "order")
    stolen.serve("b", "o1", "order", 1.0)
    shared = Story({"a": Pose(2.0, 2.0, 0.0), "b": Pose(2.0, 5.0, 0.0)})
    shared.tell("load", 0.0, robot="a", objects=["S1"])
    shared.tell("load", 1.0, robot="b", objects=["S1"])
    block = replace(FLOOR, obstacles=(Obstacle(polygon=((6.0, 4.0), (7.0, 4.0), (7.0, 6.0))),))
    stranger = Robot("b", "cart", Pose(2.0, 8.0, 0.0))
    done_by_another = changed("order", 3, robot="b")
    done_by_another = replace(done_by_another, robots=(*errand().robots, stranger))
    unassigned, early = errand(), errand(waiting=1.0)
    return {
        "clock": changed("order", 3, t=1.5),
        "clock--pieces": hasty.trace(status="ended"),
        "gap": skipping.trace(status="ended"),
        "gap--heading": kinked.trace(status="ended"),
        "start": replace(errand(), robots=(Robot("a", "cart", Pose(2.0, 2.01, 0.0)),)),
        "speed": drives(1.0, speed=1.25).trace(status="ended"),
        "obstacle": drives(3.0, site=block).trace(status="ended"),
        "bounds": drives(5.0, a=Pose(15.0, 5.0, 0.0)).trace(status="ended"),
        "conflict": drives(3.0, -3.0, a=Pose(3.0, 5.0, 0.0), b=Pose(8.0, 5.0, 0.0)).trace(
            status="ended"
        ),
        "conflict--loaded": side_by_side(0.0).trace(status="ended"),
        "conflict--loaded-halfway": side_by_side(2.9, 3.5).trace(status="ended"),
        "zone": spilt(0.0).trace(status="ended"),
        "zone--closed-twice": spilt(0.0, 0.2, state="closed").trace(status="ended"),
        "visit": changed("visit", pose=[3.02, 2.0, 0.0]),
        "visit--heading": changed("visit", pose=[3.0, 2.0, 0.02]),
        "visit--leaves-early": leaving.trace(status="ended"),
        "visit--goes-and-returns": back_in_time.trace(status="ended"),
        "visit--not-left-but-gone": gone.trace(status="ended"),
        "visit--never-left": staying.trace(**closing()),
        "visit--never-arrived": told("visit", 2.0, robot="a", task=None, state="left"),
        "service": changed("visit", service=1.5),
        "order": without(unassigned, unassigned.of("order")[1]),
        "order--done-early": without(early, *early.of("visit")),
        "order--more-visits": changed("order", visits=2),
        "order--of-another": stolen.trace(status="ended"),
        "order--untaken": untaken.trace(status="ended"),
        "order--done-by-another": done_by_another,
        "order--done-at-a-visit": done_at_a_visit(),
        "order--released-twice": told("order", 3.0, order="o1", state="released"),
        "load": shared.trace(status="ended"),
        "load--too-many": told("load", 0.0, robot="a", objects=["S1", "S2"]),
        "energy": told("energy", 1.0, robot="a", level=-0.1),
        "wait": told("wait", 1.0, robot="a", **{"for": []}),
        "end": errand(distance=1.1),
        "end--makespan": errand(makespan=1.0),
        "end--orders": errand(orders_done=2),
        "end--waiting": right(waiting=2.0),
        "end--goes-on": with_events(
            errand(), *errand().events, {"event": "energy", "t": 3.0, "robot": "a", "level": 1.0}
        ),
        "end--twice": with_events(errand(), *errand().events, errand().events[-1]),
        "end--not-done": right(status="done"),
    }


def right_traces() -> dict[str, Trace]:
    """Return right traces that are nearly wrong."""
    return {
        "a day": right(),
        "an errand": errand(),
        "leaving a closed zone": spilt(1.0).trace(status="ended"),
        "a zone opened before": spilt(0.0, 0.4).trace(status="ended"),
        "a zone closed behind": spilt(3.0).trace(status="ended"),
        "loaded after passing": side_by_side(3.01).trace(status="ended"),
        "unloaded before passing": side_by_side(0.0, 0.99).trace(status="ended"),
        "nearly off the pose": changed("visit", pose=[3.009, 2.0, 0.017]),
        "cut short": with_events(replace(right(), is_whole=False), *right().events[:30]),
        "nothing": with_events(errand()),
    }


def main() -> None:
    """Write all wrong traces."""
    for name, trace in wrong_traces().items():
        (Path(__file__).parent / f"{name}.jsonl").write_text(dump_trace(trace), encoding="utf-8")


if __name__ == "__main__":
    main()
