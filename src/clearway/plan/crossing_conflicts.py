"""Conflicts of two timed routes on lanes: the paper's conditions, and the cases of its figures.

References
----------
Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 5.1-5.2, eqs. (5)-(11), Figs. 11-13.

Deviations
----------
The formulas are reconstructed from the text around them. `delta` is strict: a robot that comes
just `delta` after another follows it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from clearway.world.lane_grid import CROSSING, T_CROSSING, Cell, LaneGrid

Kind = Literal["node", "swap", "between", "turn"]
Place = Literal["crossroad", "t-crossroad", "channel"]


class Node(NamedTuple):
    """A cell of a timed route: the robot is in its middle from ``arrive`` to ``depart``."""

    cell: Cell
    arrive: int
    depart: int


Route = Sequence[Node]


@dataclass(frozen=True)
class Conflict:
    """Two robots at odds: how, where, and at which nodes of their routes.

    ``one`` and ``other`` are indices into both routes.
    """

    kind: Kind
    place: Place
    one: int
    other: int

    @property
    def case(self) -> str:
        """Kind and place in a word, such as ``swap in channel``."""
        return f"{self.kind} in {self.place}"


def at_once(one: Node, other: Node, delta: int) -> bool:
    """Eqs. (5), (6): the same node, reached within ``delta``, or stood in at once."""
    return one.cell == other.cell and (
        abs(one.arrive - other.arrive) < delta
        or (one.arrive <= other.depart and other.arrive <= one.depart)
    )


def swap(one: Route, a: int, other: Route, b: int) -> bool:
    """Eqs. (7)-(9): the step from ``a`` and the step from ``b`` are head-on, at once."""
    return (
        one[a].cell == other[b + 1].cell
        and one[a + 1].cell == other[b].cell
        and one[a].depart < other[b + 1].arrive
        and other[b].depart < one[a + 1].arrive
    )


def enters_sideways(one: Route, a: int, other: Route, b: int, delta: int) -> bool:
    """Eqs. (10), (11): the step from ``a`` leads to a node that the other leaves aside."""
    return (
        one[a + 1].cell == other[b].cell
        and not _in_line(one[a].cell, other[b].cell, other[b + 1].cell)
        and other[b].arrive < one[a + 1].arrive + delta
        and one[a].depart < other[b + 1].arrive
    )


def kind_of(one: Route, a: int, other: Route, b: int, delta: int) -> Kind:
    """Say how two robots that hold the cell of nodes ``a`` and ``b`` at once are at odds.

    Who comes too close behind another, straight on, which no equation tells, meets it at the node.
    Nodes of two cells side by side mean large robots that turn there at once.
    """
    if one[a].cell != other[b].cell:
        return "turn"
    pairs = ((one, a, other, b), (other, b, one, a))
    if any(i > 0 and k + 1 < len(s) and swap(f, i - 1, s, k) for f, i, s, k in pairs):
        return "swap"
    if at_once(one[a], other[b], delta):
        return "node"
    if any(
        i > 0 and k + 1 < len(s) and enters_sideways(f, i - 1, s, k, delta) for f, i, s, k in pairs
    ):
        return "between"
    return "node"


def place_of(grid: LaneGrid, *cells: Cell) -> Place:
    """Eqs. (12), (15), (17): where a conflict is; in a crossing if any of its cells is."""
    regions = {int(grid.region[y, x]) for x, y in cells}
    if CROSSING in regions:
        return "crossroad"
    return "t-crossroad" if T_CROSSING in regions else "channel"


def conflicts(grid: LaneGrid, one: Route, other: Route, delta: int) -> Iterator[Conflict]:
    """Yield the conflicts of two routes, in the order of the first route's nodes."""
    for a, node in enumerate(one):
        for b, theirs in enumerate(other):
            if node.cell != theirs.cell:
                continue
            kind = kind_of(one, a, other, b, delta)
            if kind != "node" or at_once(node, theirs, delta):
                yield Conflict(kind, place_of(grid, node.cell), a, b)


def _in_line(before: Cell, middle: Cell, after: Cell) -> bool:
    """Whether three cells in a row lie on one line, a turn back included."""
    (x0, y0), (x1, y1), (x2, y2) = before, middle, after
    return (x1 - x0) * (y2 - y1) == (y1 - y0) * (x2 - x1)
