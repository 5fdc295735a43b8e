"""Trips of grid robots from endpoint to endpoint, one committed after the other."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from clearway import _core
from clearway.model import (
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
from clearway.plan.lane_motion import HEADINGS, QUARTER, trajectory_of, turn_ticks
from clearway.protocols import Refusal
from clearway.world.lane_grid import CROSSING, T_CROSSING, Cell, LaneGrid

MoveMap = NDArray[np.uint8]  # bits of the legal directions out of each cell, indexed [y, x]
LIMIT = 100_000  # expansions of a search, times the effort


@dataclass
class LaneCounts:
    """What planning has come to: trips committed, those that wait on the way, expansions."""

    trips: int = 0
    waits: int = 0
    expansions: int = 0


class LaneTrips:
    """Plans trips on a lane grid: one visit each, at an endpoint that nobody else owns.

    A robot owns the endpoint at which it rests until it has left it, and no route crosses an
    endpoint, so that all channels become empty in finite time and every trip has a plan: the
    robot waits where it is until then (R-B36 of the pages on system B).

    Parameters
    ----------
    robots
        All of one type, each at its own endpoint.
    moves
        The legal moves from an endpoint to another, such as
        `clearway.world.dynamic_map.DynamicMap`.
    """

    def __init__(
        self,
        grid: LaneGrid,
        robots: Sequence[Robot],
        robot_type: RobotType,
        moves: Callable[[Cell, Cell], MoveMap],
    ) -> None:
        self.grid = grid
        self.counts = LaneCounts()
        self.changed: tuple[Commitment, ...] = ()
        self._moves = moves
        self._names = [robot.id for robot in robots]
        self._number = {robot.id: k for k, robot in enumerate(robots)}
        self._endpoint = {point.cell: point.name for point in grid.endpoints.values()}
        limits = robot_type.limits
        self._step = to_ticks(grid.cell / limits.speed)
        self._quarter = 0 if limits.yaw_rate is None else to_ticks(QUARTER / limits.yaw_rate)
        wide = _is_wide(grid, robot_type, self._quarter > 0)
        width, height = grid.size
        self._holds = _core.CellHolds(width, height, len(robots), self._step, wide)
        crossing = (grid.region == CROSSING) | (grid.region == T_CROSSING)
        may_wait = np.ascontiguousarray(~crossing, dtype=np.uint8)
        self._search = _core.LaneSearch(self._holds, may_wait, self._quarter)
        self._committed: dict[str, Commitment] = {}
        self._loaded = dict.fromkeys(self._names, False)
        for robot in robots:
            self._place(robot)

    def plan(self, trip: Trip, now: int, effort: int = 1) -> Commitment | Refusal:
        """Commit a robot to drive to its visit's endpoint, as early as it can be there."""
        self.changed = ()
        if refusal := self._refusal(trip):
            return refusal
        me = self._number[trip.robot]
        old = self._committed[trip.robot]
        ready = max(now, old.served)
        pose = old.trajectory.final_pose
        start, goal = self.grid.cell_at(pose), self.grid.cell_at(trip.visits[0].pose)
        if taken := self._owner(goal, me):
            return Refusal(f"{self._endpoint[goal]} is taken by {taken}", (taken,))
        way = self._way(me, pose, trip.visits[0].pose, ready, LIMIT * effort)
        if way is None:
            return Refusal(
                f"no way from {self._endpoint[start]} to {self._endpoint[goal]} "
                f"in {LIMIT * effort} expansions"
            )
        stays, behind, done = way
        self._holds.put(me, self._kept(me, now, stays))
        commitment = self._commitment(trip, old, now, stays, behind, done)
        self._committed[trip.robot] = commitment
        self.counts.trips += 1
        self.counts.waits += len(commitment.waits)
        return commitment

    @property
    def counters(self) -> Mapping[str, int]:
        """What planning has come to so far."""
        return asdict(self.counts)

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to; standing at its start before its first trip."""
        return self._committed[robot]

    def retime(self, trajectories: Mapping[str, Trajectory]) -> None:
        """Take over the same paths at other times, after delays; all robots' at once."""
        raise NotImplementedError

    def block(self, obstacle: Obstacle, now: int) -> tuple[str, ...]:
        """Learn of an obstacle at tick ``now``; return the robots whose motion runs into it."""
        raise NotImplementedError

    def _place(self, robot: Robot) -> None:
        cell = self.grid.cell_at(robot.start)
        if cell not in self._endpoint:
            raise ValueError(f"robot {robot.id} starts at {cell}, which is no endpoint")
        me = self._number[robot.id]
        if taken := self._owner(cell, me):
            raise ValueError(f"robots {taken} and {robot.id} both start at {self._endpoint[cell]}")
        self._holds.put(me, [_core.CellStay(self._index(cell), 0, _core.NEVER)])
        self._committed[robot.id] = Commitment(
            robot.id, Trajectory(robot.id, robot.start), rest=self._endpoint[cell]
        )

    def _refusal(self, trip: Trip) -> Refusal | None:
        """Say why a trip can never be planned."""
        if trip.robot not in self._number:
            return Refusal(f"there is no robot {trip.robot}", for_good=True)
        if len(trip.visits) != 1:
            return Refusal("a trip on lanes has one visit", for_good=True)
        visit = trip.visits[0]
        cell = self.grid.cell_at(visit.pose)
        middle = self.grid.centre(cell)
        if (
            cell not in self._endpoint
            or max(abs(middle.x - visit.pose.x), abs(middle.y - visit.pose.y))
            > 1e-6 * self.grid.cell
        ):
            return Refusal(f"{visit.pose} is not in the middle of an endpoint", for_good=True)
        return None

    def _owner(self, cell: Cell, me: int) -> str | None:
        """Return the robot other than ``me`` that rests, or will rest, at an endpoint."""
        holders = self._holds.holders(self._index(cell), _core.NEVER - 1)
        others = [self._names[robot] for robot in holders if robot != me]
        return others[0] if others else None

    def _way(
        self, me: int, pose: Pose, goal: Pose, ready: int, limit: int
    ) -> tuple[list[_core.CellStay], list[int], int] | None:
        """Return stays, whom it waits for in each, and when it stands as it should."""
        start, end = self.grid.cell_at(pose), self.grid.cell_at(goal)
        if start == end:
            turn = self._last_turn(pose.theta, goal.theta)
            stay = _core.CellStay(self._index(start), ready, _core.NEVER, ready, ready + turn)
            return [stay], [-1], ready + turn
        way = self._search(
            self._holds,
            self._moves(start, end),
            me,
            self._index(start),
            self._index(end),
            ready,
            [turn_ticks(pose.theta, theta, self._quarter) for theta in HEADINGS],
            [self._last_turn(theta, goal.theta) for theta in HEADINGS],
            limit,
        )
        self.counts.expansions += way.expansions
        return (way.stays, way.behind, way.ready) if way.found else None

    def _last_turn(self, before: float, after: float) -> int:
        """Return how long a turn at a goal lasts: a tick at least, for it is driven."""
        return turn_ticks(before, after, max(self._quarter, 1))

    def _kept(self, me: int, now: int, stays: Sequence[_core.CellStay]) -> list[_core.CellStay]:
        """Return a route: what is left of the present one, then ``stays``."""
        old = self._holds.route(me)
        left = [stay for stay, after in pairwise(old) if after.arrive > now]
        first, *rest = stays
        joined = _core.CellStay(
            first.cell, old[-1].arrive, first.depart, first.turn_begin, first.turn_end
        )
        return [*left, joined, *rest]

    def _commitment(
        self,
        trip: Trip,
        old: Commitment,
        now: int,
        stays: Sequence[_core.CellStay],
        behind: Sequence[int],
        done: int,
    ) -> Commitment:
        visit = trip.visits[0]
        arrive = max(done, to_ticks(visit.not_before))
        stop = Stop(0, arrive, arrive + to_ticks(visit.service))
        loaded = self._loaded[trip.robot]
        driven = old.trajectory
        new = trajectory_of(
            self.grid, trip.robot, driven.final_pose, stays, visit.pose, stop, loaded
        )
        if visit.load is not None:
            self._loaded[trip.robot] = visit.load == "pick"
        left = [k for k, (_, end) in enumerate(driven.timing) if end > now]
        if left:  # planned before the last trip was over
            kept = [*driven.pieces[left[0] :], *new.pieces]
            new = replace(
                new,
                start=kept[0].start,
                pieces=tuple(replace(piece, id=k) for k, piece in enumerate(kept)),
                timing=driven.timing[left[0] :] + new.timing,
            )
        waits = tuple(wait for wait in old.waits if wait.end is None or wait.end > now)
        rest = self._endpoint[self.grid.cell_at(visit.pose)]
        return Commitment(trip.robot, new, trip, rest, waits + self._waits(stays, behind))

    def _waits(self, stays: Sequence[_core.CellStay], behind: Sequence[int]) -> tuple[Wait, ...]:
        waits = []
        for stay, after, other in zip(stays, stays[1:], behind, strict=False):
            if other < 0 or stay.turn_begin <= stay.arrive:
                continue
            name = self._names[other]
            place = self._cell(after.cell)
            waits.append(
                Wait(
                    stay.arrive,
                    stay.turn_begin,
                    (name,),
                    f"{name} goes first: it holds the way on from {place}",
                )
            )
        return tuple(waits)

    def _index(self, cell: Cell) -> int:
        return cell[1] * self.grid.size[0] + cell[0]

    def _cell(self, index: int) -> Cell:
        return index % self.grid.size[0], index // self.grid.size[0]


def _is_wide(grid: LaneGrid, robot_type: RobotType, turns: bool) -> bool:
    """Return whether two robots must not turn side by side.

    Raises
    ------
    ValueError
        Where a body does not fit its cell, or sweeps a neighbour's while it turns.
    """
    wide = False
    for loaded in (False, True):
        shape = robot_type.shape(loaded)
        reach = shape.circumradius
        side = shape.radius or max(abs(v) for part in shape.parts for point in part for v in point)
        if 2.0 * side > grid.cell or (turns and reach + side > grid.cell):
            raise ValueError(
                f"robot type {robot_type.name} is too large for cells of {grid.cell} m: "
                "a body must fit its cell, and, where turns take time, turn beside another"
            )
        wide = wide or (turns and 2.0 * reach > grid.cell)
    return wide
