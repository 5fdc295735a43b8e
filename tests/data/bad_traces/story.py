"""Right traces told event by event, of carts on straight lines."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from clearway.model import (
    Battery,
    Footprint,
    Limits,
    Pose,
    Robot,
    RobotType,
    Site,
    Trace,
)

FLOOR = Site(bounds=((0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)))
CART = RobotType(
    "cart",
    Footprint.rectangle(1.0, 0.6),
    "differential",
    Limits(speed=1.0),
    loaded_footprint=Footprint.rectangle(1.0, 1.0),
    battery=Battery(capacity=1000.0),
)
SPILL = [[14.0, 4.0], [16.0, 4.0], [16.0, 6.0], [14.0, 6.0]]
Event = dict[str, Any]


@dataclass
class Story:
    """What carts do on straight lines, each on a clock of its own, told event by event."""

    robots: dict[str, Pose]
    site: Site = FLOOR
    kind: RobotType = CART
    events: list[Event] = field(default_factory=list)
    clock: dict[str, float] = field(default_factory=dict)
    at: dict[str, Pose] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.clock = dict.fromkeys(self.robots, 0.0)
        self.at = dict(self.robots)

    def tell(self, event: str, t: float, **content: Any) -> None:
        """Something happens at ``t`` (s)."""
        self.events.append({"event": event, "t": t, **content})

    def drive(self, robot: str, metres: float, speed: float = 1.0) -> None:
        """It goes along its heading, or back, in steps of 0.1 s."""
        begin, pose = self.clock[robot], self.at[robot]
        seconds = abs(metres) / speed
        share = np.linspace(0.0, 1.0, round(10 * seconds) + 1)
        motion = {
            "t": begin + seconds * share,
            "x": pose.x + metres * share * np.cos(pose.theta),
            "y": pose.y + metres * share * np.sin(pose.theta),
            "theta": np.full(len(share), pose.theta),
        }
        arrays = {name: np.round(array, 6) for name, array in motion.items()}
        self.events.append({"event": "motion", "robot": robot, **arrays})
        self.clock[robot] = begin + seconds
        self.at[robot] = Pose(*(float(arrays[name][-1]) for name in ("x", "y", "theta")))

    def stand(self, robot: str, seconds: float, *causes: str) -> None:
        """It stands, waiting for the causes if there are any."""
        begin = self.clock[robot]
        if causes:
            until = begin + seconds
            self.tell("wait", begin, robot=robot, **{"for": list(causes)}, until=until)
        self.clock[robot] += seconds

    def release(self, order: str, t: float, **content: Any) -> None:
        """An order arrives."""
        self.tell("order", t, order=order, state="released", visits=1, **content)

    def take(self, robot: str, order: str | None, purpose: str, first: bool = True) -> None:
        """The robot is committed to a trip of one visit."""
        t = self.clock[robot]
        self.tell(
            "decision",
            t,
            robot=robot,
            order=order,
            purpose=purpose,
            kind="robot",
            chosen=robot,
            score=1.0,
            alternatives=[{"name": "nobody", "score": 9.0}],
            outcome="committed",
            arrive=[t + 1.0],
            cpu_s=0.25,
        )
        if order is not None and first:
            for state in ("assigned", "started"):
                self.tell("order", t, order=order, state=state, robot=robot)

    def serve(self, robot: str, order: str | None, purpose: str, service: float) -> None:
        """The robot makes a visit where it is."""
        visit = {"robot": robot, "task": order, "order": order}
        pose = [*self.at[robot]]
        t = self.clock[robot]
        self.tell("visit", t, **visit, state="arrived", pose=pose, service=service, purpose=purpose)
        self.clock[robot] += service
        self.tell("visit", self.clock[robot], **visit, state="left")

    def finish(self, robot: str, order: str) -> None:
        """The order is done."""
        self.tell("order", self.clock[robot], order=order, state="done", robot=robot)

    def trace(self, **end: Any) -> Trace:
        """Everything in the order of its time, motions when they are driven."""
        ordered = sorted(self.events, key=lambda event: float(np.max(event["t"])))
        t = max(float(np.max(event["t"])) for event in ordered)
        return Trace(
            scenario="by hand",
            system="by hand",
            seed=7,
            site=self.site,
            robot_types={self.kind.name: self.kind},
            robots=tuple(Robot(name, self.kind.name, pose) for name, pose in self.robots.items()),
            events=(*ordered, {"event": "end", "t": t, **end}),
            is_whole=True,
            parameters={"rules": "by hand"},
            version="0.1.0",
        )


def day() -> Story:
    """Two carts, four orders, a stop, a spill.

    Cart ``a`` fetches a shelf, brings it and stores it again; ``b`` waits for it, is late with its
    own order, goes back and charges. One order fails, one stays open. Driven: a 5 + 5 + 10 m,
    b 6 + 6 m. Waited on trips: a 1 s (its stop), b 2 s (for a).
    """
    story = Story({"a": Pose(2.0, 2.0, 0.0), "b": Pose(2.0, 7.0, 0.0)})
    story.release("o1", 0.0, fetches="S1", priority=1.0)
    story.take("a", "o1", "fetch")
    story.drive("a", 5.0)
    story.serve("a", "o1", "fetch", 2.0)
    story.tell("load", 7.0, robot="a", objects=["S1"])
    story.take("a", "o1", "deliver", first=False)
    story.drive("a", 2.0)
    story.tell("fault", 9.0, kind="stop", robot="a", state="stopped")
    story.stand("a", 1.0, "stop")
    story.tell("fault", 10.0, kind="stop", robot="a", state="moving")
    story.drive("a", 3.0)
    story.serve("a", "o1", "deliver", 3.0)
    story.tell("energy", 16.0, robot="a", level=0.9)
    story.take("a", "o1", "store", first=False)
    story.drive("a", -10.0)
    story.serve("a", "o1", "store", 1.0)
    story.tell("load", 27.0, robot="a", objects=[])
    story.finish("a", "o1")

    story.stand("b", 1.0, "order")
    story.release("o2", 1.0, due=8.0)
    story.take("b", "o2", "order")
    story.drive("b", 2.0)
    story.stand("b", 2.0, "a")
    story.drive("b", 4.0)
    story.serve("b", "o2", "order", 2.0)
    story.finish("b", "o2")
    story.tell("energy", 11.0, robot="b", level=0.7)
    story.drive("b", -6.0)
    story.take("b", None, "charge")
    story.serve("b", None, "charge", 5.0)
    story.tell("energy", 22.0, robot="b", level=0.95)

    story.release("o3", 2.0)
    story.tell("order", 2.0, order="o3", state="failed", reason="the shelf is not there")
    story.release("o4", 20.0)
    story.tell("fault", 5.0, kind="obstacle", zone="spill", polygon=SPILL, state="closed")
    story.tell("fault", 25.0, kind="obstacle", zone="spill", polygon=SPILL, state="open")
    return story


def right(**changes: Any) -> Trace:
    """Return the day as a trace, with some of its last event's figures changed."""
    figures = {"makespan": 27.0, "orders_done": 2, "orders_open": 1}
    end = {"status": "ended", **figures, "distance": 32.0, "waiting": 3.0} | changes
    return day().trace(**end)


def with_events(trace: Trace, *events: Event) -> Trace:
    """Return a trace of other events."""
    return replace(trace, events=events)


def closing(**changes: Any) -> Event:
    """Return the figures at the end of `errand`, with some changed."""
    figures = {"makespan": 2.0, "orders_done": 1, "orders_open": 0, "distance": 1.0, "waiting": 0.0}
    return {"status": "done", **figures} | changes


def errand(**changes: Any) -> Trace:
    """One cart drives 1 m, serves for 1 s, and its order is done."""
    return errand_story().trace(**closing(**changes))


def errand_story() -> Story:
    """Return the events of `errand`."""
    story = Story({"a": Pose(2.0, 2.0, 0.0)})
    story.release("o1", 0.0)
    story.take("a", "o1", "order")
    story.drive("a", 1.0)
    story.serve("a", "o1", "order", 1.0)
    story.finish("a", "o1")
    return story


def changed(kind: str, number: int = 0, trace: Trace | None = None, **changes: Any) -> Trace:
    """Return a trace, `errand` if none is given, with one event of a kind changed."""
    trace = trace or errand()
    wanted = trace.of(kind)[number]
    return with_events(
        trace, *({**event, **changes} if event is wanted else event for event in trace.events)
    )
