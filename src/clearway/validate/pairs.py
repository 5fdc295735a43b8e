"""Bodies against bodies."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from clearway.model import Robot, RobotType
from clearway.validate.overlap import Encounters, overlaps
from clearway.validate.shapes import Part, footprint_parts
from clearway.validate.steps import Bools, Floats, Steps
from clearway.validate.sweep import Side, overlapping
from clearway.validate.violation import Violation

# Length of the windows (s) in which two robots are first compared as boxes.
WINDOW = 1.0
MOST_WINDOWS = 10_000


class Mover(NamedTuple):
    """A robot with its motion and its body, empty and loaded."""

    robot: Robot
    steps: Steps
    bodies: tuple[tuple[Part, ...], tuple[Part, ...]]

    @classmethod
    def of(cls, robot: Robot, kind: RobotType, steps: Steps) -> "Mover":
        """Return the mover of a robot of type ``kind``."""
        bodies = (footprint_parts(kind.shape(False)), footprint_parts(kind.shape(True)))
        return cls(robot, steps, bodies)

    def reach(self, steps: Steps) -> Floats:
        """Return how far the body reaches in each of ``steps`` (m)."""
        empty, loaded = (max(part.reach for part in body) for body in self.bodies)
        return steps.where_loaded(loaded, empty)


class Meeting(NamedTuple):
    """Two movers over common steps in which they may be near each other."""

    one: Mover
    other: Mover
    a: Steps
    b: Steps

    def sides(self) -> Iterator[tuple[Bools, Side, Side]]:
        """Yield pairs of parts, with the steps in which both are carried."""
        for loaded_a, body_a in enumerate(self.one.bodies):
            for loaded_b, body_b in enumerate(self.other.bodies):
                chosen = (self.a.loaded == bool(loaded_a)) & (self.b.loaded == bool(loaded_b))
                if not chosen.any():
                    continue
                a, b = self.a.pick(chosen), self.b.pick(chosen)
                for part_a in body_a:
                    for part_b in body_b:
                        yield chosen, Side.moving(part_a, a), Side.moving(part_b, b)

    @property
    def least_reference_gap(self) -> Floats:
        """Lower bound on the bodies' gap in each step (m), from circles about the references."""
        offset = self.b.pose[:, :2] - self.a.pose[:, :2]
        change = self.b.change[:, :2] - self.a.change[:, :2]
        square = (change**2).sum(axis=1)
        nearest = -(offset * change).sum(axis=1) / np.where(square > 0.0, square, 1.0)
        closest = offset + np.clip(nearest, 0.0, 1.0)[:, None] * change
        distance = np.hypot(closest[:, 0], closest[:, 1])
        return np.asarray(distance - self.one.reach(self.a) - self.other.reach(self.b))

    def pick(self, index: Bools) -> "Meeting":
        """Return some of the steps."""
        return self._replace(a=self.a.pick(index), b=self.b.pick(index))


class Timetable:
    """All movers' motions until a common end, with the boxes they fill window by window."""

    def __init__(self, movers: list[Mover], until: float) -> None:
        self.movers = movers
        count = int(np.clip(np.ceil(until / WINDOW), 1, MOST_WINDOWS))
        self._edges = np.linspace(0.0, until, count + 1)
        self._steps = [mover.steps.cut(self._edges) for mover in movers]
        self._steps = [steps.pick(steps.t1 <= until + 1e-12) for steps in self._steps]
        boxes = [self._boxes(m, s) for m, s in zip(movers, self._steps, strict=True)]
        self._low = np.array([low for low, _ in boxes]).reshape(len(movers), -1, 2)
        self._high = np.array([high for _, high in boxes]).reshape(len(movers), -1, 2)

    def _window(self, steps: Steps) -> "np.ndarray[tuple[int], np.dtype[np.intp]]":
        middle = 0.5 * (steps.t0 + steps.t1)
        return np.searchsorted(self._edges, middle, side="right") - 1

    def _boxes(self, mover: Mover, steps: Steps) -> tuple[Floats, Floats]:
        first = np.flatnonzero(np.diff(self._window(steps), prepend=-1))
        ends = np.stack([steps.pose[:, :2], steps.pose[:, :2] + steps.change[:, :2]])
        reach = mover.reach(steps)[:, None]
        low = np.minimum.reduceat(ends.min(axis=0) - reach, first)
        return low, np.maximum.reduceat(ends.max(axis=0) + reach, first)

    def box_gaps(self, one: int, other: int) -> Floats:
        """Return lower bounds on the gap of two movers in each window (m)."""
        apart = np.maximum(self._low[one] - self._high[other], self._low[other] - self._high[one])
        return np.asarray(apart.max(axis=1))

    def near(self, one: int) -> Iterator[tuple[int, Bools]]:
        """Yield later movers that may touch this one, with the windows in which they may."""
        low, high = self._low[one + 1 :], self._high[one + 1 :]
        apart = np.maximum(self._low[one] - high, low - self._high[one])
        touching = (apart[..., 0] <= 0.0) & (apart[..., 1] <= 0.0)
        for other in np.flatnonzero(touching.any(axis=1)):
            yield one + 1 + int(other), touching[other]

    def meeting(self, one: int, other: int, windows: Bools) -> Meeting:
        """Return two movers over the steps of some windows, cut at the ends of both."""
        times = []
        for steps in (self._steps[one], self._steps[other]):
            chosen = windows[self._window(steps)]
            times += [steps.t0[chosen], steps.t1[chosen]]
        grid = np.unique(np.concatenate(times))
        middle = 0.5 * (grid[:-1] + grid[1:])
        inside = windows[np.searchsorted(self._edges, middle, side="right") - 1]
        low, high = grid[:-1][inside], grid[1:][inside]
        return Meeting(
            self.movers[one],
            self.movers[other],
            self._steps[one].over(low, high),
            self._steps[other].over(low, high),
        )


def judge_pairs(movers: list[Mover], until: float, tolerance: float) -> list[Violation]:
    """Return where bodies overlap by more than ``tolerance`` (m) before ``until`` (s)."""
    if until <= 0.0 or len(movers) < 2:
        return []
    timetable = Timetable(movers, until)
    violations: list[Violation] = []
    for one in range(len(movers)):
        for other, windows in timetable.near(one):
            meeting = timetable.meeting(one, other, windows)
            near = meeting.pick(meeting.least_reference_gap <= 0.0)
            violations += _conflicts(near, tolerance)
    return violations


def _conflicts(meeting: Meeting, tolerance: float) -> list[Violation]:
    found = []
    for chosen, a, b in meeting.sides():
        deep = overlapping(a, b, np.full(len(a.radius), tolerance))
        if deep.any():
            steps = meeting.a.pick(chosen).pick(deep)
            owner = np.zeros(int(deep.sum()), dtype=np.intp)
            found.append(Encounters(owner, steps, a.pick(deep), b.pick(deep)))
    names = (meeting.one.robot.id, meeting.other.robot.id)
    return [
        Violation(
            "conflict",
            names,
            worst.time,
            worst.place,
            worst.depth,
            f"the bodies overlap by {worst.depth * 1e3:.1f} mm, more than {tolerance * 1e3:.0f} mm",
        )
        for _, _, worst in overlaps(found)
    ]
