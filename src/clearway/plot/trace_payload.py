"""What the page of a run is told: tracks, doings with their sentences, orders, places, curves."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from clearway.plot.chronicle import Chronicle, Diary
from clearway.plot.curves import curves
from clearway.plot.doings import Doing, Event
from clearway.plot.explain import STATES, causes_of
from clearway.plot.palette import robot_colour
from clearway.plot.payload import flat, modes_of, shape_of, site_of
from clearway.plot.places import shelf_places
from clearway.plot.thin import thin
from clearway.plot.told import of_doing, of_hold, of_rest, of_trip


def trace_payload(chronicle: Chronicle, figures: Sequence[Sequence[str]]) -> dict[str, Any]:
    """Return the page's data; times in ms, lengths in m and angles in rad.

    Parameters
    ----------
    figures
        Key figures: name, value and a note.
    """
    trace = chronicle.trace
    numbers = {robot.id: index for index, robot in enumerate(trace.robots)}
    return {
        "is_run": True,
        "duration": chronicle.duration,
        "site": site_of(trace.site),
        "types": {
            name: {"body": shape_of(kind.footprint), "loaded": shape_of(kind.shape(loaded=True))}
            for name, kind in trace.robot_types.items()
        },
        "robots": [
            {**_robot(chronicle, diary), "colour": robot_colour(numbers[diary.robot.id])}
            for diary in chronicle.diaries.values()
        ],
        "states": STATES,
        "orders": [_order(name, told, numbers) for name, told in chronicle.orders.items()],
        "holds": _holds(chronicle, numbers),
        "places": {
            name: [[_ms(change.time), change.shelf] for change in changes]
            for name, changes in shelf_places(chronicle).items()
        },
        "obstacles": [
            {
                "name": span.event["zone"],
                "polygon": span.event["polygon"],
                "from": _ms(span.start),
                "to": _ms(span.end),
            }
            for span in chronicle.obstacles
        ],
        "curves": curves(chronicle),
        "figures": [list(figure) for figure in figures],
        "run": {
            "scenario": trace.scenario,
            "system": trace.system,
            "seed": str(trace.seed),
            "clearway": trace.version,
            **flat(trace.parameters),
        },
    }


def _ms(seconds: float) -> int:
    return round(1000.0 * seconds)


def _robot(chronicle: Chronicle, diary: Diary) -> dict[str, Any]:
    return {
        "id": diary.robot.id,
        "type": diary.robot.type,
        "start": list(diary.robot.start),
        "track": asdict(thin(diary.track)),
        "modes": modes_of(diary.track),
        "carrying": _carrying(diary, chronicle.duration),
        "visits": [
            {
                "task": visit.event.get("task"),
                "place": visit.event.get("place"),
                "pose": list(visit.event["pose"]),
                "service": visit.event["service"],
                "arrive": _ms(visit.start),
                "leave": _ms(visit.end),
            }
            for visit in diary.visits
        ],
        "activities": [_activity(doing) for doing in diary.doings],
        "trips": _trips(chronicle, diary),
        "energy": [
            [_ms(event["t"]) for event in diary.energy],
            [round(event["level"], 4) for event in diary.energy],
        ],
    }


def _carrying(diary: Diary, duration: float) -> list[list[Any]]:
    """Return spans ``[from, to, names]`` with something on board."""
    ends = [*(_ms(event["t"]) for event in diary.loads[1:]), _ms(duration) + 1]
    return [
        [_ms(event["t"]), end, ", ".join(event["objects"])]
        for event, end in zip(diary.loads, ends[: len(diary.loads)], strict=True)
        if event["objects"]
    ]


def _activity(doing: Doing) -> list[Any]:
    """Return kind, begin, end, where or for whom, the sentence, and whom it stands for."""
    causes = causes_of(doing)
    label = ", ".join(causes) if causes else doing.event.get("place") or ""
    return [doing.kind, _ms(doing.start), _ms(doing.end), label, of_doing(doing), list(causes)]


def _trips(chronicle: Chronicle, diary: Diary) -> list[list[Any]]:
    """Return begin, end, purpose, order and sentences; between trips without a purpose."""
    rows: list[list[Any]] = []
    ends = [*(trip.start for trip in diary.trips[1:]), chronicle.duration]
    for trip, then in zip(diary.trips, ends[: len(diary.trips)], strict=True):
        purpose, order = trip.event.get("purpose"), trip.event.get("order")
        told = chronicle.orders.get(order, []) if order else []
        decisions = chronicle.decisions.get(order, []) if order else []
        sentences = of_trip(trip, told, decisions)
        rows.append([_ms(trip.start), _ms(trip.end), purpose, order, sentences])
        if trip.end < then:
            rows.append([_ms(trip.end), _ms(then) + 1, None, None, of_rest(trip)])
    return rows


def _order(name: str, told: Sequence[Event], numbers: Mapping[str, int]) -> dict[str, Any]:
    at = {event["state"]: _ms(event["t"]) for event in told}
    robot = next((event["robot"] for event in reversed(told) if event.get("robot")), None)
    released = next((event for event in told if event["state"] == "released"), {})
    due = released.get("due")
    return {
        "id": name,
        "state": told[-1]["state"],
        "robot": numbers.get(robot or ""),
        "released": at.get("released"),
        "assigned": at.get("assigned"),
        "started": at.get("started"),
        "ended": at.get(told[-1]["state"]) if told[-1]["state"] in _ENDS else None,
        "due": None if due is None else _ms(due),
        "fetches": released.get("fetches"),
        "reason": told[-1].get("reason"),
    }


_ENDS = ("done", "failed", "cancelled")


def _holds(chronicle: Chronicle, numbers: Mapping[str, int]) -> dict[str, list[list[Any]]]:
    """Return who has the places that somebody waits for, and how that is told."""
    wanted = {
        cause.partition(":")[2]
        for diary in chronicle.diaries.values()
        for doing in diary.doings
        for cause in causes_of(doing)
    }
    return {
        place: [
            [
                *(_ms(time) for time in (hold.promised, hold.come, hold.left)),
                numbers[hold.robot],
                *(of_hold(place, hold, time) for time in (hold.promised, hold.come)),
            ]
            for hold in holds
        ]
        for place, holds in chronicle.holds.items()
        if place in wanted
    }
