"""When robots will be where, if nothing holds them up but each other."""

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from clearway.execute.course import Course, Stretch
from clearway.model import Piece, Stop, Trajectory
from clearway.protocols import Precedence


@dataclass
class _Item:
    """What is left of a stretch: from tick ``planned`` on, expected from ``begin`` on."""

    stretch: Stretch
    planned: int
    begin: int

    @property
    def end(self) -> int:
        return self.begin + self.stretch.end - self.planned


@dataclass(frozen=True)
class _Hold:
    """An item begins ``lead`` ticks before another robot has passed a tick, no sooner.

    That is ``offset`` after the begin of its item ``passes`` (if any), and not before ``least``.
    """

    item: int
    lead: int
    other: str
    passes: int
    offset: int
    least: int


def project(
    courses: Mapping[str, Course],
    progress: Mapping[str, int],
    unmet: Mapping[str, Sequence[Precedence]],
    now: int,
) -> dict[str, Trajectory]:
    """Return everybody's remaining paths at the least times that keep all precedences.

    Late robots skip planned waits, nobody is ahead of the plan, and services last as long as
    planned. Who is held stands before a piece, not within it, but for the piece it is on. Such
    times exist: as every ``passed`` is at most its ``at``, the plan shifted by the largest delay
    is one choice.

    Parameters
    ----------
    progress
        Ticks that the robots have come to on their courses.
    unmet
        What each of them still waits for.

    Returns
    -------
    dict
        Trajectories from ``now`` on, without what has been driven: the piece that a robot is on
        is cut where it is. Those of robots that keep their times are as they were.
    """
    items = {robot: _left(courses[robot], progress[robot], now) for robot in courses}
    holds = {robot: _holds(robot, items, unmet[robot], now) for robot in courses}
    waiting = defaultdict(set)
    for robot, each in holds.items():
        for hold in each:
            waiting[hold.other].add(robot)
    todo = dict.fromkeys(courses)
    while todo:
        robot = next(iter(todo))
        del todo[robot]
        if _push(items, holds[robot], robot):
            todo.update(dict.fromkeys(sorted(waiting[robot])))
    return {robot: _trajectory(courses[robot], progress[robot], items[robot]) for robot in courses}


def _left(course: Course, progress: int, now: int) -> list[_Item]:
    """Return what a robot still does, as soon as it can alone."""
    items: list[_Item] = []
    tick = now
    for stretch in course.stretches[course.index(progress) :]:
        if stretch.is_wait:
            continue
        planned = max(stretch.begin, progress)
        items.append(_Item(stretch, planned, max(tick, planned)))
        tick = items[-1].end
    return items


def _holds(
    robot: str, items: Mapping[str, list[_Item]], unmet: Sequence[Precedence], now: int
) -> list[_Hold]:
    mine, holds = items[robot], []
    for each in unmet:
        k = bisect_right(mine, each.at, key=lambda item: item.stretch.end)
        if k == len(mine):
            continue
        lead = max(0, each.at - mine[k].planned)
        its = items[each.other]
        # The item in which the other passes, or after which it waits meanwhile.
        m = bisect_left(its, each.passed, key=lambda item: item.planned) - 1
        left = its[m].stretch.end - its[m].planned if m >= 0 else 0
        offset = min(each.passed - its[m].planned, left) if m >= 0 else 0
        waits = m < 0 or each.passed > its[m].stretch.end
        least = max(now, each.passed) if waits else now
        holds.append(_Hold(k, lead, each.other, m, offset, least))
    return holds


def _push(items: Mapping[str, list[_Item]], holds: Sequence[_Hold], robot: str) -> bool:
    """Put off what must wait; return whether anything was."""
    mine = items[robot]
    changed = False
    for hold in holds:
        earliest = hold.least
        if hold.passes >= 0:
            earliest = max(earliest, items[hold.other][hold.passes].begin + hold.offset)
        if earliest - hold.lead > mine[hold.item].begin:
            mine[hold.item].begin = earliest - hold.lead
            changed = True
    for one, following in pairwise(mine):
        if one.end > following.begin:
            following.begin = one.end
            changed = True
    return changed


def _trajectory(course: Course, progress: int, items: Sequence[_Item]) -> Trajectory:
    old = course.trajectory
    if all(item.begin == item.planned for item in items):
        return old
    pieces: list[Piece] = []
    timing: list[tuple[int, int]] = []
    stops = {stop.visit: stop for stop in old.stops}
    for item in items:
        stretch = item.stretch
        if stretch.piece is not None:
            share = (item.planned - stretch.begin) / stretch.duration
            pieces.append(_rest_of(stretch.piece, share))
            timing.append((item.begin, item.end))
        elif stretch.visit is not None:
            stops[stretch.visit] = Stop(stretch.visit, item.end - stretch.duration, item.end)
    start = course.pose_before(progress)
    return Trajectory(old.robot, start, tuple(pieces), tuple(timing), tuple(stops.values()))


def _rest_of(piece: Piece, share: float) -> Piece:
    """Return what is left of a piece when a share of it has been driven."""
    if share == 0.0:
        return piece
    a, b, c = piece.twist
    left = 1.0 - share
    return replace(piece, start=piece.at(share), twist=(left * a, left * b, left * c))
