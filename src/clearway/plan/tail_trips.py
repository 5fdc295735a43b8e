"""Always-complete planning for true shapes: a new trip replaces the tail of a motion to a bay."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from clearway import _core
from clearway.model import (
    LOAD_CHANGE,
    Commitment,
    Obstacle,
    Pose,
    Robot,
    Scenario,
    Stop,
    Trajectory,
    Trip,
    Visit,
    Zone,
)
from clearway.plan.cut import Kept, cut
from clearway.plan.named_waits import named_waits, retimed_waits
from clearway.plan.native_type import NativeType
from clearway.protocols import Refusal

TailParams = _core.TailParams
LONE_LIMIT = 400_000  # expansions of a search with nobody else on the site
SAME_PLACE = 1e-6  # poses nearer than that are the same (m)


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
    last_resort
        Effort from which on a trip that finds no way waits in its bay until all are at rest.
    core
        Parameters of the search.
    """

    search_limit: int = 4000
    most_rests: int = 3
    last_resort: int = 8
    core: _core.TailParams = field(default_factory=_core.TailParams)

    def __post_init__(self) -> None:
        for name in ("search_limit", "most_rests", "last_resort"):
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
        self._robots: dict[str, Robot] = {robot.id: robot for robot in scenario.robots}
        self._numbers = {name: i for i, name in enumerate(self._robots)}
        self._ids = tuple(self._robots)
        used = [n for n in scenario.robot_types if any(r.type == n for r in scenario.robots)]
        types = [scenario.robot_types[name] for name in used]
        reach = max(kind.shape(loaded).circumradius for kind in types for loaded in (False, True))
        self._types = {
            kind.name: NativeType(i, kind, scenario.site, reach) for i, kind in enumerate(types)
        }
        self._site = scenario.site
        self._zones: dict[str, Zone] = {zone.name: zone for zone in scenario.site.zones}
        self._core = _core.TailPlanner(
            [kind.model for kind in self._types.values()],
            [self._type(name).index for name in self._robots],
            self.params.core,
        )
        self._loads = dict.fromkeys(self._robots, 0)  # before its committed trip
        self._commitments: dict[str, Commitment] = {}
        for robot in scenario.robots:
            standing = Trajectory(robot.id, robot.start)
            bay = next((z.name for z in self._bays() if _is_at(z, robot.start)), None)
            self._commitments[robot.id] = Commitment(robot.id, standing, rest=bay)
            body = self._type(robot.id).body(0)
            self._core.place(self._numbers[robot.id], 0, _core.Pose(*robot.start), [], body)
        self._park()

    def plan(self, trip: Trip, now: int, effort: int = 1) -> Commitment | Refusal:
        """Commit a robot to a trip; see `clearway.protocols.TripPlanner`."""
        old = self._commitments[trip.robot]
        rests = self._free(trip.rests, trip.robot, trip.visits[-1].pose)
        if trip.rests and not rests:
            return Refusal("all bays are taken", self._holders(trip.rests))
        kept = self._cut(trip.robot, now, max(now, old.served))
        query = self._query(trip.robot, now, kept, trip.visits, rests)
        query.limit = self.params.search_limit * effort
        tail = self._core.plan(query)
        spent = tail.expansions
        if not tail.found and tail.exhausted and not self._core.alone(query).found:
            reason = "with nobody else on the site no way leads through the visits to a bay"
            return Refusal(reason, for_good=True, expansions=spent)
        if not tail.found and effort >= self.params.last_resort:
            kept = self._cut(
                trip.robot, now, max(self._core.settled(i) for i in range(len(self._ids)))
            )
            query = self._query(trip.robot, now, kept, trip.visits, rests)
            query.limit = self.params.search_limit * effort
            tail = self._core.plan(query)
            spent += tail.expansions
        if not tail.found:
            causes = tuple(self._ids[i] for i in tail.met)
            return Refusal(f"no way found in {spent} expansions", causes, expansions=spent)
        return self._commit(trip.robot, now, kept, tail, rests, trip)

    def commitment(self, robot: str) -> Commitment:
        """Return what a robot is committed to."""
        return self._commitments[robot]

    def lone(self, trip: Trip, pose: Pose) -> int | None:
        """Return how many ticks the visits take from a pose with nobody else; ``None``: no way."""
        kept = Kept((), (), pose, None, 0)
        query = self._query(trip.robot, 0, kept, trip.visits, ())
        query.limit = LONE_LIMIT
        tail = self._core.alone(query)
        return int(tail.stops[-1].leave) if tail.found else None

    def retime(self, trajectories: Mapping[str, Trajectory]) -> None:
        """Take over the same paths at other times."""
        for robot, trajectory in trajectories.items():
            old = self._commitments[robot]
            self._commitments[robot] = Commitment(
                robot, trajectory, old.trip, old.rest, retimed_waits(old, trajectory)
            )
            self._place(robot, trajectory.timing[0][0] if trajectory.timing else 0)

    def block(self, obstacle: Obstacle, now: int) -> tuple[str, ...]:
        """Learn of an obstacle; see `clearway.protocols.TripPlanner`."""
        raise NotImplementedError

    def _type(self, robot: str) -> NativeType:
        return self._types[self._robots[robot].type]

    def _bays(self) -> tuple[Zone, ...]:
        return tuple(z for z in self._site.zones_of("parking") if z.pose is not None)

    def _free(self, names: Sequence[str], robot: str, near: Pose) -> list[Zone]:
        """Return the nearest free ones of some zones; a robot's own is free for it."""
        taken = {c.rest for c in self._commitments.values() if c.robot != robot}
        free = [self._zones[name] for name in names if name not in taken]
        free.sort(key=lambda zone: _pose(zone).distance(near))
        return free[: self.params.most_rests]

    def _holders(self, names: Sequence[str]) -> tuple[str, ...]:
        return tuple(c.robot for c in self._commitments.values() if c.rest in names)

    def _cut(self, robot: str, now: int, at: int) -> Kept:
        anywhere = not self._type(robot).type.limits.has_ramps
        return cut(self._commitments[robot].trajectory, now, at, anywhere)

    def _query(
        self, robot: str, now: int, kept: Kept, visits: Sequence[Visit], rests: Sequence[Zone]
    ) -> _core.TailQuery:
        kind, loads = self._type(robot), self._loads_at(robot, kept.ready)
        query = _core.TailQuery()
        query.robot, query.now = self._numbers[robot], now
        query.kept = kind.timed((kept.pieces, kept.timing), now, kept.ready, loads)
        query.start, query.mode = _core.Pose(*kept.pose), kind.mode(kept.mode)
        query.ready = kept.ready
        query.legs, loads = kind.legs(visits, loads)
        query.rests = [_core.Pose(*_pose(zone)) for zone in rests]
        query.rest_body = kind.body(loads)
        return query

    def _loads_at(self, robot: str, tick: int) -> int:
        """Return a robot's loads on board, counting the services that have ended by a tick."""
        old = self._commitments[robot]
        visits = old.trip.visits if old.trip else ()
        done = [stop.visit for stop in old.trajectory.stops if stop.leave <= tick]
        return self._loads[robot] + sum(LOAD_CHANGE[visits[i].load] for i in done)

    def _commit(
        self,
        robot: str,
        now: int,
        kept: Kept,
        tail: _core.Tail,
        rests: Sequence[Zone],
        trip: Trip | None,
    ) -> Commitment:
        kind, loads = self._type(robot), self._loads_at(robot, kept.ready)
        visits = trip.visits if trip else ()
        first = kept.pieces[-1].id + 1 if kept.pieces else 0
        pieces, timing = kind.motion(tail.pieces, tail.stops, visits, loads, first)
        trajectory = Trajectory(
            robot,
            kept.pieces[0].start if kept.pieces else kept.pose,
            kept.pieces + pieces,
            kept.timing + timing,
            tuple(Stop(stop.leg, stop.arrive, stop.leave) for stop in tail.stops),
        )
        rest = rests[tail.rest].name if rests else (trip.goals[-1] if trip else None)
        waits = named_waits(self._core, self._ids, kind, trajectory, kept.ready)
        self._loads[robot] = loads
        self._commitments[robot] = Commitment(robot, trajectory, trip, rest, waits)
        return self._commitments[robot]

    def _place(self, robot: str, now: int) -> None:
        """Tell the core what a robot is committed to."""
        trajectory = self._commitments[robot].trajectory
        kind, loads = self._type(robot), self._loads[robot]
        motion = (trajectory.pieces, trajectory.timing)
        until = max([trajectory.end, *(stop.leave for stop in trajectory.stops)])
        timed = kind.timed(motion, now, until, loads)
        body = kind.body(self._loads_at(robot, until))
        self._core.place(self._numbers[robot], now, _core.Pose(*trajectory.start), timed, body)

    def _park(self) -> None:
        """Lead robots that stand in no bay to one, as long as one of them finds a way."""
        names = [zone.name for zone in self._bays()]
        left = [robot for robot, held in self._commitments.items() if held.rest is None]
        while left:
            stuck = [robot for robot in left if not self._park_one(robot, names)]
            if len(stuck) == len(left):
                return
            left = stuck

    def _park_one(self, robot: str, names: Sequence[str]) -> bool:
        kept = self._cut(robot, 0, 0)
        rests = self._free(names, robot, kept.pose)
        if not rests:
            return False
        query = self._query(robot, 0, kept, (), rests)
        query.limit = self.params.search_limit
        tail = self._core.plan(query)
        if tail.found:
            self._commit(robot, 0, kept, tail, rests, None)
        return tail.found


def _pose(zone: Zone) -> Pose:
    if zone.pose is None:
        raise ValueError(f"zone {zone.name} has no pose to rest at; give it one")
    return zone.pose


def _is_at(zone: Zone, pose: Pose) -> bool:
    return max(abs(a - b) for a, b in zip(_pose(zone), pose, strict=True)) < SAME_PLACE
