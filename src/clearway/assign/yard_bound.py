"""Lower bound on the makespan of a batch of orders for shelves."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment
from scipy.sparse.csgraph import floyd_warshall

from clearway.assign.shelf_cycle import ShelfParams
from clearway.assign.shelf_yard import ShelfYard, require_shelves
from clearway.model import Scenario
from clearway.world.lane_times import LaneTimes

Floats = NDArray[np.float64]
FAR = 1e9  # forbids a pair in the assignment


def makespan_bound(
    scenario: Scenario, params: ShelfParams | None = None, times: LaneTimes | None = None
) -> float:
    """Return a time (s) before which no dispatching and no motion on the lanes ends all orders.

    The larger of two bounds.

    *Longest order.* Some robot drives from its start to the shelf, from there to a station
    and on to a place, not before the order is released; each at least in its least driving time.

    *Shared work.* What each robot does is a chain: from its start to a shelf; from each shelf, by a
    station and a place for it other than where the next shelf is, to the next shelf; from the
    last one by a station to a place. All chains together give every order one predecessor (an
    order or a start) and one successor (an order or an end). The cheapest such pairing, which may
    contain circles, costs at most as much as any chains, and the busiest of n robots works at least
    an n-th of it.

    Least driving times do not know other robots, so meetings only add. They are closed under going
    round by other endpoints, so parking and charging only add. A shelf is where it was at first
    when it is fetched for the first time; when it is ordered again it may be anywhere.

    Parameters
    ----------
    times
        Least driving times, with the time that turns take or less; made of the scenario's layout
        and first robot if not given.

    Raises
    ------
    ValueError
        If an order's shelf does not exist, or a robot starts at no endpoint.
    """
    params = params or ShelfParams()
    times = times or LaneTimes.of(scenario)
    yard = ShelfYard(scenario.site)
    require_shelves(yard, ((order.task.id, order.task.fetches) for order in scenario.orders))
    if not scenario.orders:
        return 0.0
    far = floyd_warshall(times.matrix())
    stations = _numbers(times, yard, "station")
    places = _numbers(times, yard, "shelf")
    starts = []
    for robot in scenario.robots:
        endpoint = yard.endpoint_at(robot.start)
        if endpoint is None:
            raise ValueError(f"robot {robot.id} starts at no endpoint; see the site's zones")
        starts.append(times.number[endpoint])
    ends = _ends(far, stations, places)
    follows = _follows(far, stations, places)
    from_start = far[np.ix_(starts, places)]
    column = {times.names[number]: k for k, number in enumerate(places)}

    # Where each order's shelf is: its own place, or any for all but the first order of a shelf.
    seen: set[str | None] = set()
    where: list[int | None] = []
    for order in scenario.orders:
        shelf = order.task.fetches or ""
        where.append(None if shelf in seen else column[shelf])
        seen.add(shelf)
    service = params.lift + params.residence + params.lower
    longest = max(
        max(order.release, _at(from_start, where[k]).min()) + _at(ends, where[k]) + service
        for k, order in enumerate(scenario.orders)
    )
    shared = _pairing(from_start, follows, ends, where) + service * len(where)
    return float(max(longest, shared / len(starts)))


def _numbers(times: LaneTimes, yard: ShelfYard, kind: str) -> list[int]:
    return [times.number[name] for name in yard.pose if yard.kind[name] == kind]


def _ends(far: Floats, stations: list[int], places: list[int]) -> Floats:
    """Return the least time from each place by a station to any place, ``(places,)``."""
    back = far[np.ix_(stations, places)].min(axis=1)
    return np.asarray((far[np.ix_(places, stations)] + back).min(axis=1))


def _follows(far: Floats, stations: list[int], places: list[int]) -> Floats:
    """Return the least time from a place by a station and a third place to another, squared.

    ``result[i, j]``: the shelf is stored anywhere but at j, where the next one is.
    """
    between = far[np.ix_(places, places)].copy()
    np.fill_diagonal(between, np.inf)
    back = far[np.ix_(stations, places)]
    onward = np.array([(row[:, None] + between).min(axis=0) for row in back])
    out = far[np.ix_(places, stations)]
    return np.array([(row[:, None] + onward).min(axis=0) for row in out])


def _at(values: Floats, place: int | None) -> Floats:
    """Return the last axis at one place, or its least where any will do."""
    return np.asarray(values.min(axis=-1) if place is None else values[..., place])


def _pairing(
    from_start: Floats, follows: Floats, ends: Floats, where: Iterable[int | None]
) -> float:
    """Return the least sum over starts and orders of the time to what comes next."""
    where = list(where)
    n, m = len(from_start), len(where)
    cost = np.zeros((n + m, m + n))
    # A shelf ordered again may be the one just stored: nothing is driven to it.
    for j, place in enumerate(where):
        cost[:n, j] = 0.0 if place is None else from_start[:, place]
    to_next = np.array([ends if place is None else follows[:, place] for place in where]).T
    for i, place in enumerate(where):
        cost[n + i, :m] = to_next.min(axis=0) if place is None else to_next[place]
        cost[n + i, i] = FAR
        cost[n + i, m:] = _at(ends, place)
    rows, columns = linear_sum_assignment(cost)
    return float(cost[rows, columns].sum())
