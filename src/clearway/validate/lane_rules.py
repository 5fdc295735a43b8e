"""The rules of a lane grid: who may be in which cell, and which step is with the traffic."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from clearway.validate.cell_holds import judge_holds
from clearway.validate.cell_list import ASTRAY, DRIVE, Entry, step_between
from clearway.validate.violation import Violation
from clearway.world.lane_grid import STEPS, Cell, LaneGrid

LANE_KINDS = (
    "astray",  # off the lines through the middles of cells, or a step to no neighbour
    "cell",  # neither a channel nor an endpoint of the robot's own
    "lane",  # a step against the lanes, or to another endpoint
    "swap",  # two robots change places
    "hold",  # two robots in one cell
)
_BITS = {step: bit for bit, step in STEPS.items()}


@dataclass(frozen=True)
class _Leg:
    """Entries from one endpoint to the next, and the cells across from both: the aprons."""

    entries: Sequence[Entry]
    aprons: Collection[frozenset[Cell]]


def judge_lanes(
    grid: LaneGrid,
    lists: Mapping[str, Sequence[Entry]],
    own: Mapping[str, Collection[Cell]] | None = None,
) -> list[Violation]:
    """Return where robots break the rules of a lane grid, by time.

    A robot is in channels, or at endpoints of its own; it steps along lanes, and against them
    only within the apron of an endpoint that it comes from or goes to: the two cells across a
    bidirectional channel from it. No two robots are in one cell at once, save that one may follow
    another that drives on straight ahead, and they never change places.

    Parameters
    ----------
    lists
        By robot, as `cells_of` finds them.
    own
        The endpoints at which each robot has something to do; absent: those where it stands.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Secs. 2.1 and 5; eqs. (5)-(11) in the form
    that a robot holds a cell from leaving the one before until reaching the one after.
    """
    found: list[Violation] = []
    for robot, entries in lists.items():
        mine = own[robot] if own is not None else _where_it_stands(grid, entries)
        found += _judge_cells(grid, robot, entries, mine)
        for leg in _legs(grid, entries, mine):
            found += _judge_steps(grid, robot, leg)
    found += judge_holds(grid, lists)
    return sorted(found, key=lambda violation: violation.time)


def _where_it_stands(grid: LaneGrid, entries: Sequence[Entry]) -> Collection[Cell]:
    return {e.cell for e in entries if e.state != DRIVE and not grid.is_channel(e.cell)}


def _judge_cells(
    grid: LaneGrid, robot: str, entries: Sequence[Entry], own: Collection[Cell]
) -> Iterator[Violation]:
    endpoints = {point.cell: point.name for point in grid.endpoints.values()}
    before: Cell | None = None
    for entry in entries:
        if entry.state == ASTRAY:
            yield _violation(
                grid, "astray", robot, entry, "is off the lines through the middles of cells"
            )
        if entry.cell != before and not grid.is_channel(entry.cell) and entry.cell not in own:
            what = endpoints.get(entry.cell, "no channel")
            yield _violation(
                grid,
                "cell",
                robot,
                entry,
                f"is in cell {entry.cell}, {what}, and has no part in it",
            )
        before = entry.cell


def _legs(grid: LaneGrid, entries: Sequence[Entry], own: Collection[Cell]) -> Iterator[_Leg]:
    ends = [i for i, entry in enumerate(entries) if not grid.is_channel(entry.cell)]
    cuts = sorted({0, *ends, len(entries) - 1}) if entries else []
    for first, last in pairwise(cuts):
        around = [entries[first].cell, entries[last].cell]
        if grid.is_channel(entries[last].cell):
            around += own  # the list breaks off: it may be on its way to any of these
        aprons = [apron for cell in around if (apron := _apron(grid, cell))]
        yield _Leg(entries[first : last + 1], aprons)


def _apron(grid: LaneGrid, end: Cell) -> frozenset[Cell]:
    """Return the cells across the channel from an endpoint, if its lanes lead opposite ways."""
    entrances = [] if grid.is_channel(end) else list(grid.entrances(end))
    if not entrances:
        return frozenset()
    # Places at the end of a row have a second entrance, from the side.
    entrances.sort(key=lambda cell: cell[0] != end[0])
    (x, y), (dx, dy) = entrances[0], step_between(end, entrances[0])
    across = (x + dx, y + dy)
    if not grid.is_channel(across):
        return frozenset()
    along = [_BITS[dy, dx], _BITS[-dy, -dx]]
    both = [[bool(int(grid.lanes[cy, cx]) & bit) for bit in along] for cx, cy in ((x, y), across)]
    opposite = any(both[0]) and both[0] == both[1][::-1]
    return frozenset({(x, y), across}) if opposite else frozenset()


def _judge_steps(grid: LaneGrid, robot: str, leg: _Leg) -> Iterator[Violation]:
    for before, entry in pairwise(leg.entries):
        a, b = before.cell, entry.cell
        if a == b or ASTRAY in (before.state, entry.state):
            continue
        if step_between(a, b) not in _BITS:
            yield _violation(grid, "astray", robot, entry, f"steps from cell {a} to {b}")
        elif grid.is_channel(a) and grid.is_channel(b):
            along = int(grid.lanes[a[1], a[0]]) & _BITS[step_between(a, b)]
            if not along and not any({a, b} <= apron for apron in leg.aprons):
                yield _violation(grid, "lane", robot, entry, f"steps from cell {a} to {b}, no lane")
        elif not grid.is_channel(a) and not grid.is_channel(b):
            yield _violation(grid, "lane", robot, entry, f"steps from endpoint {a} to endpoint {b}")


def _violation(grid: LaneGrid, kind: str, robot: str, entry: Entry, text: str) -> Violation:
    pose = grid.centre(entry.cell)
    return Violation(kind, (robot,), entry.t_enter, (pose.x, pose.y), None, f"{robot} {text}")
