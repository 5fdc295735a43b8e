"""Robots that are slow or stop at random, each going no further than it is granted."""

import math
import random
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from clearway.model import (
    TICKS_PER_SECOND,
    Commitment,
    Disturbances,
    Pose,
    Robot,
    Stop,
    Trajectory,
    Trip,
    Wait,
    to_ticks,
)
from clearway.protocols import Executor
from clearway.simulation.motion import Occurrence

PERIOD = TICKS_PER_SECOND // 10


@dataclass
class _Stretch:
    """Part of a piece as it was driven: ticks of the path, and of the clock."""

    path: Trajectory
    index: int
    begin: int
    end: int
    since: int
    until: int


@dataclass
class _Mover:
    """A robot on its way: its path, and how far along it (tick of the path) it has come."""

    path: Trajectory
    rng: random.Random
    told: Pose  # where what was driven has been told up to
    pace: float = 1.0
    progress: int = 0
    credit: float = 0.0  # part of a tick driven beyond the progress
    trip: Trip | None = None
    commitment: Commitment | None = None
    waits: tuple[Wait, ...] = ()
    next_visit: int = 0
    is_served: bool = False  # whether the service of the next visit has begun
    until_stop: float = math.inf  # ticks of motion until it stops by itself
    stopped_until: int = -1
    held_by: str | None = None
    told_wait: int = -1
    driven: list[_Stretch] = field(default_factory=list)

    def stop(self) -> Stop | None:
        """Return the visit ahead in time, if there is one."""
        for stop in self.path.stops:
            if stop.visit == self.next_visit:
                return stop
        return None

    @property
    def is_over(self) -> bool:
        """Whether it has nowhere to go and nothing to do."""
        return self.progress >= self.path.end and self.stop() is None


class Disturbed:
    """Moves robots in steps of 0.1 s, under seeded disturbances and an executor's grants.

    A robot's progress is the tick of its trajectory up to which it has come, never later than
    now. One that is late drives no faster than planned but does not stand where the plan
    waits; its services last as long as planned.
    """

    def __init__(
        self,
        robots: Sequence[Robot],
        disturbances: Disturbances,
        executor: Executor,
        seed: int,
    ) -> None:
        self._disturbances, self._executor = disturbances, executor
        self._now = 0
        self._movers: dict[str, _Mover] = {}
        for robot in robots:
            rng = random.Random(f"{seed}/disturbed/{robot.id}")
            mover = _Mover(Trajectory(robot.id, robot.start), rng, robot.start)
            if rng.random() < disturbances.slow:
                mover.pace = disturbances.slowness
            self._movers[robot.id] = mover
            self._draw_stop(mover)
        standing = {id_: Commitment(id_, mover.path) for id_, mover in self._movers.items()}
        self.commit(standing, 0)

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over commitments; see `RobotMotion`."""
        self._executor.commit(commitments, now)
        for robot, commitment in commitments.items():
            mover = self._movers[robot]
            mover.commitment = commitment
            mover.path, mover.waits = commitment.trajectory, commitment.waits
            if commitment.trip is not mover.trip:
                mover.trip, mover.next_visit, mover.is_served = commitment.trip, 0, False
            self._executor.report(robot, mover.progress)

    def next_tick(self) -> int | None:
        """Return the end of the next period while anybody has somewhere to go."""
        if all(mover.is_over for mover in self._movers.values()):
            return None
        return self._now + PERIOD

    def advance(self, now: int) -> Sequence[Occurrence]:
        """Move everybody on, period by period."""
        occurred: list[Occurrence] = []
        while self._now < now:
            begin, self._now = self._now, min(self._now + PERIOD, now)
            for robot, mover in self._movers.items():
                occurred += self._move(robot, mover, begin, self._now)
            for robot, mover in self._movers.items():
                self._executor.report(robot, mover.progress)
        return sorted(occurred, key=lambda one: one.tick)

    def driven(self, robot: str, now: int) -> Trajectory:
        """Return what a robot has driven since last asked, up to now."""
        mover = self._movers[robot]
        parts, mover.driven = mover.driven, []
        start = mover.told
        pieces = []
        for number, part in enumerate(parts):
            first, last = part.path.timing[part.index]
            piece = part.path.pieces[part.index].part(
                (part.begin - first) / (last - first), (part.end - first) / (last - first)
            )
            pieces.append(replace(piece, id=number))
        if pieces:
            mover.told = pieces[-1].end
        timing = tuple((part.since, part.until) for part in parts)
        return Trajectory(robot, start, tuple(pieces), timing)

    def expected(self, now: int) -> Mapping[str, Trajectory] | None:
        """Return everybody's paths at the times to expect, by which they are driven from now on."""
        if all(m.is_over or m.progress == now for m in self._movers.values()):
            return None
        paths = self._executor.projected(now)
        retimed = {}
        for robot, path in paths.items():
            mover = self._movers[robot]
            assert mover.commitment is not None
            mover.commitment = retimed[robot] = replace(mover.commitment, trajectory=path, waits=())
            mover.path, mover.progress, mover.waits = path, now, ()
        self._executor.commit(retimed, now)
        for robot in paths:
            self._executor.report(robot, now)
        return paths

    def _draw_stop(self, mover: _Mover) -> None:
        rate = self._disturbances.stops_per_hour / 3600.0
        if rate > 0.0:
            mover.until_stop = mover.rng.expovariate(rate) * TICKS_PER_SECOND

    def _move(self, robot: str, mover: _Mover, begin: int, end: int) -> list[Occurrence]:
        """Move one robot during a period."""
        occurred: list[Occurrence] = []
        grant = self._executor.grant(robot)
        tick = begin
        while True:
            stop = mover.stop()
            if stop is not None and not mover.is_served and mover.progress >= stop.arrive:
                mover.is_served = True
                occurred.append(Occurrence(tick, robot, "arrived", stop.visit))
            if stop is not None and mover.is_served and mover.progress >= stop.leave:
                mover.next_visit, mover.is_served = stop.visit + 1, False
                occurred.append(Occurrence(tick, robot, "left", stop.visit))
                # Who decides is asked before it drives on.
                return occurred
            if tick >= end:
                return occurred
            if stop is not None and mover.is_served:
                lasts = min(stop.leave - mover.progress, end - tick)
                mover.progress += lasts
                tick += lasts
            elif (index := self._piece_at(mover)) is None:
                tick = self._stand(robot, mover, tick, end, grant, occurred)
            else:
                tick = self._drive(robot, mover, index, tick, end, grant, occurred)

    def _piece_at(self, mover: _Mover) -> int | None:
        """Return the piece on which it is, or which begins where it is."""
        timing = mover.path.timing
        index = bisect_right(timing, mover.progress, key=lambda span: span[0]) - 1
        return index if index >= 0 and mover.progress < timing[index][1] else None

    def _stand(
        self,
        robot: str,
        mover: _Mover,
        tick: int,
        end: int,
        grant: int,
        occurred: list[Occurrence],
    ) -> int:
        """Stand as planned, or go on at once where it is late; return when that is over."""
        path = mover.path
        index = bisect_right(path.timing, mover.progress, key=lambda span: span[0])
        ahead = [path.timing[index][0]] if index < len(path.timing) else []
        stop = mover.stop()
        if stop is not None:
            ahead.append(stop.arrive)
        if not ahead:
            mover.progress = end
            return end
        target = min(ahead)
        if mover.progress < tick:
            mover.progress = min(target, tick)
            if mover.progress == target:
                return tick
        if mover.told_wait != target:
            mover.told_wait = target
            wait = self._planned_wait(robot, mover, tick, target)
            occurred.append(Occurrence(tick, robot, "waits", wait=wait))
        lasts = min(target - mover.progress, end - tick)
        mover.progress += lasts
        return tick + lasts

    def _planned_wait(self, robot: str, mover: _Mover, tick: int, target: int) -> Wait:
        """Return for whom a robot stands until tick ``target`` of its path."""
        for wait in mover.waits:
            if wait.end is not None and wait.begin <= mover.progress < wait.end:
                return replace(wait, begin=tick)
        ends = [end for first, end in mover.path.timing if first == target]
        for step in self._executor.unmet(robot):
            if ends and target <= step.at < ends[0]:
                because = f"{step.other} goes first there by the plan"
                return Wait(tick, target, (step.other,), because)
        return Wait(tick, target, ("plan",), "its motion begins then by the plan")

    def _drive(
        self,
        robot: str,
        mover: _Mover,
        index: int,
        tick: int,
        end: int,
        grant: int,
        occurred: list[Occurrence],
    ) -> int:
        """Drive on as far as it may; return when that is over."""
        if mover.stopped_until >= 0:
            if mover.stopped_until > tick:
                return min(mover.stopped_until, end)
            mover.stopped_until = -1
            self._draw_stop(mover)
            occurred.append(Occurrence(tick, robot, "moves"))
        room = min(grant, mover.path.timing[index][1]) - mover.progress
        if room <= 0:
            self._hold(robot, mover, tick, occurred)
            return end
        mover.held_by = None
        reach = (end - tick) * mover.pace + mover.credit
        step = min(room, math.floor(reach))
        if mover.until_stop < step:
            step = math.ceil(mover.until_stop)
        if step <= 0:
            mover.credit = reach
            return end
        until = end if step == math.floor(reach) else tick + math.ceil(step / mover.pace)
        until = min(until, end)
        mover.credit = reach - step if step == math.floor(reach) else 0.0
        self._note(mover, index, step, tick, until)
        mover.progress += step
        mover.until_stop -= step
        if mover.until_stop <= 0.0:
            low, high = self._disturbances.stop_seconds
            mover.stopped_until = until + to_ticks(mover.rng.uniform(low, high))
            mover.until_stop = math.inf
            occurred.append(Occurrence(until, robot, "stops"))
        return until

    def _hold(self, robot: str, mover: _Mover, tick: int, occurred: list[Occurrence]) -> None:
        why = self._executor.why(robot)
        if why is None or why.other == mover.held_by:
            return
        mover.held_by = why.other
        because = f"{why.other} goes first there by the plan and has not passed yet"
        wait = Wait(tick, None, (why.other,), because)
        occurred.append(Occurrence(tick, robot, "waits", wait=wait))

    def _note(self, mover: _Mover, index: int, step: int, since: int, until: int) -> None:
        begin, end = mover.progress, mover.progress + step
        if mover.driven:
            last = mover.driven[-1]
            goes_on = last.path is mover.path and last.index == index and last.end == begin
            # Speeds are the same where both ratios are.
            even = (last.end - last.begin) * (until - since) == step * (last.until - last.since)
            if goes_on and last.until == since and even:
                last.end, last.until = end, until
                return
        mover.driven.append(_Stretch(mover.path, index, begin, end, since, until))
