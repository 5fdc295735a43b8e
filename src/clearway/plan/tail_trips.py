"""Always-complete planning for true shapes: a new trip replaces the tail of a motion to a bay."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from clearway import _core
from clearway.model import Commitment, Obstacle, Pose, Scenario, Trajectory, Trip, to_ticks
from clearway.plan.cut import Kept
from clearway.plan.detour import Detour
from clearway.plan.named_waits import retimed_waits
from clearway.plan.tail_fleet import TailFleet
from clearway.protocols import Refusal

TailParams = _core.TailParams
LONE_LIMIT = 400_000  # expansions of a search with nobody else on the site


@dataclass(frozen=True)
class TailTripsParams:
    """Effort of `TailTrips`.

    Parameters
    ----------
    search_limit
        Expansions of one search at effort 1; more finds more and costs more where there is
        nothing to find.
    most_rests
        Free bays that a tail may end in, the nearest to its last visit; more find more, and each
        estimate takes longer.
    patience
        Seconds after its first refusal from which on a robot that finds no way waits in its bay
        until all are at rest, which is sure to work; longer finds sooner ways more often.
    core
        Parameters of the search.
    """

    search_limit: int = 2000
    most_rests: int = 3
    patience: float = 60.0
    core: _core.TailParams = field(default_factory=_core.TailParams)

    def __post_init__(self) -> None:
        if not self.patience >= 0.0:
            raise ValueError(f"patience must be 0 or above, got {self.patience}")
        for name in ("search_limit", "most_rests"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be 1 or more, got {getattr(self, name)}")


class TailTrips:
    """Keeps everybody's committed motion: through visits to a bay that nobody crosses afterwards.

    A trip is planned from a point of the robot's own motion, against all others' motions as
    moving obstacles; found, it replaces the tail in one step, else nothing changes. So all can
    drive to rest at any time, and with all at rest each trip is a search alone.

    Parameters
    ----------
    scenario
        Robots begin at their starts. One whose start is no bay is led to a free one at once; where
        there is none it rests where it stands.

    References
    ----------
    Čáp, M., Vokřínek, J., Kleiner, A. (2015). Complete decentralized method for on-line
    multi-robot trajectory planning in well-formed infrastructures. ICAPS (the idea that every
    robot's plan ends where it is in nobody's way).

    Deviations
    ----------
    A plan ends in any free bay, not at the next goal; motions are those of true shapes.
    """

    def __init__(self, scenario: Scenario, params: TailTripsParams | None = None) -> None:
        self.params = params or TailTripsParams()
        self._fleet = TailFleet(scenario, self.params.core, self.params.most_rests)
        self._counters: Counter[str] = Counter()
        self._refused: dict[str, int] = {}  # since when
        self._park()

    @property
    def changed(self) -> Sequence[Commitment]:
        """What the last `plan` has changed of others: nothing."""
        return ()

    @property
    def counters(self) -> Mapping[str, int]:
        """Expansions, searches, those that found nothing, and tails that wait for all to rest."""
        return self._counters

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        """Commit a robot to a trip; see `clearway.protocols.TripPlanner`."""
        fleet, robot = self._fleet, trip.robot
        old = fleet.commitments[robot]
        rests = fleet.free(trip.rests, robot, trip.visits[-1].pose)
        if trip.rests and not rests:
            return Refusal("no bay is free", fleet.holders(trip.rests))
        barred = fleet.barred(robot, trip.visits)
        if barred is not None:
            at = f"({barred.pose.x:.1f}, {barred.pose.y:.1f})"
            return Refusal(f"an obstacle stands at its visit at {at}", ("obstacle",), for_good=True)
        kept = fleet.cut(robot, now, max(now + lead, old.served))
        query = fleet.query(robot, now, kept, trip.visits, rests)
        query.limit = self.params.search_limit * effort
        tail = self._search(query)
        spent = tail.expansions
        if not tail.found and tail.exhausted and self._is_closed(query):
            reason = "even with nobody else on the site no way leads through its visits to a bay"
            return Refusal(reason, for_good=True, expansions=spent)
        waited = now - self._refused.setdefault(robot, now)
        if not tail.found and waited >= to_ticks(self.params.patience):
            # With all at rest, the way from its bay and back is as good as alone.
            all_rest = max(fleet.core.settled(i) for i in range(len(fleet.ids)))
            kept = fleet.cut(robot, now, max(now + lead, all_rest))
            query = fleet.query(robot, now, kept, trip.visits, rests)
            query.limit = LONE_LIMIT
            tail = self._search(query)
            spent += tail.expansions
            self._counters["last_resorts"] += tail.found
        if not tail.found:
            causes = tuple(fleet.ids[i] for i in tail.met)
            return Refusal(f"no way found in {spent} expansions", causes, expansions=spent)
        del self._refused[robot]
        return fleet.commit(robot, kept, tail, rests, trip)

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to."""
        return self._fleet.commitments[robot]

    def lone(self, trip: Trip, pose: Pose) -> int | None:
        """Return how many ticks a trip's visits take from a pose with nobody else on the site.

        ``None`` where no way is found.
        """
        query = self._fleet.query(trip.robot, 0, Kept((), (), pose, None, 0), trip.visits, ())
        query.limit = LONE_LIMIT
        tail = self._fleet.core.alone(query)
        return int(tail.stops[-1].leave) if tail.found else None

    def retime(self, trajectories: Mapping[str, Trajectory], now: int) -> None:
        """Take over the same paths at other times."""
        fleet = self._fleet
        for robot, trajectory in trajectories.items():
            old = fleet.commitments[robot]
            waits = retimed_waits(old, trajectory)
            fleet.commitments[robot] = Commitment(robot, trajectory, old.trip, old.rest, waits)
            fleet.place(robot, now)

    def block(self, obstacle: Obstacle, now: int, lead: int = 0) -> tuple[str, ...]:
        """Learn of an obstacle; see `clearway.protocols.TripPlanner`."""
        detour = Detour(self._fleet, self._search, self.params.search_limit, now)
        return detour.around(obstacle)

    def _search(self, query: _core.TailQuery) -> _core.Tail:
        tail = self._fleet.core.plan(query)
        self._counters["expansions"] += tail.expansions
        self._counters["searches"] += 1
        self._counters["refused"] += not tail.found
        return tail

    def _is_closed(self, query: _core.TailQuery) -> bool:
        """Whether a trip is impossible with nobody else on the site."""
        query.limit = LONE_LIMIT
        alone = self._fleet.core.alone(query)
        self._counters["expansions"] += alone.expansions
        return bool(alone.exhausted)

    def _park(self) -> None:
        """Lead robots that stand in no bay to one, as long as one of them finds a way."""
        left = [robot for robot, held in self._fleet.commitments.items() if held.rest is None]
        while left:
            stuck = [robot for robot in left if not self._park_one(robot)]
            if len(stuck) == len(left):
                return
            left = stuck

    def _park_one(self, robot: str) -> bool:
        fleet = self._fleet
        kept = fleet.cut(robot, 0, 0)
        rests = fleet.free(fleet.bays, robot, kept.pose)
        if not rests:
            return False
        query = fleet.query(robot, 0, kept, (), rests)
        query.limit = self.params.search_limit
        tail = self._search(query)
        if tail.found:
            fleet.commit(robot, kept, tail, rests, None)
        return bool(tail.found)
