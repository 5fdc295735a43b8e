"""Who waits at a conflict on lanes, and where: the paper's rules.

References
----------
Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 5.3, eqs. (12)-(18).

Deviations
----------
A robot that would wait inside a crossing waits at its last node before it. At a T crossing where
not both come along longitudinal channels, of which the paper says nothing, the rule of
crossroads holds; a robot that comes out of its endpoint into a crossing waits there.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from clearway.plan.crossing_conflicts import Conflict, Route
from clearway.world.lane_grid import CROSSING, ENDPOINT, HORIZONTAL, T_CROSSING, LaneGrid

Waiter = Literal["one", "other", "shorter"]
LONGER = "it would have to wait longer"


@dataclass(frozen=True)
class Ruling:
    """Who waits: ``one``, the ``other``, or whoever needs to for a shorter time.

    ``because`` says why the one that does not wait goes first.
    """

    waiter: Waiter
    equation: int
    because: str


def waiting_nodes(grid: LaneGrid, route: Route, index: int) -> Iterator[int]:
    """Yield the nodes before ``index`` that lie in no crossing, the last one first."""
    for k in range(index - 1, -1, -1):
        if _region(grid, route, k) not in (CROSSING, T_CROSSING):
            yield k


def ruling(grid: LaneGrid, conflict: Conflict, one: Route, other: Route) -> Ruling:
    """Say who waits, by the regions of the conflict and of where both come from."""
    came = [_origin(grid, one, conflict.one), _origin(grid, other, conflict.other)]
    if came.count(ENDPOINT) == 1:
        waiter: Waiter = "one" if came[0] == ENDPOINT else "other"
        return Ruling(waiter, 18, "it is in the channel; the one at its endpoint waits")
    if conflict.place == "channel" or ENDPOINT in came:
        return Ruling("shorter", 17, LONGER)
    if came.count(HORIZONTAL) == 1 and None not in came:
        waiter = "one" if came[0] == HORIZONTAL else "other"
        return Ruling(
            waiter,
            13 if conflict.place == "crossroad" else 15,
            "it comes along the longitudinal channel; the horizontal one waits",
        )
    return Ruling(
        "shorter",
        14 if conflict.place == "crossroad" else 16,
        LONGER,
    )


def _origin(grid: LaneGrid, route: Route, index: int) -> int | None:
    """Return the region in which a robot is last before it comes into a crossing, or to a node."""
    node = next(waiting_nodes(grid, route, index), None)
    return None if node is None else _region(grid, route, node)


def _region(grid: LaneGrid, route: Route, index: int) -> int:
    x, y = route[index].cell
    return int(grid.region[y, x])
