"""The joint between a simulated fleet and how its robots move along what they are committed to."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from clearway.model import Commitment, Trajectory, Wait


@dataclass(frozen=True)
class Occurrence:
    """Something that a robot does at a tick.

    ``kind``: it has ``arrived`` at visit number ``visit`` of its trip, or ``left`` it; it
    ``waits``; a stop of its own begins (``stops``) or ends (``moves``).
    """

    tick: int
    robot: str
    kind: Literal["arrived", "left", "waits", "stops", "moves"]
    visit: int = 0
    wait: Wait | None = None


class RobotMotion(Protocol):
    """Moves robots along their commitments."""

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over commitments; until ``now`` they are what is being driven already."""
        ...

    def next_tick(self) -> int | None:
        """Return when something occurs next, if anything does."""
        ...

    def advance(self, now: int) -> Sequence[Occurrence]:
        """Move everybody on to a tick; return what has occurred, in order."""
        ...

    def driven(self, robot: str, now: int) -> Trajectory:
        """Return what a robot has driven since last asked, up to now."""
        ...

    def expected(self, now: int) -> Mapping[str, Trajectory] | None:
        """Return everybody's paths at the times to expect now; ``None`` where nobody is late."""
        ...
