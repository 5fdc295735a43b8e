"""Which places for shelves are taken, and by which shelf, as far as a trace tells."""

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
    changes: dict[str, list[Change]] = {}
    for diary in chronicle.diaries.values():
        aboard: set[str] = set()
        for event in diary.loads:
            now = set(event["objects"])
            visits = [visit for visit in diary.visits if visit.start <= event["t"]]
            place = visits[-1].event.get("place") if visits else None
            if place in names:
                time = float(event["t"])
                left = sorted(aboard - now)
                if left or now - aboard:
                    changes.setdefault(place, []).append(Change(time, left[0] if left else None))
            aboard = now
    if not changes:
        return {}
    found: dict[str, list[Change]] = {}
    for name in names:
        later = sorted(changes.get(name, []), key=lambda change: change.time)
        is_put_first = bool(later) and later[0].shelf is not None
        found[name] = [Change(0.0, None if is_put_first else name), *later]
    return found
