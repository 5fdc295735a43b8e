"""Trips of grid robots from endpoint to endpoint, one committed after the other."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from clearway import _core
from clearway.model import (
    TICKS_PER_SECOND,
    Commitment,
    Obstacle,
    Pose,
    Robot,
    RobotType,
    Stop,
    Trajectory,
    Trip,
    Wait,
    to_ticks,
)
from clearway.plan.lane_bodies import turns_alone
from clearway.plan.lane_motion import (
    HEADINGS,
    QUARTER,
    direction,
    numbered,
    stays_of,
    timed,
    trajectory_of,
    turn_ticks,
)
from clearway.plan.lane_waits import made_to_wait, own_waits, search_waits
from clearway.plan.named_waits import retimed_waits
from clearway.plan.route_search import RouteSearch
from clearway.plan.waits_by_rule import WaitsByRule
from clearway.protocols import Refusal
from clearway.world.lane_grid import CROSSING, STEPS, T_CROSSING, Cell, LaneGrid
from clearway.world.move_map import MoveMap

LIMIT = 100_000  # expansions of a search, times the effort

Rules = Literal["waiting", "search"]
Stays = Sequence[_core.CellStay]


@dataclass(frozen=True)
class _Way:
    """Stays from where the robot sets out, its waits, and when it stands as it should."""

    stays: Stays
    waits: tuple[Wait, ...]
    done: int


class LaneTrips:
    """Plans trips on a lane grid: one visit each, at an endpoint that nobody else owns.

    A robot owns the endpoint at which it rests until it has left it, and no route crosses an
    endpoint, so that all channels become empty in finite time and every trip has a plan: the
    robot waits where it is until then.

    `changed` holds the commitments of other robots that the last trip made wait.

    Parameters
    ----------
    robots
        All of one type, each at its own endpoint.
    moves
        The legal moves from a cell to an endpoint, such as
        `clearway.world.dynamic_map.DynamicMap`.
    rules
        ``waiting``: the best route of a robot alone, with waits by the paper's rules, its own and
        others', and the search where these do not free it of conflicts. ``search``: the earliest
        way past what others are committed to.
    delta
        Ticks within which two robots must not come to one node, to tell conflicts apart;
        ``None``: as many as a step takes.
    notice
        Ticks for which robots do as they were told, whatever is planned anew: at least how far
        an executor's grants look ahead.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 4 and 5.
    """

    def __init__(
        self,
        grid: LaneGrid,
        robots: Sequence[Robot],
        robot_type: RobotType,
        moves: Callable[[Cell, Cell], MoveMap],
        rules: Rules = "waiting",
        delta: int | None = None,
        notice: int = 2 * TICKS_PER_SECOND,
    ) -> None:
        if rules not in ("waiting", "search"):
            raise ValueError(f"rules must be 'waiting' or 'search', got {rules!r}")
        self.grid = grid
        self._counts: Counter[str] = Counter(trips=0, waits=0, fallbacks=0, expansions=0)
        self.changed: tuple[Commitment, ...] = ()
        self._moves = moves
        self._notice = notice
        self._names = [robot.id for robot in robots]
        self._number = {robot.id: k for k, robot in enumerate(robots)}
        self._endpoint = {point.cell: point.name for point in grid.endpoints.values()}
        limits = robot_type.limits
        self._step = to_ticks(grid.cell / limits.speed)
        self._quarter = 0 if limits.yaw_rate is None else to_ticks(QUARTER / limits.yaw_rate)
        wide = turns_alone(grid, robot_type)
        width, height = grid.size
        self._holds = _core.CellHolds(width, height, len(robots), self._step, wide)
        crossing = (grid.region == CROSSING) | (grid.region == T_CROSSING)
        self._search = _core.LaneSearch(
            self._holds, np.ascontiguousarray(~crossing, dtype=np.uint8), self._quarter
        )
        self._route = RouteSearch(grid, self._step, self._quarter)
        self._rules = (
            WaitsByRule(grid, self._holds, self._step if delta is None else delta)
            if rules == "waiting"
            else None
        )
        self._committed: dict[str, Commitment] = {}
        self._loaded = dict.fromkeys(self._names, False)
        self._lengths: dict[tuple[Cell, Cell], float] = {}
        for robot in robots:
            self._place(robot)

    def plan(self, trip: Trip, now: int, effort: int = 1) -> Commitment | Refusal:
        """Commit a robot to drive to its visit's endpoint; others may be made to wait for it."""
        self.changed = ()
        if refusal := self._refusal(trip):
            return refusal
        me = self._number[trip.robot]
        old = self._committed[trip.robot]
        start, goal = old.trajectory.final_pose, trip.visits[0].pose
        ready = max(now, old.served)
        way = self._by_rules(me, start, goal, ready, now) if self._rules else None
        if way is None:
            way = self._by_search(me, start, goal, ready, now, LIMIT * effort)
            if way is None:
                return Refusal(f"no way to {trip.goals[0] or goal} in {LIMIT * effort} expansions")
            self._holds.put(me, self._joined(me, now, way.stays)[0])
        commitment = self._commitment(trip, old, now, way)
        self._committed[trip.robot] = commitment
        self._counts.update(trips=1, waits=len(way.waits))
        return commitment

    @property
    def counters(self) -> Mapping[str, int]:
        """Trips; waits, of others too; trips left to the search; conflicts by case; expansions."""
        return self._counts

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to; standing at its start before its first trip."""
        return self._committed[robot]

    def retime(self, trajectories: Mapping[str, Trajectory]) -> None:
        """Take over the same paths at other times, after delays; all robots' at once."""
        for robot, trajectory in trajectories.items():
            old = self._committed[robot]
            self._committed[robot] = replace(
                old, trajectory=trajectory, waits=retimed_waits(old, trajectory)
            )
            self._holds.put(self._number[robot], stays_of(self.grid, trajectory))

    def block(self, obstacle: Obstacle, now: int) -> tuple[str, ...]:
        """Learn of an obstacle at tick ``now``; return the robots whose motion runs into it."""
        raise NotImplementedError

    def route_length(self, start: Cell, goal: Cell) -> float:
        """Return how far (m) it is from a cell to an endpoint with nobody else; else infinite."""
        if (start, goal) not in self._lengths:
            cells = (
                () if start == goal else self._route(self._moves(start, goal), start, goal, None)
            )
            self._lengths[start, goal] = (
                float("inf") if cells is None else max(len(cells) - 1, 0) * self.grid.cell
            )
        return self._lengths[start, goal]

    def _place(self, robot: Robot) -> None:
        cell = self.grid.cell_at(robot.start)
        if cell not in self._endpoint:
            raise ValueError(
                f"robot {robot.id} starts in cell {cell}, which is no endpoint; start it at one"
            )
        me = self._number[robot.id]
        if taken := self._owner(cell, me):
            raise ValueError(
                f"robots {taken} and {robot.id} both start at {self._endpoint[cell]}; move one"
            )
        self._holds.put(me, [_core.CellStay(self._index(cell), 0, _core.NEVER)])
        self._committed[robot.id] = Commitment(
            robot.id, Trajectory(robot.id, robot.start), rest=self._endpoint[cell]
        )

    def _refusal(self, trip: Trip) -> Refusal | None:
        """Say what stands against a trip before it is planned."""
        if trip.robot not in self._number:
            return Refusal(f"there is no robot {trip.robot}", for_good=True)
        if len(trip.visits) != 1:
            return Refusal("a trip on lanes has one visit", for_good=True)
        pose = trip.visits[0].pose
        cell = self.grid.cell_at(pose)
        middle = self.grid.centre(cell)
        off = max(abs(middle.x - pose.x), abs(middle.y - pose.y))
        if cell not in self._endpoint or off > 1e-6 * self.grid.cell:
            return Refusal(f"{pose} is not the middle of an endpoint", for_good=True)
        if taken := self._owner(cell, self._number[trip.robot]):
            return Refusal(f"{self._endpoint[cell]} is taken by {taken}", (taken,))
        return None

    def _owner(self, cell: Cell, me: int) -> str | None:
        """Return the robot other than ``me`` that rests, or will rest, at an endpoint."""
        holders = self._holds.holders(self._index(cell), _core.NEVER - 1)
        others = [self._names[robot] for robot in holders if robot != me]
        return others[0] if others else None

    def _by_search(
        self, me: int, start: Pose, goal: Pose, ready: int, now: int, limit: int
    ) -> _Way | None:
        """Return the earliest way past what all others are committed to."""
        begin, end = self.grid.cell_at(start), self.grid.cell_at(goal)
        if begin == end:
            done = ready + self._last_turn(start.theta, goal.theta)
            stay = _core.CellStay(self._index(end), ready, _core.NEVER, ready, done)
            return _Way([stay], (), done)
        way = self._search(
            self._holds,
            self._moves(begin, end),
            me,
            self._index(begin),
            self._index(end),
            ready,
            now + self._notice,
            self._first_turns(start.theta),
            [self._last_turn(theta, goal.theta) for theta in HEADINGS],
            limit,
        )
        self._counts["expansions"] += way.expansions
        if not way.found:
            return None
        return _Way(way.stays, search_waits(way.stays, way.behind, self._names), way.ready)

    def _by_rules(self, me: int, start: Pose, goal: Pose, ready: int, now: int) -> _Way | None:
        """Return the best route of a robot alone, with waits, held; others wait for it, too."""
        assert self._rules is not None
        begin, end = self.grid.cell_at(start), self.grid.cell_at(goal)
        if begin == end:
            return None
        heading = round(start.theta / QUARTER) % len(HEADINGS)
        cells = self._route(self._moves(begin, end), begin, end, tuple(STEPS)[heading])
        if cells is None:
            return None
        indices = [self._index(cell) for cell in cells]
        width = self.grid.size[0]
        turns = self._first_turns(start.theta)
        stays = timed(indices, width, ready, self._step, turns, self._quarter)
        there = stays[-1].arrive
        turned = there + self._last_turn(HEADINGS[direction(*cells[-2:])], goal.theta)
        stays[-1] = _core.CellStay(indices[-1], there, _core.NEVER, there, turned)
        route, first = self._joined(me, now, stays)
        ruled = self._rules(me, route, first, now + self._notice)
        if ruled is None:
            self._counts["fallbacks"] += 1
            return None
        self._counts.update(ruled.resolved)
        for pause in ruled.pauses:
            if pause.robot != me:
                name = self._names[pause.robot]
                self._committed[name] = made_to_wait(self._committed[name], pause, self._names)
                self._counts["waits"] += 1
        others = dict.fromkeys(pause.robot for pause in ruled.pauses if pause.robot != me)
        self.changed = tuple(self._committed[self._names[robot]] for robot in others)
        mine = [pause for pause in ruled.pauses if pause.robot == me]
        waits = own_waits(ruled.stays, mine, self._names, ready)
        return _Way(ruled.stays[first:], waits, ruled.stays[-1].turn_end)

    def _first_turns(self, theta: float) -> list[int]:
        return [turn_ticks(theta, heading, self._quarter) for heading in HEADINGS]

    def _last_turn(self, before: float, after: float) -> int:
        """Return how long a turn at a goal lasts: a tick at least, for it is driven."""
        return turn_ticks(before, after, max(self._quarter, 1))

    def _joined(self, me: int, now: int, stays: Stays) -> tuple[list[_core.CellStay], int]:
        """Return what is left of the present route, then ``stays``; and where these begin."""
        old = self._holds.route(me)
        left = [stay for stay, after in pairwise(old) if after.arrive > now]
        first, *rest = stays
        joined = _core.CellStay(
            first.cell, old[-1].arrive, first.depart, first.turn_begin, first.turn_end
        )
        return [*left, joined, *rest], len(left)

    def _commitment(self, trip: Trip, old: Commitment, now: int, way: _Way) -> Commitment:
        visit = trip.visits[0]
        arrive = max(way.done, to_ticks(visit.not_before))
        stop = Stop(0, arrive, arrive + to_ticks(visit.service))
        driven, loaded = old.trajectory, self._loaded[trip.robot]
        new = trajectory_of(
            self.grid, trip.robot, driven.final_pose, way.stays, visit.pose, stop, loaded
        )
        if visit.load is not None:
            self._loaded[trip.robot] = visit.load == "pick"
        left = [k for k, (_, end) in enumerate(driven.timing) if end > now]
        if left:  # planned before the last trip was over
            kept = driven.pieces[left[0] :]
            new = replace(
                new,
                start=kept[0].start,
                pieces=numbered([*kept, *new.pieces]),
                timing=driven.timing[left[0] :] + new.timing,
            )
        waits = tuple(wait for wait in old.waits if wait.end is None or wait.end > now)
        rest = self._endpoint[self.grid.cell_at(visit.pose)]
        return Commitment(trip.robot, new, trip, rest, waits + way.waits)

    def _index(self, cell: Cell) -> int:
        return cell[1] * self.grid.size[0] + cell[0]
