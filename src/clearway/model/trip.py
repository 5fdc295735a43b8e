"""Trips: what one robot is to do next, and the motion that it is committed to."""

from dataclasses import dataclass

from clearway.model.task import Visit
from clearway.model.trajectory import Trajectory


@dataclass(frozen=True)
class Trip:
    """What one robot is to do next.

    Parameters
    ----------
    visits
        At least one, in order.
    purpose
        ``order``, or a part of one (``fetch``, ``deliver``, ``store``), or what the robot gives
        itself: ``charge``, ``park``.
    order
        Id of the order it serves, if any.
    goals
        Name of the zone of each visit; ``None`` where it is a pose only.
    rests
        Names of the zones in one of which it may rest afterwards; empty: it rests at its last
        visit, which must be out of everybody's way.
    carries
        Objects on board after the trip, such as the shelf that it has fetched; empty: what its
        visits leave there.
    """

    robot: str
    visits: tuple[Visit, ...]
    purpose: str
    order: str | None = None
    goals: tuple[str | None, ...] = ()
    rests: tuple[str, ...] = ()
    carries: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.visits:
            raise ValueError(f"a trip of {self.robot} has no visits")
        if not self.goals:
            object.__setattr__(self, "goals", (None,) * len(self.visits))


@dataclass(frozen=True)
class Wait:
    """A robot stands from tick ``begin`` to ``end`` for robots, or for a cause such as ``order``.

    ``because`` says in words why those go first.
    """

    begin: int
    end: int | None
    causes: tuple[str, ...]
    because: str = ""


@dataclass(frozen=True)
class Commitment:
    """A robot's complete motion: through its visits to a rest that nobody crosses afterwards.

    Parameters
    ----------
    trajectory
        Ticks are those of the one clock. Before its first piece the robot stands at its start,
        so what is driven may be cut off. Its stops number ``trip.visits``.
    trip
        What it does; ``None`` for a robot that only stands or goes to rest.
    rest
        Zone in which it rests in the end, where it is one.
    waits
        Standing that is no service, for whom.
    """

    robot: str
    trajectory: Trajectory
    trip: Trip | None = None
    rest: str | None = None
    waits: tuple[Wait, ...] = ()

    @property
    def served(self) -> int:
        """Tick at which the last service ends; from then on it may be planned anew."""
        return self.trajectory.stops[-1].leave if self.trajectory.stops else 0
