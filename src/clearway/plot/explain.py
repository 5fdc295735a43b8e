"""Why a robot does what it does at a moment: the chain of causes, from the trace alone."""

import difflib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from clearway.plot.chronicle import Chronicle
from clearway.plot.doings import Doing, Event
from clearway.plot.told import of_doing, of_hold, of_rest, of_trip

# In one or two words, for what is a root as well.
STATES = {
    "drive": "moving",
    "turn": "moving",
    "service": "at work",
    "charge": "charging",
    "stop": "stopped by itself",
    "wait": "waiting",
    "refused": "no plan",
    "idle": "nothing to do",
    "stand": "not told",
}


@dataclass(frozen=True)
class Link:
    """One robot in the chain.

    Parameters
    ----------
    depth
        Number of robots between it and the one asked for.
    state, since
        What it does and since when (s); one of ``STATES``.
    sentences
        What it does, then its trip: all of it for the robot asked for, in one line for others.
    causes
        For whom or what it stands: robot ids or causes such as ``station:p3``.
    ends
        Why the chain ends here: ``root``; ``cycle`` where a cause leads back to a robot on the
        way here; ``told`` where all causes are told elsewhere in the chain; empty where it goes on.
    decisions
        Events: the first decision for its order, and the one for its present trip.
    """

    robot: str
    depth: int
    state: str
    since: float
    sentences: tuple[str, ...]
    causes: tuple[str, ...] = ()
    ends: str = ""
    order: str | None = None
    purpose: str | None = None
    carries: tuple[str, ...] = ()
    energy: float | None = None
    decisions: tuple[Event, ...] = ()


def explain(chronicle: Chronicle, robot: str, time: float) -> list[Link]:
    """Return the chain of causes: the robot asked for, then whom it waits for, to the roots.

    Each robot is told once. Cycles are cut where they close.

    Raises
    ------
    ValueError
        If the robot is not in the trace, or the time not in the run.
    """
    if robot not in chronicle.diaries:
        near = difflib.get_close_matches(robot, chronicle.diaries, n=1, cutoff=0.0)
        mend = f"; did you mean {near[0]}?" if near else "; the trace has no robots"
        raise ValueError(f"robot: there is no {robot!r} in this run{mend}")
    if not 0.0 <= time <= chronicle.duration:
        raise ValueError(
            f"at: {time:g} s is outside the run; give a time from 0 to {chronicle.duration:.1f} s"
        )
    found: list[Link] = []
    _follow(chronicle, robot, time, (), (), found)
    return found


def _follow(
    chronicle: Chronicle,
    robot: str,
    time: float,
    above: tuple[str, ...],
    held: tuple[str, ...],
    found: list[Link],
) -> None:
    """Add a robot's link and all that it leads to, in the order in which causes are named."""
    diary = chronicle.diaries[robot]
    doing = diary.doing(time)
    causes = causes_of(doing)
    leads = list(_leads(chronicle, robot, causes, time))
    place = len(found)
    found.append(_link(chronicle, robot, time, len(above), held, doing, causes))
    way = (*above, robot)
    ends = "" if leads else "root"
    for other, told in leads:
        if other in way:
            ends = "cycle"
        elif any(link.robot == other for link in found):
            ends = ends or "told"
        else:
            _follow(chronicle, other, time, way, told, found)
    goes_on = len(found) > place + 1 and ends == "told"
    found[place] = replace(found[place], ends="" if goes_on else ends)


def causes_of(doing: Doing) -> tuple[str, ...]:
    """Return for whom or what a robot stands."""
    if doing.kind == "wait":
        return tuple(doing.event["for"])
    return tuple(doing.event.get("causes") or ()) if doing.kind == "refused" else ()


def _leads(
    chronicle: Chronicle, robot: str, causes: tuple[str, ...], time: float
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the robots behind causes, with what is to be told of how they are."""
    for cause in causes:
        if cause in chronicle.diaries:
            yield cause, ()
            continue
        _, _, place = cause.partition(":")
        hold = chronicle.holder(place, time, robot)
        if hold:
            yield hold.robot, (of_hold(place, hold, time),)


def _link(
    chronicle: Chronicle,
    robot: str,
    time: float,
    depth: int,
    held: tuple[str, ...],
    doing: Doing,
    causes: tuple[str, ...],
) -> Link:
    diary = chronicle.diaries[robot]
    trip = diary.trip(time)
    order = trip.event.get("order") if trip else None
    decisions = chronicle.decisions.get(order, []) if order else []
    lines = of_rest(diary.last_trip(time))
    chosen: tuple[Event, ...] = ()
    if trip:
        lines = of_trip(trip, chronicle.orders.get(order, []) if order else [], decisions)
        first = decisions[:1] if decisions and decisions[0] is not trip.event else []
        chosen = (*first, trip.event)
    loads = [event for event in diary.loads if event["t"] <= time]
    levels = [event for event in diary.energy if event["t"] <= time]
    return Link(
        robot=robot,
        depth=depth,
        state=STATES[doing.kind],
        since=doing.start,
        sentences=(*held, of_doing(doing), *(lines[:1] if depth else lines)),
        causes=causes,
        order=order,
        purpose=trip.event.get("purpose") if trip else None,
        carries=tuple(loads[-1]["objects"]) if loads else (),
        energy=float(levels[-1]["level"]) if levels else None,
        decisions=chosen,
    )


def as_text(chain: list[Link], time: float) -> str:
    """Return the chain for people, each robot indented below the one that stands for it."""
    lines = []
    for link in chain:
        indent = "  " * link.depth
        at = f" at {time:.1f} s" if not link.depth else ""
        lines.append(f"{indent}{link.robot}{at}: {link.state}")
        lines += [f"{indent}  {sentence}" for sentence in link.sentences]
        if link.ends == "cycle":
            lines.append(f"{indent}  This closes a circle: they wait for each other.")
    return "\n".join(lines)


def as_json(chain: list[Link], time: float) -> dict[str, Any]:
    """Return the chain as an object."""
    return {
        "robot": chain[0].robot,
        "at": time,
        "roots": [link.robot for link in chain if link.ends == "root"],
        "chain": [
            {
                "robot": link.robot,
                "depth": link.depth,
                "state": link.state,
                "since": link.since,
                "for": list(link.causes),
                "ends": link.ends,
                "order": link.order,
                "purpose": link.purpose,
                "carries": list(link.carries),
                "energy": link.energy,
                "sentences": list(link.sentences),
                "decisions": [dict(decision) for decision in link.decisions],
            }
            for link in chain
        ],
    }
