"""Right of way as a ledger: who has passed what, and how far each robot may go therefore.

Rules
-----
A robot may go to the largest tick of its trajectory before which all that it waits for has been
passed for sure, and at most the look-ahead further than it has come. Grants only grow, and nothing
is freed by a clock.

*Safety.* Where two robots need the same floor, one of them has a grant beyond the beginning of
the place only if the other has confirmed that it has left it. So the floor between confirmed
progress and grant (the *reserve*) of one never meets that of another. It takes only that robots
stop at or before their grants and that progress is not told too high; a report that is late, lost
or repeated makes reserves larger, never wrong.

*No deadlock.* Let commitments be complete (each ends in a rest that nobody crosses later) and
free of conflicts at their planned times. Then who comes first in the plan goes first, so a robot
that may not go beyond tick ``at`` waits for a tick ``passed <= at``. Take the unfinished robot
with the least progress ``p`` (of several, any). What holds it is at some ``at = p``, so it waits
for a tick of at most ``p``; the other has come that far, unless it has finished, and then it
has passed all of its ticks. So that robot is free to go, and all finish.

References
----------
Cap, M., Gregoire, J., Frazzoli, E. (2016). Provably safe and deadlock-free execution of
multi-robot plans under delaying disturbances. IROS. arXiv:1603.08582.

Deviations
----------
Conflicts are between stretches of both trajectories, with bodies of any shape. Robots that are
late skip planned waits, and commitments change while robots drive.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from clearway.execute.course import NEVER, Course
from clearway.execute.projection import project
from clearway.execute.resumption import Resumption, carried_over, resume
from clearway.execute.staircase import Staircase, pruned
from clearway.model import Commitment, Trajectory
from clearway.protocols import Binding, Conflicts, Precedence

Stretch = tuple[int, int]
Overlap = Callable[[Commitment, Stretch, Commitment, Stretch], bool]
Stairs = dict[str, dict[str, Staircase]]


@dataclass
class _Entry:
    """A robot's line in the ledger."""

    commitment: Commitment
    course: Course
    progress: int
    granted: int


class RightOfWay:
    """Executor that keeps the plan's order of passage under any delay.

    Parameters
    ----------
    conflicts
        Finds where two commitments need the same floor.
    look_ahead
        How far (ticks) grants reach beyond progress: at least what a robot drives before it is
        granted more, and its way to a stop. New motion must begin no sooner than this after
        the tick at which it is committed, since all before then may have been granted.
    """

    def __init__(self, conflicts: Conflicts, look_ahead: int = 2000) -> None:
        if look_ahead < 1:
            raise ValueError(f"look_ahead must be 1 tick or more, got {look_ahead}")
        self.look_ahead = look_ahead
        self._conflicts = conflicts
        self._entries: dict[str, _Entry] = {}
        self._stairs: Stairs = {}
        self._now = 0

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over new commitments; other robots keep theirs and all that is granted.

        Raises
        ------
        ValueError
            Two commitments are not free of conflicts, a motion does not go on from where its
            robot is, or it needs floor that another has been granted. Nothing has changed then.
        """
        entries = dict(self._entries)
        resumed: dict[str, Resumption] = {}
        for robot, commitment in commitments.items():
            course, known = Course(commitment.trajectory), self._entries.get(robot)
            if known is None:
                entries[robot] = _Entry(commitment, course, now, course.stands_until(now))
                continue
            if known.commitment.trajectory == commitment.trajectory:
                entries[robot] = _Entry(commitment, course, known.progress, known.granted)
                continue
            resumed[robot] = there = resume(robot, known.course, course, known.progress, now)
            # Nobody is ahead of new times, so what they put off is granted when it is time.
            granted = min(there.granted(known.granted), now + self.look_ahead)
            granted = max(granted, course.stands_until(there.progress))
            entries[robot] = _Entry(commitment, course, there.progress, granted)
        changed = [r for r in commitments if r in resumed or r not in self._entries]
        stairs = {robot: dict(others) for robot, others in self._stairs.items()}
        for one, other in _pairs(changed, entries):
            found = self._between(entries, resumed, one, other)
            for robot, against, precedences in zip((one, other), (other, one), found, strict=True):
                steps = _open_steps(precedences, entries[robot], entries[against])
                _check_granted(robot, steps, entries)
                if steps:
                    stairs.setdefault(robot, {})[against] = Staircase(steps)
                else:
                    stairs.get(robot, {}).pop(against, None)
        self._entries, self._stairs = entries, stairs
        self._now = max(self._now, now)

    def report(self, robot: str, progress: int) -> None:
        """Learn how far a robot has come for sure; what comes late or twice changes nothing.

        Raises
        ------
        ValueError
            It has gone beyond its grant.
        """
        entry = self._entries[robot]
        if progress > entry.course.stands_until(entry.granted):
            raise ValueError(
                f"robot {robot} reports tick {progress}, but was granted its motion to "
                f"{entry.granted} only; it must stop at or before its grant"
            )
        entry.progress = max(entry.progress, progress)
        self._now = max(self._now, progress)

    def grant(self, robot: str) -> int:
        """Return up to which tick of its trajectory a robot may go; it never shrinks.

        Standing takes no more floor, so a grant that ends in a wait reaches to the end of it.
        """
        entry = self._entries[robot]
        binding = self.why(robot)
        limit = self._cap(entry) if binding is None else binding.at
        # Reserves never meet: nothing has been granted that must still be waited for.
        assert binding is None or binding.at >= entry.granted, (
            f"{binding} after a grant to {entry.granted}"
        )
        entry.granted = max(entry.granted, limit)
        return entry.granted

    def why(self, robot: str) -> Binding | None:
        """Return what limits a robot's grant, if it is another robot: the first in its way."""
        cap, first = self._cap(self._entries[robot]), None
        stairs = self._stairs.get(robot, {})
        for other in list(stairs):
            step = stairs[other].first(self._entries[other].progress)
            if step is None:
                del stairs[other]
            elif step.at < cap and (first is None or (step.at, other) < first[:2]):
                first = (step.at, other, step.passed)
        return first and Binding(robot, first[1], first[0], first[2])

    def chain(self, robot: str) -> tuple[Binding, ...]:
        """Return what holds a robot, what holds that one before it has passed, and so on.

        It ends, as each is held at an earlier tick than the one before.
        """
        links: list[Binding] = []
        link = self.why(robot)
        while link is not None and (not links or link.at < links[-1].passed):
            links.append(link)
            link = self.why(link.other)
        return tuple(links)

    def reserve(self, robot: str) -> tuple[int, int]:
        """Return from which tick to which a robot's motion is its own."""
        entry = self._entries[robot]
        return entry.progress, entry.granted

    def projected(self, now: int) -> Mapping[str, Trajectory]:
        """Return everybody's paths at the times to expect if nobody is held up any more.

        Committed, they put all robots on time again; so report everybody's progress before.
        """
        courses = {robot: entry.course for robot, entry in self._entries.items()}
        progress = {r: e.course.skipped(e.progress, now) for r, e in self._entries.items()}
        unmet = {robot: self.unmet(robot) for robot in courses}
        return project(courses, progress, unmet, now)

    def unmet(self, robot: str) -> tuple[Precedence, ...]:
        """Return all that a robot still waits for, if not at once."""
        stairs, come = self._stairs.get(robot, {}), self._entries
        return tuple(s for other in stairs for s in stairs[other].unmet(come[other].progress))

    def overlapping(self, overlap: Overlap) -> tuple[tuple[str, str], ...]:
        """Return the pairs of robots whose reserves meet, which must be none; looks at all pairs.

        ``overlap`` tells whether two robots are in each other for some ticks of two stretches.
        """
        lines = sorted(self._entries.items())
        return tuple(
            (one, other)
            for (one, a), (other, b) in combinations(lines, 2)
            if overlap(a.commitment, (a.progress, a.granted), b.commitment, (b.progress, b.granted))
        )

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to."""
        return self._entries[robot].commitment

    def _cap(self, entry: _Entry) -> int:
        """Return the end of the look-ahead; to stand on takes no more floor."""
        come = entry.course.skipped(entry.progress, self._now)
        return entry.course.stands_until(come + self.look_ahead)

    def _between(
        self,
        entries: Mapping[str, _Entry],
        resumed: Mapping[str, Resumption],
        one: str,
        other: str,
    ) -> tuple[Sequence[Precedence], Sequence[Precedence]]:
        """Return what two robots wait for of each other.

        What is known is kept where both paths are as they were; only new ways are looked at.
        """
        a, b = entries[one], entries[other]
        fresh = [r for r in (one, other) if r in resumed and not resumed[r].is_retimed]
        if one in self._entries and other in self._entries and len(fresh) < 2:
            kept = self._carried_over(one, other, resumed), self._carried_over(other, one, resumed)
            if kept[0] is not None and kept[1] is not None:
                if not fresh:
                    return kept[0], kept[1]
                done = [
                    resumed[r].until if r in fresh else entries[r].progress for r in (one, other)
                ]
                found = self._conflicts(a.commitment, b.commitment, (done[0], done[1]))
                return (*kept[0], *found[0]), (*kept[1], *found[1])
        return self._conflicts(a.commitment, b.commitment, (a.progress, b.progress))

    def _carried_over(
        self, robot: str, other: str, resumed: Mapping[str, Resumption]
    ) -> tuple[Precedence, ...] | None:
        stairs = self._stairs.get(robot, {}).get(other)
        steps = stairs.unmet(self._entries[other].progress) if stairs else ()
        return carried_over(steps, resumed.get(robot), resumed.get(other))


def _open_steps(
    precedences: Iterable[Precedence], entry: _Entry, other: _Entry
) -> tuple[Precedence, ...]:
    """Return what is still to be met; in a wait, a robot may stand on."""
    return pruned(
        Precedence(entry.course.stands_until(each.at), each.other, each.passed)
        for each in precedences
        if each.passed > other.progress and entry.course.stands_until(each.at) < NEVER
    )


def _pairs(changed: Iterable[str], entries: Iterable[str]) -> Iterable[tuple[str, str]]:
    """Yield the pairs in which something has changed, each once, in a fixed order."""
    names = sorted(entries)
    new = set(changed)
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            if one in new or other in new:
                yield one, other


def _check_granted(
    robot: str, steps: tuple[Precedence, ...], entries: Mapping[str, _Entry]
) -> None:
    """Refuse precedences that come too late."""
    if steps and steps[0].at < entries[robot].granted:
        step, granted = steps[0], entries[robot].granted
        raise ValueError(
            f"robot {robot} has been granted its motion to tick {granted}, but would have to wait "
            f"at {step.at} for {step.other}; new motion must begin a look-ahead later than it "
            "is committed"
        )
