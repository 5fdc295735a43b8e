"""The joints of planning for ever: who does what next, how it gets there, what a fleet tells."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from clearway.model import Commitment, Obstacle, Order, Pose, Trajectory, Trip


@dataclass(frozen=True)
class Refusal:
    """No trip now: why, and the robots (or causes such as ``charger:c3``) that stand against it.

    ``for_good``: it never becomes possible. ``stranded``: nor does any other trip of the robot.
    """

    reason: str
    causes: tuple[str, ...] = ()
    for_good: bool = False
    expansions: int = 0
    stranded: bool = False


class TripPlanner(Protocol):
    """Keeps everybody's committed motion and adds to it, one trip at a time.

    All commitments together are free of conflicts for ever, before and after each call: every
    one ends in a rest that no other crosses later (see "Planning for ever" in docs/design.md).
    """

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        """Commit the robot to a trip, or change nothing and say why not.

        Parameters
        ----------
        now
            Tick; what was driven before may be forgotten.
        effort
            Multiplies the planner's own limit on expansions: larger for trips that were refused
            before.
        lead
            Its motion is planned anew from the first moment, so many ticks from now or later, at
            which its services are done and a new motion may begin.
        """
        ...

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to; standing at its start before its first trip."""
        ...

    @property
    def changed(self) -> Sequence[Commitment]:
        """What the last `plan` has changed of other robots' commitments: times only."""
        ...

    @property
    def counters(self) -> Mapping[str, int]:
        """What planning has come to so far: ``expansions``, and what else the planner counts."""
        ...

    def retime(self, trajectories: Mapping[str, Trajectory], now: int) -> None:
        """Take over the same paths at other times, after delays; all robots' at once."""
        ...

    def block(self, obstacle: Obstacle, now: int, lead: int = 0) -> tuple[str, ...]:
        """Learn of an obstacle at tick ``now``; return the robots whose motion runs into it.

        Each of those is committed anew to what can be kept of its trip, from its motion; the
        others are left alone.
        """
        ...


@dataclass(frozen=True)
class RobotView:
    """What a dispatcher may know of a robot.

    Parameters
    ----------
    trip
        The one that it is on; ``None`` once its last service has ended (and at first).
    ready
        Tick from which it may set out on another trip.
    pose, place
        Where it is then, or where its last trip ended: a pose, and the zone if it is one.
    carries
        Objects on board.
    energy
        Level in [0, 1] when last told.
    idle_since
        Tick since which it has had no trip.
    """

    id: str
    type: str
    pose: Pose
    place: str | None = None
    trip: Trip | None = None
    ready: int = 0
    carries: tuple[str, ...] = ()
    energy: float = 1.0
    idle_since: int = 0

    @property
    def is_idle(self) -> bool:
        """Whether it has no trip."""
        return self.trip is None


@dataclass(frozen=True)
class TripEnded:
    """A robot's last service of a trip has ended."""

    robot: str
    trip: Trip


@dataclass
class Board:
    """What is known at one moment: robots, open orders, and what has changed since the last.

    ``open`` holds orders by id in the order of their arrival, each until a trip that serves it
    ends it. ``taken`` tells whose order is whose, ``refusals`` how often in a row a trip that
    begins an order has been refused. ``barred`` tells the zones that a robot can never drive to,
    ``stranded`` the robots that can never drive again, both as trips were refused for good.
    """

    now: int
    robots: dict[str, RobotView]
    open: dict[str, Order] = field(default_factory=dict)
    taken: dict[str, str] = field(default_factory=dict)
    refusals: dict[str, int] = field(default_factory=dict)
    barred: dict[str, set[str]] = field(default_factory=dict)
    stranded: set[str] = field(default_factory=set)
    arrived: tuple[str, ...] = ()
    ended: tuple[TripEnded, ...] = ()


@dataclass(frozen=True)
class Alternative:
    """What else could have been chosen, and what it would have cost (smaller is better)."""

    name: str
    score: float


@dataclass(frozen=True)
class Choice:
    """A trip that a dispatcher wants, and what it weighed.

    ``kind`` says what was chosen among ``alternatives``: ``robot``, ``order``, ``station``,
    ``location``, ``charger``, ``bay``; ``chosen`` is the name and ``score`` the cost of what was.
    ``completes`` tells whether the order is done when the trip ends; ``elsewhere``, whether
    another robot or goal is tried if it is refused for good: else its order fails.
    """

    trip: Trip
    kind: str
    chosen: str
    score: float
    alternatives: tuple[Alternative, ...] = ()
    completes: bool = True
    because: str = ""
    elsewhere: bool = False


class Dispatcher(Protocol):
    """Says what idle robots do next. Made anew for each run, so it may remember."""

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield wanted trips one by one.

        Each is tried before the next one is asked for: when the iterator goes on,
        ``board.robots[id].trip is choice.trip`` tells whether the robot is committed to it.
        One that was refused may be yielded again next time.
        """
        ...


@dataclass(frozen=True)
class Observation:
    """What a fleet tells: the tick, and what has happened since it was last asked.

    Parameters
    ----------
    arrived
        New orders.
    served
        Robots whose last service has ended.
    energy
        Levels that have changed.
    found
        Obstacles nobody knew of.
    trajectories
        Where robots are behind their committed times, what they will do if nothing else holds
        them up: everybody's same paths at new times. ``None``: nobody is late.
    """

    now: int
    arrived: tuple[Order, ...] = ()
    served: tuple[str, ...] = ()
    energy: Mapping[str, float] = field(default_factory=dict)
    found: tuple[Obstacle, ...] = ()
    trajectories: Mapping[str, Trajectory] | None = None


@dataclass(frozen=True)
class Told:
    """A choice with its outcome, for the trace and for ``clearway explain``."""

    choice: Choice
    outcome: Commitment | Refusal
    cpu_s: float = 0.0


@dataclass(frozen=True)
class Decision:
    """New commitments, why, and when to ask again at the latest (tick).

    Parameters
    ----------
    done, failed
        Orders; those that failed with the reason.
    diverted
        Robots that an obstacle stood in the way of.
    given_back
        Orders that those could not go on with: they are open again.
    """

    commitments: Mapping[str, Commitment] = field(default_factory=dict)
    told: Sequence[Told] = ()
    done: Sequence[str] = ()
    failed: Mapping[str, str] = field(default_factory=dict)
    diverted: Sequence[str] = ()
    given_back: Sequence[str] = ()
    wake: int | None = None


class Fleet(Protocol):
    """Robots that can be observed and told what to do, simulated or real."""

    def observe(self) -> Observation | None:
        """Return what has happened; ``None`` when it is over."""
        ...

    def execute(self, decision: Decision) -> None:
        """Carry a decision out."""
        ...
