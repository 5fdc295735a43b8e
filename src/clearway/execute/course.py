"""A committed trajectory looked up by tick: what a robot does when, and where it is."""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass

from clearway.model import Piece, Pose, Trajectory

# Later than any tick.
NEVER = 1 << 30


@dataclass(frozen=True)
class Stretch:
    """From tick ``begin`` to ``end`` a robot drives a piece, serves a visit, or else waits."""

    begin: int
    end: int
    piece: Piece | None = None
    visit: int | None = None

    @property
    def is_wait(self) -> bool:
        """Whether it may be skipped by a robot that is late."""
        return self.piece is None and self.visit is None

    @property
    def duration(self) -> int:
        """Ticks that it takes."""
        return self.end - self.begin


class Course:
    """A trajectory as stretches without a gap, the last one its final rest."""

    def __init__(self, trajectory: Trajectory) -> None:
        self.trajectory = trajectory
        busy = [
            Stretch(begin, end, piece=piece)
            for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True)
        ]
        busy += [Stretch(stop.arrive, stop.leave, visit=stop.visit) for stop in trajectory.stops]
        busy.sort(key=lambda stretch: (stretch.end, stretch.begin))
        stretches: list[Stretch] = []
        tick = 0
        for stretch in busy:
            if stretch.begin > tick:
                stretches.append(Stretch(tick, stretch.begin))
            stretches.append(stretch)
            tick = max(tick, stretch.end)
        self.stretches = (*stretches, Stretch(tick, NEVER))
        self._ends = [stretch.end for stretch in self.stretches]

    def index(self, tick: int) -> int:
        """Return the number of the stretch that goes on at a tick; at a border the later one."""
        return min(bisect_right(self._ends, tick), len(self._ends) - 1)

    def pose(self, tick: int) -> Pose:
        """Return where the robot is when it has come to a tick."""
        return self._pose(self.index(tick), tick)

    def pose_before(self, tick: int) -> Pose:
        """Return where it is when it is about to come to a tick."""
        index = bisect_left(self._ends, tick)
        if self.stretches[index].begin >= tick:
            index -= 1
        return self._pose(index, tick)

    def _pose(self, index: int, tick: int) -> Pose:
        trajectory = self.trajectory
        for k in range(index, -1, -1):
            stretch = self.stretches[k]
            if stretch.piece is not None:
                share = (min(tick, stretch.end) - stretch.begin) / stretch.duration
                return stretch.piece.at(share) if share < 1.0 else stretch.piece.end
        return trajectory.start

    def stands_until(self, tick: int) -> int:
        """Return until when a robot at a tick neither moves nor ends a service."""
        stretch = self.stretches[self.index(tick)]
        if stretch.piece is not None:
            return tick
        if stretch.visit is not None:
            return stretch.end
        following = self.stretches[self.index(stretch.end)]
        return following.end if following.visit is not None else stretch.end

    def skipped(self, tick: int, now: int) -> int:
        """Return how far a late robot has come that does not wait for the time of its plan.

        Services last as long as planned, and nobody gets ahead of the plan.
        """
        stretch = self.stretches[self.index(tick)]
        return max(tick, min(now, stretch.end)) if stretch.is_wait else tick
