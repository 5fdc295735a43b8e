"""Executor for robots that are never late: all may go where their plans say, when they say so."""

from collections.abc import Mapping, Sequence

from clearway.model import Commitment, Trajectory
from clearway.protocols import Binding, Precedence


class TrackPlan:
    """Grants everybody the look-ahead; commitments keep robots apart as long as they are on time.

    Parameters
    ----------
    look_ahead
        How far (ticks) grants reach beyond progress.
    """

    def __init__(self, look_ahead: int = 2000) -> None:
        if look_ahead < 1:
            raise ValueError(f"look_ahead must be 1 tick or more, got {look_ahead}")
        self.look_ahead = look_ahead
        self._commitments: dict[str, Commitment] = {}
        self._progress: dict[str, int] = {}

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over new commitments."""
        self._commitments.update(commitments)
        for robot in commitments:
            self.report(robot, now)

    def report(self, robot: str, progress: int) -> None:
        """Learn how far a robot has come."""
        self._progress[robot] = max(progress, self._progress.get(robot, 0))

    def grant(self, robot: str) -> int:
        """Return up to which tick of its trajectory a robot may go."""
        return self._progress[robot] + self.look_ahead

    def why(self, robot: str) -> Binding | None:
        """Nobody is held by another."""
        return None

    def unmet(self, robot: str) -> Sequence[Precedence]:
        """Nobody waits for another."""
        return ()

    def projected(self, now: int) -> Mapping[str, Trajectory]:
        """Return everybody's trajectories as committed."""
        return {robot: each.trajectory for robot, each in self._commitments.items()}
