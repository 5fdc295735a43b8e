"""Cells held by robots: never by two at once, save that one follows the other."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

from clearway.validate.cell_list import DRIVE, Entry, step_between
from clearway.validate.violation import Violation
from clearway.world.lane_grid import Cell, LaneGrid

SLACK = 2e-3  # what rounded times may be apart (s)


@dataclass(frozen=True)
class _Hold:
    """A robot has a cell from leaving the one before (``begin``) to reaching the next (``end``).

    It reaches the middle at ``arrive`` and leaves it at ``depart``. ``came`` and ``goes`` are the
    steps into the cell and out of it.
    """

    robot: str
    cell: Cell
    begin: float
    arrive: float
    depart: float
    end: float
    came: Cell | None
    goes: Cell | None


def judge_holds(grid: LaneGrid, lists: Mapping[str, Sequence[Entry]]) -> Iterator[Violation]:
    """Yield each time that two robots have one cell, or change places."""
    by_cell: dict[Cell, list[_Hold]] = defaultdict(list)
    for robot, entries in lists.items():
        for hold in _holds(robot, entries):
            by_cell[hold.cell].append(hold)
    swapped: set[tuple[str, str, float]] = set()
    for cell, holds in by_cell.items():
        holds.sort(key=lambda hold: (hold.begin, hold.arrive, hold.robot))
        pose = grid.centre(cell)
        for one, other in _overlapping(holds):
            first, second = sorted((one, other), key=lambda hold: (hold.arrive, hold.begin))
            if _follows(second, first):
                continue
            robots, time = (first.robot, second.robot), max(first.begin, second.begin)
            kind, text = "hold", f"are both in cell {cell}"
            if _swap(first, second):
                # Seen from both cells, told once.
                time = max(first.depart, second.begin)
                if (min(robots), max(robots), time) in swapped:
                    continue
                swapped.add((min(robots), max(robots), time))
                kind, text = "swap", f"change places at cell {cell}"
            words = f"{first.robot} and {second.robot} {text}"
            yield Violation(kind, robots, time, (pose.x, pose.y), None, words)


def _holds(robot: str, entries: Sequence[Entry]) -> list[_Hold]:
    """Return what a robot holds; one that is astray holds the cell that it is in."""
    firsts = [i for i, e in enumerate(entries) if i == 0 or e.cell != entries[i - 1].cell]
    holds = []
    for k, i in enumerate(firsts):
        last = k + 1 == len(firsts)
        begin, end = entries[i].t_enter, inf
        depart = inf if last else entries[firsts[k + 1]].t_enter
        if not last:
            end = _reaches(entries, firsts[k + 1])
        came = None if k == 0 else step_between(entries[i - 1].cell, entries[i].cell)
        goes = None if last else step_between(entries[i].cell, entries[firsts[k + 1]].cell)
        arrive = begin if k == 0 else _reaches(entries, i)
        holds.append(_Hold(robot, entries[i].cell, begin, arrive, depart, end, came, goes))
    return holds


def _reaches(entries: Sequence[Entry], i: int) -> float:
    """Return when a robot is where entry ``i`` says; never if the list breaks off before."""
    if entries[i].state != DRIVE:
        return entries[i].t_enter
    return entries[i + 1].t_enter if i + 1 < len(entries) else inf


def _overlapping(holds: Sequence[_Hold]) -> Iterator[tuple[_Hold, _Hold]]:
    """Yield pairs of different robots' holds that share more than a moment; sorted by begin."""
    open_: list[_Hold] = []
    for hold in holds:
        open_ = [other for other in open_ if other.end > hold.begin + SLACK]
        yield from ((other, hold) for other in open_ if other.robot != hold.robot)
        open_.append(hold)


def _follows(second: _Hold, first: _Hold) -> bool:
    """Whether one comes into a cell that the other leaves straight ahead, never faster."""
    return (
        second.came is not None
        and second.came == first.goes
        and second.begin >= first.depart - SLACK
        and second.arrive >= first.end - SLACK
    )


def _swap(first: _Hold, second: _Hold) -> bool:
    """Whether one leaves to where the other comes from while that one comes."""
    if first.goes is None or second.came is None:
        return False
    opposite = first.goes == (-second.came[0], -second.came[1])
    return opposite and first.depart < second.arrive - SLACK
