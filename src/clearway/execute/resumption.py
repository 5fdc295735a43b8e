"""How far a robot has come on the new motion that replaces the one it was on."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from dataclasses import dataclass

from clearway.execute.course import Course, Stretch
from clearway.model import Pose, wrap
from clearway.protocols import Precedence

# Poses this near (m, rad) are the same.
NEAR = 1e-6


@dataclass(frozen=True)
class Resumption:
    """A robot's place on a new course, and what of the old one goes on there.

    Parameters
    ----------
    was, progress
        Its tick on the old course and on the new one.
    pairs
        Stretches other than waits, from there on, that both courses have in common.
    is_retimed
        Whether these are all: the new course is the rest of the old one, if at other times.
    """

    was: int
    progress: int
    pairs: tuple[tuple[Stretch, Stretch], ...]
    is_retimed: bool

    @property
    def until(self) -> int:
        """Tick on the new course at which what is common ends."""
        return self.pairs[-1][1].end if self.pairs else self.progress

    def granted(self, tick: int) -> int:
        """Return how much of what was granted on the old course holds on the new one."""
        held = self.progress
        for old, new in self.pairs:
            if tick <= old.begin:
                break
            held = max(held, new.end - max(0, old.end - tick))
        return held

    def at(self, tick: int) -> int | None:
        """Return the new tick for one up to which the robot may go: in a wait, the end of it."""
        k = bisect_right(self.pairs, tick, key=_old_end)
        if k == len(self.pairs):
            return None
        old, new = self.pairs[k]
        return max(self.progress, new.end - (old.end - max(tick, old.begin)))

    def passed(self, tick: int) -> int:
        """Return the new tick for one that the robot will have passed: in a wait, its begin.

        While it waits the robot is in nobody's way but from where it came to stand, so whoever
        is in conflict with it there waits for the end of the wait. All that is not common any
        more is passed where what is common ends.
        """
        k = bisect_left(self.pairs, tick, key=_old_end)
        after = self.pairs[k - 1][1].end if k > 0 else self.progress
        if k == len(self.pairs) or tick <= self.pairs[k][0].begin:
            return after
        old, new = self.pairs[k]
        return max(after, new.end - (old.end - tick))


def carried_over(
    steps: Iterable[Precedence], mine: Resumption | None, its: Resumption | None
) -> tuple[Precedence, ...] | None:
    """Return what a robot waits for in new ticks, as far as both paths are what they were.

    ``None`` where the new times do not keep the order of passage.

    Parameters
    ----------
    mine, its
        Of the robot that waits and of the other; ``None`` for one whose motion is as it was.
    """
    kept = []
    for step in steps:
        at = mine.at(step.at) if mine else step.at
        if at is None and mine and not mine.is_retimed:
            continue
        passed = its.passed(step.passed) if its else step.passed
        if at is None or passed > at:
            return None
        kept.append(Precedence(at, step.other, passed))
    return tuple(kept)


def resume(robot: str, old: Course, new: Course, progress: int, now: int) -> Resumption:
    """Find a robot, at tick ``progress`` of its old course, on the new one.

    Where what it does next keeps its time, its progress stays; else the new course has been
    retimed, and the robot is on time there.

    Raises
    ------
    ValueError
        The new course is not where the robot is.
    """
    before, after = _busy(old, progress), _busy(new, progress)
    keeps = bool(before and after) and _times(before[0]) == _times(after[0])
    tick = progress if keeps else max(progress, now)
    here, there = old.pose(progress), new.pose(tick)
    # Headings may jump at the beginning of a piece: either side of the jump will do.
    if not any(
        _alike(a, b)
        for a in (here, old.pose_before(progress))
        for b in (there, new.pose_before(tick))
    ):
        raise ValueError(
            f"robot {robot} has come to ({here.x:.3f}, {here.y:.3f}), tick {progress} of its "
            f"motion, but its new one is at ({there.x:.3f}, {there.y:.3f}) at tick {tick}; commit "
            "it to a motion that goes on from where it is"
        )
    after = _busy(new, tick)
    pairs = []
    for one, other in zip(before, after, strict=False):
        if not _same(one, other, progress, tick):
            break
        pairs.append((one, other))
    return Resumption(progress, tick, tuple(pairs), len(before) == len(after) == len(pairs))


def _busy(course: Course, tick: int) -> list[Stretch]:
    """Return what a robot still does from a tick on, waits left out."""
    return [each for each in course.stretches[course.index(tick) :] if not each.is_wait]


def _old_end(pair: tuple[Stretch, Stretch]) -> int:
    return pair[0].end


def _times(stretch: Stretch) -> tuple[int, int]:
    return stretch.begin, stretch.end


def _alike(a: Pose, b: Pose) -> bool:
    return a.distance(b) <= NEAR and abs(wrap(a.theta - b.theta)) <= NEAR


def _same(old: Stretch, new: Stretch, was: int, tick: int) -> bool:
    """Whether two stretches end likewise and have equally much left."""
    left_old, left_new = old.end - max(old.begin, was), new.end - max(new.begin, tick)
    if left_old != left_new or old.visit != new.visit:
        return False
    if old.piece is None or new.piece is None:
        return old.piece is new.piece
    shares = (left_old / old.duration, left_new / new.duration)
    ways = zip(old.piece.twist, new.piece.twist, strict=True)
    return (
        _alike(old.piece.end, new.piece.end)
        and all(abs(shares[0] * a - shares[1] * b) <= NEAR for a, b in ways)
        and old.piece.loaded == new.piece.loaded
    )
