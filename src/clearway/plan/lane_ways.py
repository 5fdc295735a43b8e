"""Ways of single robots over a lane grid, past what others hold."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

import numpy as np

from clearway import _core
from clearway.model import Pose, RobotType, Wait, to_ticks
from clearway.plan.lane_bodies import turns_alone
from clearway.plan.lane_motion import HEADINGS, QUARTER, direction, timed, turn_ticks
from clearway.plan.route_search import RouteSearch
from clearway.world.lane_grid import CROSSING, HORIZONTAL, STEPS, T_CROSSING, Cell, LaneGrid
from clearway.world.move_map import MoveMap, moves_into

Moves = Callable[[Cell, Cell], MoveMap]


@dataclass(frozen=True)
class LaneWay:
    """Stays from where a robot sets out, its waits, and when it stands as it should."""

    stays: Sequence[_core.CellStay]
    waits: tuple[Wait, ...]
    done: int


class LaneWays:
    """Who holds which cell when, and the ways that are left.

    Parameters
    ----------
    moves
        The legal moves from a cell to an endpoint.
    """

    def __init__(
        self, grid: LaneGrid, names: Sequence[str], robot_type: RobotType, moves: Moves
    ) -> None:
        self.grid = grid
        self.names = names
        limits = robot_type.limits
        self.step = to_ticks(grid.cell / limits.speed)
        self.quarter = 0 if limits.yaw_rate is None else to_ticks(QUARTER / limits.yaw_rate)
        width, height = grid.size
        wide = turns_alone(grid, robot_type)
        self.holds = _core.CellHolds(width, height, len(names), self.step, wide)
        crossing = (grid.region == CROSSING) | (grid.region == T_CROSSING)
        self.may_wait = np.ascontiguousarray(~crossing, dtype=np.uint8)
        self.expansions = 0
        self._search = _core.LaneSearch(self.holds, self.may_wait, self.quarter)
        self._route = RouteSearch(grid, self.step, self.quarter)
        self._moves = moves
        self._free = np.ones(grid.region.shape, np.bool_)
        self._open: MoveMap | None = None  # moves that do not lead into closed cells

    def earliest(
        self,
        robot: int,
        start: Pose,
        goal: Pose,
        ready: int,
        granted: int,
        limit: int,
        any_direction: bool = False,
    ) -> LaneWay | None:
        """Return the earliest way past what all others hold; ``None``: none found.

        Parameters
        ----------
        granted
            Nobody is gone before into a cell that another begins to hold before this tick.
        any_direction
            Whether the robot may drive against the lanes.
        """
        begin, end = self.grid.cell_at(start), self.grid.cell_at(goal)
        if begin == end:
            done = ready + self._last_turn(start.theta, goal.theta)
            stay = _core.CellStay(self.index(end), ready, _core.NEVER, ready, done)
            return LaneWay([stay], (), done)
        way = self._search(
            self._legal(begin, end, any_direction),
            robot,
            self.index(begin),
            self.index(end),
            ready,
            granted,
            self._first_turns(start.theta),
            [self._last_turn(theta, goal.theta) for theta in HEADINGS],
            limit,
        )
        self.expansions += way.expansions
        # Who stands between two cells comes to the next one at the end of time: no way past it.
        if not way.found or way.ready >= _core.NEVER // 2:
            return None
        return LaneWay(way.stays, self._waits(way), way.ready)

    def alone(self, start: Pose, goal: Pose, ready: int) -> list[_core.CellStay] | None:
        """Return the best route of a robot with nobody else, without waits; ``None``: no route."""
        begin, end = self.grid.cell_at(start), self.grid.cell_at(goal)
        heading = tuple(STEPS)[round(start.theta / QUARTER) % len(HEADINGS)]
        cells = self._route(self._legal(begin, end), begin, end, heading)
        if cells is None or len(cells) < 2:
            return None
        indices = [self.index(cell) for cell in cells]
        turns = self._first_turns(start.theta)
        stays = timed(indices, self.grid.size[0], ready, self.step, turns, self.quarter)
        there = stays[-1].arrive
        turned = there + self._last_turn(HEADINGS[direction(*cells[-2:])], goal.theta)
        return [*stays[:-1], _core.CellStay(indices[-1], there, _core.NEVER, there, turned)]

    def close(self, cells: Collection[Cell]) -> None:
        """Let nobody enter some cells any more."""
        for x, y in cells:
            self._free[y, x] = False
        self._open = moves_into(self._free)

    @property
    def has_closed(self) -> bool:
        """Whether there are cells that nobody may enter."""
        return self._open is not None

    def is_shut(self, endpoint: Cell) -> bool:
        """Whether an endpoint, or all channel cells beside it, are closed."""
        cells = self.grid.entrances(endpoint)
        return not (self._free[endpoint[::-1]] and any(self._free[y, x] for x, y in cells))

    def owner(self, cell: Cell, robot: int) -> str | None:
        """Return who other than ``robot`` rests, or will rest, in a cell."""
        holders = self.holds.holders(self.index(cell), _core.NEVER - 1)
        others = [self.names[other] for other in holders if other != robot]
        return others[0] if others else None

    def index(self, cell: Cell) -> int:
        """Return a cell's number: rows from below, each from the left."""
        return cell[1] * self.grid.size[0] + cell[0]

    def cell(self, index: int) -> Cell:
        """Return the cell of a number."""
        return index % self.grid.size[0], index // self.grid.size[0]

    def _legal(self, start: Cell, goal: Cell, any_direction: bool = False) -> MoveMap:
        moves = self._moves(start, goal)
        if any_direction:
            channel = self.grid.region >= HORIZONTAL
            moves = moves | np.where(channel, moves_into(channel), np.uint8(0))
        return moves if self._open is None else moves & self._open

    def _first_turns(self, theta: float) -> list[int]:
        return [turn_ticks(theta, heading, self.quarter) for heading in HEADINGS]

    def _last_turn(self, before: float, after: float) -> int:
        """Return how long a turn at a goal lasts: a tick at least, for it is driven."""
        return turn_ticks(before, after, max(self.quarter, 1))

    def _waits(self, way: _core.LaneWay) -> tuple[Wait, ...]:
        return tuple(
            Wait(
                stay.arrive,
                stay.turn_begin,
                (self.names[other],),
                f"{self.names[other]} goes first: it holds the way on until then",
            )
            for stay, other in zip(way.stays, way.behind, strict=True)
            if other >= 0
        )
