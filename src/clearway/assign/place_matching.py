"""Which shelf on board goes to which vacant place, all at once."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

Floats = NDArray[np.float64]
FAR = 1e9  # forbids a place


def match_places(
    far: Floats,
    bring: Mapping[str, tuple[int, Sequence[int]]],
    places: Sequence[int],
    onward: Mapping[str, Floats],
    storing: str | None,
    vacant: int,
) -> dict[str, int]:
    """Return a place of its own for each robot with a shelf, the ways in sum as short as can be.

    Parameters
    ----------
    far
        Driving times between endpoints (s), ``(endpoints, endpoints)``.
    bring
        Where each robot is, and the stations one of which it goes to.
    places
        At least as many as robots; the first ``vacant`` of them are vacant now.
    onward
        Times from each place to the next shelf of each robot (s), ``(places,)``.
    storing
        Robot that chooses now: it needs a place that is vacant.
    """
    robots = list(bring)
    cost = np.empty((len(robots), len(places)))
    for k, robot in enumerate(robots):
        at, stations = bring[robot]
        way = far[at, stations][:, None] + far[np.ix_(stations, places)]
        cost[k] = way.min(axis=0) + onward[robot]
        if robot == storing:
            cost[k, vacant:] = FAR
    rows, columns = linear_sum_assignment(cost)
    return {robots[k]: places[int(c)] for k, c in zip(rows, columns, strict=True)}
