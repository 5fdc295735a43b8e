"""How a run goes over time: orders done an hour, who waits, orders open, energy."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clearway.plot.chronicle import Chronicle

Floats = NDArray[np.float64]

_POINTS = 160
# Orders done are counted over this share of the run, and over this long (s) at least.
_WINDOW = 0.08
_LEAST_WINDOW = 120.0
_STANDING = ("wait", "refused", "stop", "stand")


def curves(chronicle: Chronicle) -> dict[str, Any]:
    """Return the curves of a run as lists of one length: ``t`` (s) and a value for each.

    ``throughput`` is orders done an hour in the window that ends at ``t``; ``waiting`` and
    ``working`` are shares of the fleet in the stretch that ends there, all that stands on a trip
    counted as waiting; ``open`` is the number of orders; ``energy`` and ``least_energy`` are
    levels, there only where the trace tells any.
    """
    edges = np.linspace(0.0, max(chronicle.duration, 1e-3), _POINTS + 1)
    found: dict[str, Any] = {"t": _rounded(edges[1:], 3)}
    done = _times(chronicle, ("done",))
    window = max(_WINDOW * chronicle.duration, _LEAST_WINDOW)
    began = np.maximum(edges[1:] - window, 0.0)
    count = np.searchsorted(done, edges[1:], "right") - np.searchsorted(done, began, "right")
    found["throughput"] = _rounded(3600.0 * count / (edges[1:] - began), 2)
    found["waiting"] = _rounded(_share(chronicle, _STANDING, edges), 4)
    found["working"] = _rounded(_share(chronicle, ("drive", "turn", "service"), edges), 4)
    ended = _times(chronicle, ("done", "failed", "cancelled"))
    came = _times(chronicle, ("released",))
    still = np.searchsorted(came, edges[1:], "right") - np.searchsorted(ended, edges[1:], "right")
    found["open"] = still.tolist()
    levels = _levels(chronicle, edges[1:])
    if levels is not None:
        found["energy"] = _rounded(levels.mean(axis=0), 4)
        found["least_energy"] = _rounded(levels.min(axis=0), 4)
    return found


def _rounded(values: Floats, decimals: int) -> list[float]:
    whole: list[float] = np.round(values, decimals).tolist()
    return whole


def _times(chronicle: Chronicle, states: Iterable[str]) -> Floats:
    """Return when orders came into one of the states, sorted."""
    wanted = set(states)
    times = [e["t"] for told in chronicle.orders.values() for e in told if e["state"] in wanted]
    return np.sort(np.array(times, dtype=np.float64))


def _share(chronicle: Chronicle, kinds: Sequence[str], edges: Floats) -> Floats:
    """Return the share of the fleet's time spent on these kinds in each stretch."""
    spans = np.array(
        [
            (doing.start, doing.end)
            for diary in chronicle.diaries.values()
            for doing in diary.doings
            if doing.kind in kinds
        ]
    ).reshape(-1, 2)
    spent = _passed(spans[:, 0], edges) - _passed(spans[:, 1], edges)
    return np.diff(spent) / (np.diff(edges) * max(1, len(chronicle.diaries)))


def _passed(moments: Floats, at: Floats) -> Floats:
    """Return the seconds that have passed since all earlier moments, added up."""
    ordered = np.sort(moments)
    before = np.searchsorted(ordered, at, "right")
    sums = np.concatenate([[0.0], np.cumsum(ordered)])
    return np.asarray(before * at - sums[before])


def _levels(chronicle: Chronicle, at: Floats) -> Floats | None:
    """Return levels of energy, shape ``(num_robots, num_times)``; ``None`` where none are told."""
    rows = []
    for diary in chronicle.diaries.values():
        if not diary.energy:
            continue
        times = np.array([0.0, *(event["t"] for event in diary.energy)])
        levels = np.array([diary.robot.energy, *(event["level"] for event in diary.energy)])
        rows.append(np.interp(at, times, levels))
    return np.array(rows) if rows else None
