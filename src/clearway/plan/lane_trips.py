"""Trips of grid robots from endpoint to endpoint, one committed after the other."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Literal

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
    to_ticks,
)
from clearway.plan.lane_detours import LaneDetours
from clearway.plan.lane_motion import numbered, stays_of, trajectory_of
from clearway.plan.lane_waits import made_to_wait, own_waits
from clearway.plan.lane_ways import LaneWay, LaneWays, Moves
from clearway.plan.named_waits import retimed_waits
from clearway.plan.waits_by_rule import ROUNDS, WaitsByRule
from clearway.protocols import Refusal
from clearway.world.lane_grid import LaneGrid

LIMIT = 100_000  # expansions of a search, times the effort


class LaneTrips:
    """Plans trips on a lane grid: one visit each, at an endpoint that nobody else owns.

    A robot owns the endpoint at which it rests until it has left it, and no route crosses an
    endpoint, so that all channels become empty in finite time and every trip has a plan: the
    robot waits where it is until then.

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
    rounds
        Conflicts of a trip that rules resolve at the most.

    Raises
    ------
    ValueError
        A robot starts at no endpoint or at another's, or its body is too large for the cells.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Systems 12(1), 9. Sec. 4 and 5.
    """

    def __init__(
        self,
        grid: LaneGrid,
        robots: Sequence[Robot],
        robot_type: RobotType,
        moves: Moves,
        rules: Literal["waiting", "search"] = "waiting",
        delta: int | None = None,
        notice: int = 2 * TICKS_PER_SECOND,
        rounds: int = ROUNDS,
    ) -> None:
        if rules not in ("waiting", "search"):
            raise ValueError(f"rules must be 'waiting' or 'search', got {rules!r}")
        self.grid = grid
        self.changed: tuple[Commitment, ...] = ()
        self._names = [robot.id for robot in robots]
        self._number = {robot.id: k for k, robot in enumerate(robots)}
        self._endpoint = {point.cell: point.name for point in grid.endpoints.values()}
        self._ways = ways = LaneWays(grid, self._names, robot_type, moves)
        self._holds = ways.holds
        self._rules = (
            WaitsByRule(grid, ways.holds, ways.step if delta is None else delta, rounds)
            if rules == "waiting"
            else None
        )
        self._notice = notice
        self._counts: Counter[str] = Counter(trips=0, waits=0, fallbacks=0)
        self._committed: dict[str, Commitment] = {}
        self._loaded = dict.fromkeys(self._names, False)
        for robot in robots:
            self._place(robot)

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        """Commit a robot to drive to its visit's endpoint; others may be made to wait for it."""
        self.changed = ()
        if refusal := self._refusal(trip):
            return refusal
        me = self._number[trip.robot]
        old = self._committed[trip.robot]
        start, goal = old.trajectory.final_pose, trip.visits[0].pose
        # A robot that gave its trip up may still be on its way to rest.
        ready = max(now + lead, old.served, old.trajectory.end)
        way = self._by_rules(me, start, goal, ready, now)
        if way is None:
            granted, limit = now + self._notice, LIMIT * effort
            spent = self._ways.expansions
            way = self._ways.earliest(me, start, goal, ready, granted, limit)
            if way is None and self._ways.has_closed:
                # Obstacles may leave no way along the lanes.
                way = self._ways.earliest(me, start, goal, ready, granted, limit, True)
            if way is None:
                return Refusal(
                    f"no way to {trip.goals[0] or goal} in {limit} expansions",
                    expansions=self._ways.expansions - spent,
                )
            self._holds.put(me, self._joined(me, now, way.stays)[0])
        commitment = self._commitment(trip, old, now, way)
        self._committed[trip.robot] = commitment
        self._counts.update(trips=1, waits=len(way.waits))
        return commitment

    @property
    def counters(self) -> Mapping[str, int]:
        """Trips; waits, of others too; trips left to the search; conflicts by case; expansions."""
        return {**self._counts, "expansions": self._ways.expansions}

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to; standing at its start before its first trip."""
        return self._committed[robot]

    def retime(self, trajectories: Mapping[str, Trajectory], now: int) -> None:
        """Take over the same paths at other times, after delays; all robots' at once."""
        for robot, trajectory in trajectories.items():
            old = self._committed[robot]
            waits = retimed_waits(old, trajectory)
            self._committed[robot] = replace(old, trajectory=trajectory, waits=waits)
            self._holds.put(self._number[robot], stays_of(self.grid, trajectory))

    def block(self, obstacle: Obstacle, now: int, lead: int = 0) -> tuple[str, ...]:
        """Learn of an obstacle at tick ``now``; return the robots whose motion runs into it.

        Each drives to its goal another way from where it can stop, against the lanes if need be,
        or else, its trip given up, to an endpoint that is free; else it stands, and robots in
        whose way it then is are committed anew likewise.
        """
        self.changed = ()
        detours = LaneDetours(
            self._ways, self._committed, self._loaded, now, max(lead, self._notice), LIMIT
        )
        return detours(obstacle)

    def _place(self, robot: Robot) -> None:
        cell = self.grid.cell_at(robot.start)
        if cell not in self._endpoint:
            raise ValueError(
                f"robot {robot.id} starts in cell {cell}, which is no endpoint; start it at one"
            )
        me = self._number[robot.id]
        if taken := self._ways.owner(cell, me):
            raise ValueError(
                f"robots {taken} and {robot.id} both start at {self._endpoint[cell]}; move one"
            )
        self._holds.put(me, [_core.CellStay(self._ways.index(cell), 0, _core.NEVER)])
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
        if cell not in self._endpoint or not self._in_middle(pose):
            return Refusal(f"{pose} is not the middle of an endpoint", for_good=True)
        if not self._in_middle(self._committed[trip.robot].trajectory.final_pose):
            return Refusal(f"{trip.robot} stands in front of an obstacle", ("obstacle",))
        if self._ways.is_shut(cell):
            reason = f"an obstacle closes the way to {self._endpoint[cell]}"
            return Refusal(reason, ("obstacle",), for_good=True)
        if taken := self._ways.owner(cell, self._number[trip.robot]):
            return Refusal(f"{self._endpoint[cell]} is taken by {taken}", (taken,))
        return None

    def _in_middle(self, pose: Pose) -> bool:
        middle = self.grid.centre(self.grid.cell_at(pose))
        return pose.distance(middle) < 1e-6 * self.grid.cell

    def _by_rules(self, me: int, start: Pose, goal: Pose, ready: int, now: int) -> LaneWay | None:
        """Return the best route of a robot alone, with waits, held; others wait for it, too."""
        stays = self._ways.alone(start, goal, ready) if self._rules else None
        if self._rules is None or stays is None:
            return None
        route, first = self._joined(me, now, stays)
        ruled = self._rules(me, route, first, now + self._notice)
        if ruled is None:
            self._counts["fallbacks"] += 1
            return None
        self._counts.update(ruled.resolved)
        others = [pause for pause in ruled.pauses if pause.robot != me]
        for pause in others:
            name = self._names[pause.robot]
            self._committed[name] = made_to_wait(self._committed[name], pause, self._names)
        names = dict.fromkeys(self._names[pause.robot] for pause in others)
        self.changed = tuple(self._committed[name] for name in names)
        self._counts["waits"] += len(others)
        mine = [pause for pause in ruled.pauses if pause.robot == me]
        waits = own_waits(ruled.stays, mine, self._names, ready)
        return LaneWay(ruled.stays[first:], waits, ruled.stays[-1].turn_end)

    def _joined(
        self, me: int, now: int, stays: Sequence[_core.CellStay]
    ) -> tuple[list[_core.CellStay], int]:
        """Return what is left of the present route, then ``stays``; and where these begin."""
        old = self._holds.route(me)
        left = [stay for stay, after in pairwise(old) if after.arrive > now]
        first, *rest = stays
        joined = _core.CellStay(
            first.cell, old[-1].arrive, first.depart, first.turn_begin, first.turn_end
        )
        return [*left, joined, *rest], len(left)

    def _commitment(self, trip: Trip, old: Commitment, now: int, way: LaneWay) -> Commitment:
        visit = trip.visits[0]
        arrive = max(way.done, to_ticks(visit.not_before))
        stop = Stop(0, arrive, arrive + to_ticks(visit.service))
        driven, loaded = old.trajectory, self._loaded[trip.robot]
        new = trajectory_of(
            self.grid, trip.robot, driven.final_pose, way.stays, visit.pose, (stop,), loaded
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
