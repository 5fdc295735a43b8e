"""Earliest arrival over a tiny lane grid, tick by tick: what the search over intervals must find.

Others' routes are laid out as a table of who is how in which cell during which tick. A robot is
in a cell as ``head`` while it enters, ``body`` while it stands and ``tail`` while it leaves; a
head and a tail of one direction may share a cell, nothing else may.
"""

import heapq
import itertools
from collections import defaultdict

STEPS = ((1, 0), (0, 1), (-1, 0), (0, -1))
FOREVER = 1 << 30


class Occupied:
    """Who is in which cell during which tick, and who turns there."""

    def __init__(self, routes, width: int) -> None:
        self.stages = defaultdict(list)
        self.turning = set()
        self.rests = {}
        self.settled = 0
        for route in routes:
            for before, stay, after in zip((None, *route), route, (*route[1:], None), strict=False):
                cell = (stay.cell % width, stay.cell // width)
                if before:
                    way = step_between(before.cell, stay.cell, width)
                    self.put(cell, before.depart, stay.arrive, ("head", way))
                if after:
                    way = step_between(stay.cell, after.cell, width)
                    self.put(cell, stay.arrive, stay.depart, ("body", None))
                    self.put(cell, stay.depart, after.arrive, ("tail", way))
                else:
                    self.rests[cell] = min(stay.arrive, self.rests.get(cell, FOREVER))
                    self.settled = max(self.settled, stay.arrive)
                for tick in range(stay.turn_begin, stay.turn_end):
                    self.turning.add((cell, tick))
                self.settled = max(self.settled, stay.turn_end)

    def put(self, cell, begin: int, end: int, stage) -> None:
        for tick in range(begin, end):
            self.stages[cell, tick].append(stage)

    def allows(self, cell, tick: int, stage) -> bool:
        if self.rests.get(cell, FOREVER) <= tick:
            return False
        pairs = ({stage[0], other[0]} for other in self.stages[cell, tick] if other[1] == stage[1])
        return sum(pair == {"head", "tail"} for pair in pairs) == len(self.stages[cell, tick])

    def free_for_good(self, cell, tick: int) -> bool:
        return cell not in self.rests and all(
            self.allows(cell, t, ("body", None)) for t in range(tick, self.settled + 1)
        )


def step_between(one: int, other: int, width: int):
    return other % width - one % width, other // width - one // width


def earliest(moves, may_wait, occupied, start, goal, now, first, last, step, quarter, wide):
    """Return the tick at which the robot is at the goal for good, turned; ``None``: never.

    Parameters
    ----------
    moves, may_wait
        Arrays indexed [y, x].
    first, last
        Ticks of the turns from the first heading, and to the last one, per direction.
    """
    horizon = max(now, occupied.settled) + 4 * step * moves.size + 8 * quarter + 50

    def turns(cell, tick: int, length: int) -> bool:
        beside = [(cell[0] + dx, cell[1] + dy) for dx, dy in STEPS]
        ticks = range(tick, tick + length)
        if wide and any(occupied.turning & {(c, t) for c in beside for t in ticks}):
            return False
        return all(occupied.allows(cell, t, ("body", None)) for t in ticks)

    count = itertools.count()
    queue = [(now, next(count), start, None, frozenset())]
    seen = set()
    best = None
    while queue:
        tick, _, cell, heading, passed = heapq.heappop(queue)
        if tick > horizon or (best is not None and tick >= best):
            break
        if (tick, cell, heading, passed) in seen:
            continue
        seen.add((tick, cell, heading, passed))
        if cell == goal:
            ready = tick
            while not turns(cell, ready, last[heading]):
                ready += 1
                if ready > horizon:
                    break
            if occupied.free_for_good(cell, tick) and ready <= horizon:
                best = min(best or FOREVER, ready + last[heading])
            continue
        if (cell == start or may_wait[cell[1], cell[0]]) and occupied.allows(
            cell, tick, ("body", None)
        ):
            heapq.heappush(queue, (tick + 1, next(count), cell, heading, frozenset()))
        for way, (dx, dy) in enumerate(STEPS):
            to = (cell[0] + dx, cell[1] + dy)
            inside = 0 <= to[0] < moves.shape[1] and 0 <= to[1] < moves.shape[0]
            if not moves[cell[1], cell[0]] >> way & 1 or not inside or to in passed:
                continue
            if to == start and not may_wait[start[1], start[0]]:
                continue
            turned = (
                first[way]
                if heading is None
                else quarter * min((way - heading) % 4, (heading - way) % 4)
            )
            if not turns(cell, tick, turned):
                continue
            leave = tick + turned
            if all(
                occupied.allows(cell, t, ("tail", (dx, dy)))
                and occupied.allows(to, t, ("head", (dx, dy)))
                for t in range(leave, leave + step)
            ):
                known = frozenset() if may_wait[to[1], to[0]] else passed | {to}
                heapq.heappush(queue, (leave + step, next(count), to, way, known))
    return best
