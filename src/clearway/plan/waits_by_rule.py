"""A route made free of conflicts by waits, one conflict after the other, by the paper's rules."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from clearway import _core
from clearway.plan.crossing_conflicts import Conflict, Node, kind_of, place_of
from clearway.plan.lane_ways import FOREVER
from clearway.plan.waiting_rules import ruling, waiting_nodes
from clearway.world.lane_grid import LaneGrid

ROUNDS = 50
CANNOT = "it cannot wait without being in somebody's way"


@dataclass(frozen=True)
class Pause:
    """A robot stands at node ``index`` of its route, for ``by`` ticks from ``at`` on."""

    robot: int
    index: int
    at: int
    by: int
    behind: int
    because: str = ""


@dataclass
class RuledRoute:
    """A route without conflicts, the pauses that made it so, and the conflicts by case."""

    stays: list[_core.CellStay]
    pauses: list[Pause] = field(default_factory=list)
    resolved: Counter[str] = field(default_factory=Counter)


class WaitsByRule:
    """Resolves the conflicts of a new route with those committed, in the order of their moments.

    A committed robot waits for the new one only if it still meets nobody then. Whoever should
    wait and cannot, goes first.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 5.3.

    Deviations
    ----------
    The paper lets pairs wait for each other without looking at third robots again. Here all
    conflicts are looked for again after each wait, up to so many times.

    Parameters
    ----------
    delta
        Ticks within which two robots must not come to one node.
    rounds
        Conflicts resolved at the most.
    """

    def __init__(self, grid: LaneGrid, holds: _core.CellHolds, delta: int, rounds: int) -> None:
        self._grid = grid
        self._holds = holds
        self._delta = delta
        self._rounds = rounds

    def __call__(
        self, robot: int, stays: Sequence[_core.CellStay], first: int, granted: int
    ) -> RuledRoute | None:
        """Return the route with its waits, held already; ``None``, with nothing changed: none.

        Parameters
        ----------
        stays
            Timed without waits.
        first
            Node from which on the robot may wait.
        granted
            Before this tick, committed robots do as they were told.
        """
        before = {robot: self._holds.route(robot)}
        route = RuledRoute(list(stays))
        self._holds.put(robot, route.stays)
        for _ in range(self._rounds):
            clashes = self._holds.clashes(robot, route.stays, granted)
            if not clashes:
                return route
            pause = self._resolve(robot, route, clashes[0], first, granted)
            if pause is None:
                break
            mine = pause.robot == robot
            old = route.stays if mine else self._holds.route(pause.robot)
            before.setdefault(pause.robot, old)
            later = _core.delayed(old, pause.index, pause.by)
            self._holds.put(pause.robot, later)
            if mine:
                route.stays = later
            route.pauses.append(pause)
        for changed, old in before.items():
            self._holds.put(changed, old)
        return None

    def _resolve(
        self, robot: int, route: RuledRoute, clash: _core.Clash, first: int, granted: int
    ) -> Pause | None:
        """Say who waits in a conflict; ``None``: neither can."""
        theirs = self._holds.route(clash.other)
        one, two = self._nodes(route.stays), self._nodes(theirs)
        a, b = clash.index, clash.other_index
        conflict = Conflict(
            kind_of(one, a, two, b, self._delta),
            place_of(self._grid, one[a].cell, two[b].cell),
            a,
            b,
        )
        rule = ruling(self._grid, conflict, one, two)
        mine = yours = None
        for index in waiting_nodes(self._grid, one, a):
            if index < first or mine:
                break
            mine = self._pause(robot, route.stays, index, clash.other, granted)
        if mine is None or rule.waiter != "one":
            ends = theirs[-1].arrive < _core.NEVER - 1  # else it stands between two cells for ever
            for index in waiting_nodes(self._grid, two, b) if ends else ():
                if theirs[index].turn_begin <= granted or yours:
                    break
                yours = self._pause(clash.other, theirs, index, robot, 0)
                if yours and self._holds.clashes(
                    clash.other, _core.delayed(theirs, index, yours.by)
                ):
                    yours = None
        if mine is None or yours is None:
            chosen = mine or yours
            because = rule.because if rule.waiter == ("one" if mine else "other") else CANNOT
        else:
            # Who asked later waits where both would for as long.
            shorter = mine if mine.by <= yours.by else yours
            chosen = {"one": mine, "other": yours, "shorter": shorter}[rule.waiter]
            because = rule.because
        if chosen is None:
            return None
        route.resolved[conflict.case] += 1
        return replace(chosen, because=f"{because} (eq. {rule.equation})")

    def _pause(
        self, robot: int, stays: Sequence[_core.CellStay], index: int, other: int, granted: int
    ) -> Pause | None:
        by = self._holds.least_delay(robot, stays, index, other, granted)
        if by < 0 or stays[-1].arrive + by >= FOREVER:
            return None  # none is enough, or the other stands there for ever
        return Pause(robot, index, stays[index].turn_begin, by, other)

    def _nodes(self, stays: Sequence[_core.CellStay]) -> list[Node]:
        width = self._grid.size[0]
        return [Node((s.cell % width, s.cell // width), s.arrive, s.depart) for s in stays]
