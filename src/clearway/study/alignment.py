"""How far apart robots are along one axis whenever they agree in the other coordinate."""

from itertools import combinations
from typing import NamedTuple

import numpy as np

from clearway.metrics.motion import Floats, track_of
from clearway.model import PlanRecord

# Coordinates this near to each other coincide (m).
SAME = 1e-6


class Alignment(NamedTuple):
    """A moment (s) at which two robots have the same x or y, and how far apart they are (m).

    ``along`` names the axis of the distance: ``x`` where their y coincide.
    """

    first: str
    second: str
    time: float
    along: str
    distance: float


def alignments(record: PlanRecord) -> list[Alignment]:
    """Return all moments at which reference points pass each other in x or in y, by time.

    Where two robots keep a coordinate in common for a while, the beginning and the end of it
    are told, and every sample in between.
    """
    tracks = {robot.id: track_of(record, robot) for robot in record.robots}
    found: list[Alignment] = []
    for first, second in combinations(tracks, 2):
        a, b = tracks[first], tracks[second]
        t = np.unique(np.concatenate([a.t, b.t]))
        dx = np.interp(t, a.t, a.x) - np.interp(t, b.t, b.x)
        dy = np.interp(t, a.t, a.y) - np.interp(t, b.t, b.y)
        for along, gap, across in (("x", dx, dy), ("y", dy, dx)):
            times, distances = _crossings(t, across, gap)
            found += [
                Alignment(first, second, float(time), along, abs(float(distance)))
                for time, distance in zip(times, distances, strict=True)
            ]
    return sorted(found, key=lambda each: (each.time, each.first, each.second, each.along))


def _crossings(t: Floats, across: Floats, gap: Floats) -> tuple[Floats, Floats]:
    """Return when ``across`` is 0, and ``gap`` then."""
    at = np.abs(across) <= SAME
    passed = (across[:-1] * across[1:] < 0.0) & ~at[:-1] & ~at[1:]
    share = across[:-1][passed] / (across[:-1] - across[1:])[passed]
    times = t[:-1][passed] + share * np.diff(t)[passed]
    gaps = gap[:-1][passed] + share * np.diff(gap)[passed]
    return np.concatenate([t[at], times]), np.concatenate([gap[at], gaps])
