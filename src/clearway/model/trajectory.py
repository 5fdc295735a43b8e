"""Trajectories: pieces of path, their timing, and the visits made on the way."""

import math
from bisect import bisect_left, bisect_right
from dataclasses import dataclass, replace

from clearway.model.pose import Pose, wrap


@dataclass(frozen=True)
class Piece:
    """A motion of constant body-frame direction and curvature.

    Parameters
    ----------
    id
        Stable within its trajectory; a retimed trajectory keeps it.
    mode
        Name of the motion mode; ``None`` where the robot has no modes.
    start
        Pose where it begins.
    twist
        Whole body-frame displacement ``(along x, along y, turn)`` in m, m, rad, applied
        evenly: the pose at progress ``p`` is ``start`` moved by ``exp(p * twist)``.
    loaded
        Whether the robot carries a load meanwhile.
    """

    id: int
    mode: str | None
    start: Pose
    twist: tuple[float, float, float]
    loaded: bool = False

    @property
    def length(self) -> float:
        """Path length of the reference point (m)."""
        return math.hypot(self.twist[0], self.twist[1])

    def at(self, progress: float) -> Pose:
        """Return the pose at ``progress`` in [0, 1]."""
        a, b, c = (progress * value for value in self.twist)
        if abs(c) < 1e-9:
            local = Pose(a - 0.5 * b * c, b + 0.5 * a * c, c)
        else:
            s, v = math.sin(c) / c, (1.0 - math.cos(c)) / c
            local = Pose(a * s - b * v, a * v + b * s, c)
        return self.start.compose(local)

    @property
    def end(self) -> Pose:
        """Pose where it ends."""
        return self.at(1.0)

    def part(self, begin: float, end: float) -> "Piece":
        """Return what lies between two progresses in [0, 1]; it keeps id and mode."""
        if (begin, end) == (0.0, 1.0):
            return self
        a, b, c = self.twist
        share = end - begin
        return replace(self, start=self.at(begin), twist=(share * a, share * b, share * c))

    def heading_at(self, progress: float) -> float:
        """Return the heading (rad) at ``progress``."""
        return wrap(self.start.theta + progress * self.twist[2])


@dataclass(frozen=True)
class Stop:
    """A visit in time: index into the robot's visits, ticks at which its service begins and ends.

    A robot that comes before it may be served waits until ``arrive``.
    """

    visit: int
    arrive: int
    leave: int

    def __post_init__(self) -> None:
        if self.leave < self.arrive:
            raise ValueError(f"visit {self.visit} ends before it begins")


@dataclass(frozen=True)
class Trajectory:
    """One robot's motion from its start to its final rest.

    Parameters
    ----------
    start
        Pose at tick 0.
    pieces
        Path in order; each begins where the one before ended.
    timing
        ``(first tick, last tick)`` of each piece; between pieces the robot stands.
    stops
        Visits made, in order.
    """

    robot: str
    start: Pose
    pieces: tuple[Piece, ...] = ()
    timing: tuple[tuple[int, int], ...] = ()
    stops: tuple[Stop, ...] = ()

    def __post_init__(self) -> None:
        if len(self.pieces) != len(self.timing):
            raise ValueError(f"trajectory of {self.robot}: one timing per piece is needed")
        last = 0
        for first, end in self.timing:
            if first < last or end <= first:
                raise ValueError(f"trajectory of {self.robot}: pieces overlap in time")
            last = end

    @property
    def end(self) -> int:
        """Tick at which the final rest begins."""
        return self.timing[-1][1] if self.timing else 0

    @property
    def final_pose(self) -> Pose:
        """Pose of the final rest."""
        return self.pieces[-1].end if self.pieces else self.start

    @property
    def distance(self) -> float:
        """Length driven (m)."""
        return sum(piece.length for piece in self.pieces)

    def at(self, tick: int) -> Pose:
        """Return the pose at a tick."""
        index = bisect_right(self.timing, tick, key=lambda span: span[0]) - 1
        if index < 0:
            return self.start
        piece, (first, end) = self.pieces[index], self.timing[index]
        return piece.at(min(1.0, (tick - first) / (end - first)))

    def part(self, begin: int, end: int) -> "Trajectory":
        """Return what happens between two ticks, without its stops; pieces are cut there."""
        low = bisect_right(self.timing, begin, key=lambda span: span[1])
        high = bisect_left(self.timing, end, key=lambda span: span[0]) if end > begin else low
        pieces, timing = [], []
        for piece, (first, last) in zip(self.pieces[low:high], self.timing[low:high], strict=True):
            since, until = max(first, begin), min(last, end)
            lasts = last - first
            pieces.append(piece.part((since - first) / lasts, (until - first) / lasts))
            timing.append((since, until))
        return Trajectory(self.robot, self._about_to(begin), tuple(pieces), tuple(timing))

    def _about_to(self, tick: int) -> Pose:
        """Return the pose right before a tick: headings may jump at it."""
        index = bisect_left(self.timing, tick, key=lambda span: span[0]) - 1
        if index < 0:
            return self.start
        piece, (first, end) = self.pieces[index], self.timing[index]
        return piece.at(min(1.0, (tick - first) / (end - first)))
