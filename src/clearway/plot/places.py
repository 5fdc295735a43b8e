"""Which places for shelves are taken, and by which shelf, as far as a trace tells."""

from bisect import bisect_right
from typing import NamedTuple

from clearway.plot.chronicle import Chronicle


class Change(NamedTuple):
    """From ``time`` (s) on, ``shelf`` stands in the place; ``None``: it is vacant."""

    time: float
    shelf: str | None


def shelf_places(chronicle: Chronicle) -> dict[str, list[Change]]:
    """Return what stands in each zone of kind ``shelf``: at 0 s, and each change.

    A robot takes what it has more on board, and leaves what it has less, at the place of the
    visit that it makes or has just made. At first each place holds the shelf of its own name,
    unless something was put there before anything was taken. Where no robot ever takes or leaves
    a shelf, nothing is known, and there are no places.
    """
    names = {zone.name for zone in chronicle.trace.site.zones_of("shelf")}
    aboard: dict[str, set[str]] = {}
    changes: dict[str, list[Change]] = {}
    for event in chronicle.trace.of("load"):
        robot, time, now = event["robot"], float(event["t"]), set(event["objects"])
        before = aboard.get(robot, set())
        aboard[robot] = now
        visits = chronicle.diaries[robot].visits
        index = bisect_right(visits, time, key=lambda visit: visit.start) - 1
        place = visits[index].event.get("place") if index >= 0 else None
        if place in names and now != before:
            left = sorted(before - now)
            changes.setdefault(place, []).append(Change(time, left[0] if left else None))
    if not changes:
        return {}
    found: dict[str, list[Change]] = {}
    for name in sorted(names):
        later = changes.get(name, [])
        is_put_first = bool(later) and later[0].shelf is not None
        found[name] = [Change(0.0, None if is_put_first else name), *later]
    return found
