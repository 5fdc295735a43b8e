"""The joints of carrying commitments out when robots are late."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from clearway.model import Commitment, Trajectory


@dataclass(frozen=True)
class Precedence:
    """A robot may go on to tick ``at`` of its trajectory, no further, until another has passed.

    ``other`` must have confirmed tick ``passed`` of its own trajectory. ``at`` is never before
    ``passed``: who comes first in the plan goes first.
    """

    at: int
    other: str
    passed: int


class Conflicts(Protocol):
    """Finds where two committed motions need the same floor, whatever their times become."""

    def __call__(
        self, one: Commitment, other: Commitment, done: tuple[int, int] = (0, 0)
    ) -> tuple[Sequence[Precedence], Sequence[Precedence]]:
        """Return what ``one`` must wait for, and what ``other`` must, each by rising ``at``.

        ``done`` are the ticks of either up to which it has been driven; what lies before them
        is not looked at.
        """
        ...


@dataclass(frozen=True)
class Binding:
    """What holds a robot: it may not go beyond tick ``at`` until ``other`` passes ``passed``."""

    robot: str
    other: str
    at: int
    passed: int


class Executor(Protocol):
    """Grants robots stretches of their committed trajectories, in the plan's order of passage.

    Progress is told in ticks of the robot's own trajectory: that of a robot on time is now. Grants
    reach at most ``look_ahead`` ticks of motion beyond it, so new motion must begin no sooner than
    that after the tick at which it is committed.
    """

    look_ahead: int

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over new commitments; other robots keep theirs and all that is granted."""
        ...

    def report(self, robot: str, progress: int) -> None:
        """Learn how far a robot has come for sure; it never goes back."""
        ...

    def grant(self, robot: str) -> int:
        """Return up to which tick of its trajectory a robot may go; it never shrinks."""
        ...

    def why(self, robot: str) -> Binding | None:
        """Return what limits a robot's grant, if it is another robot."""
        ...

    def unmet(self, robot: str) -> Sequence[Precedence]:
        """Return all that a robot still waits for on its path, if not at once."""
        ...

    def projected(self, now: int) -> Mapping[str, Trajectory]:
        """Return everybody's paths at the times to expect if nobody is held up any more."""
        ...
