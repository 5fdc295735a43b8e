"""Robots with complete motions: what each is committed to, here and in the native core."""

import math
from collections.abc import Sequence
from dataclasses import replace

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
    Wait,
    Zone,
)
from clearway.plan.cut import Kept, cut
from clearway.plan.named_waits import named_waits
from clearway.plan.native_type import NativeType

SAME_PLACE = 1e-6  # poses nearer than that are the same (m)


class TailFleet:
    """Everybody's committed motion, of which tails are searched for and replaced.

    ``most_rests`` is how many of the free bays, the nearest, a tail may end in.
    """

    def __init__(self, scenario: Scenario, params: _core.TailParams, most_rests: int) -> None:
        self._robots: dict[str, Robot] = {robot.id: robot for robot in scenario.robots}
        self.ids = tuple(self._robots)
        self._numbers = {name: i for i, name in enumerate(self.ids)}
        used = {robot.type for robot in scenario.robots}
        types = [kind for name, kind in scenario.robot_types.items() if name in used]
        reach = max(kind.shape(loaded).circumradius for kind in types for loaded in (False, True))
        self._types = {
            kind.name: NativeType(i, kind, scenario.site, reach) for i, kind in enumerate(types)
        }
        self._site = scenario.site
        # What stands in the way of each type's bodies, for each obstacle that has come to light.
        self._found: list[dict[str, list[_core.Statics]]] = []
        self._zones: dict[str, Zone] = {zone.name: zone for zone in scenario.site.zones}
        self._most_rests = most_rests
        self.core = _core.TailPlanner(
            [kind.model for kind in self._types.values()],
            [self.type(name).index for name in self.ids],
            params,
        )
        # Bays in which robots may rest; fewer when obstacles come.
        self.bays = [z.name for z in scenario.site.zones_of("parking") if z.pose is not None]
        self._loads = dict.fromkeys(self.ids, 0)  # before its committed trip
        self.commitments: dict[str, Commitment] = {}
        # When services end that go on though their trips were given up.
        self.busy: dict[str, int] = {}
        for robot in scenario.robots:
            bay = next((name for name in self.bays if self._is_at(name, robot.start)), None)
            self.commitments[robot.id] = Commitment(
                robot.id, Trajectory(robot.id, robot.start), rest=bay
            )
            self.place(robot.id, 0)

    def type(self, robot: str) -> NativeType:
        """Return a robot's type."""
        return self._types[self._robots[robot].type]

    def free(self, names: Sequence[str], robot: str, near: Pose) -> list[Zone]:
        """Return the nearest free ones of some bays; a robot's own is free for it.

        Raises
        ------
        ValueError
            If one is no zone with a pose to rest at.
        """
        taken = {c.rest for c in self.commitments.values() if c.robot != robot}
        free: list[tuple[float, int, Zone]] = []
        for name in names:
            zone = self._zones.get(name)
            if zone is None or zone.pose is None:
                raise ValueError(f"{name} is no zone with a pose to rest at; give it one")
            if name not in taken and (zone.kind != "parking" or name in self.bays):
                free.append((zone.pose.distance(near), len(free), zone))
        return [zone for _, _, zone in sorted(free)[: self._most_rests]]

    def holders(self, names: Sequence[str]) -> tuple[str, ...]:
        """Return the robots for which some of these bays are reserved."""
        return tuple(c.robot for c in self.commitments.values() if c.rest in names)

    def cut(self, robot: str, now: int, at: int) -> Kept:
        """Return what is kept of a robot's motion that is left at tick ``at`` or soon after."""
        at = max(at, self.busy.get(robot, at))
        anywhere = not self.type(robot).type.limits.has_ramps
        return cut(self.commitments[robot].trajectory, now, at, anywhere)

    def query(
        self, robot: str, now: int, kept: Kept, visits: Sequence[Visit], rests: Sequence[Zone]
    ) -> _core.TailQuery:
        """Ask for a tail through visits to one of some bays; without them, to rest at the last."""
        kind, loads = self.type(robot), self._loads_at(robot, kept.ready)
        query = _core.TailQuery()
        query.robot, query.now = self._numbers[robot], now
        query.kept = kind.timed((kept.pieces, kept.timing), now, kept.ready, loads)
        query.start, query.mode = _core.Pose(*kept.pose), kind.mode(kept.mode)
        query.ready = kept.ready
        query.legs, loads = kind.legs(visits, loads)
        query.rests = [_core.Pose(*zone.pose) for zone in rests if zone.pose is not None]
        query.rest_body = kind.body(loads)
        return query

    def commit(
        self,
        robot: str,
        kept: Kept,
        tail: _core.Tail,
        rests: Sequence[Zone],
        trip: Trip | None,
    ) -> Commitment:
        """Write down a tail that the core has found; one for the same trip keeps its stops."""
        old = self.commitments[robot]
        kind, loads = self.type(robot), self._loads_at(robot, kept.ready)
        same = trip is not None and old.trip is trip
        done = [stop for stop in old.trajectory.stops if same and stop.leave <= kept.ready]
        visits = trip.visits[len(done) :] if trip else ()
        first = kept.pieces[-1].id + 1 if kept.pieces else 0
        pieces, timing = kind.motion(tail.pieces, tail.stops, visits, loads, first)
        ahead = [Stop(len(done) + stop.leg, stop.arrive, stop.leave) for stop in tail.stops]
        trajectory = Trajectory(
            robot,
            kept.pieces[0].start if kept.pieces else kept.pose,
            kept.pieces + pieces,
            kept.timing + timing,
            (*done, *ahead),
        )
        rest = rests[tail.rest].name if rests else (trip.goals[-1] if trip else None)
        waits = named_waits(self.core, self.ids, kind, trajectory, kept.ready)
        if not same:
            self._loads[robot] = loads
        self.commitments[robot] = Commitment(robot, trajectory, trip, rest, waits)
        return self.commitments[robot]

    def stand(self, robot: str, now: int, kept: Kept, because: str) -> None:
        """Commit a robot to stand where what is kept of its motion ends."""
        self._loads[robot] = self._loads_at(robot, kept.ready)
        start = kept.pieces[0].start if kept.pieces else kept.pose
        trajectory = Trajectory(robot, start, kept.pieces, kept.timing)
        wait = Wait(kept.ready, None, ("obstacle",), because)
        self.commitments[robot] = Commitment(robot, trajectory, waits=(wait,))
        self.place(robot, now)

    def place(self, robot: str, now: int) -> None:
        """Tell the core what a robot is committed to from ``now`` on."""
        trajectory = self.commitments[robot].trajectory
        kind = self.type(robot)
        until = max([trajectory.end, *(stop.leave for stop in trajectory.stops)])
        since = min([now, *(begin for begin, end in trajectory.timing[:1] if end > now)])
        motion = (trajectory.pieces, trajectory.timing)
        timed = kind.timed(motion, since, until, self._loads_at(robot, since))
        body = kind.body(self._loads_at(robot, until))
        pose = _core.Pose(*trajectory.start)
        self.core.place(self._numbers[robot], now, pose, timed, body)

    def barred(self, robot: str, visits: Sequence[Visit]) -> Visit | None:
        """Return the first visit at whose pose an obstacle stands that has come to light."""
        kind = self.type(robot)
        for visit in visits:
            if not all(kind.is_clear(of_it[kind.type.name], visit.pose) for of_it in self._found):
                return visit
        return None

    def obstruct(self, obstacle: Obstacle, now: int) -> dict[str, int]:
        """Put an obstacle on the site; return whose motion is clear of it up to which tick only."""
        alone = replace(self._site, obstacles=(obstacle,), border="open")
        of_it = {kind.type.name: kind.statics(alone) for kind in self._types.values()}
        self._found.append(of_it)
        self._site = replace(self._site, obstacles=(*self._site.obstacles, obstacle))
        self.core.rebuild([kind.statics(self._site) for kind in self._types.values()])
        self.bays = [
            zone.name
            for zone in map(self._zones.__getitem__, self.bays)
            if zone.pose is not None
            and all(k.is_clear(of_it[k.type.name], zone.pose) for k in self._types.values())
        ]
        found = {}
        for robot in self.ids:
            statics = of_it[self.type(robot).type.name]
            until = self.core.clear_until(self._numbers[robot], now, statics)
            if until < _core.NEVER:
                found[robot] = until
        return found

    def crossers(self, robot: str, pose: Pose, since: int) -> list[str]:
        """Return who would run into a robot that stands at a pose from a tick on for ever."""
        body = self.type(robot).body(self._loads_at(robot, since))
        at, still = _core.Pose(*pose), _core.Twist(0.0, 0.0, 0.0)
        standing = _core.TimedPiece(since, _core.NEVER, at, still, -1, body)
        return [self.ids[m.robot] for m in self.core.meetings(self._numbers[robot], [standing], 0)]

    def _loads_at(self, robot: str, tick: int) -> int:
        """Return a robot's loads on board, counting the services that have ended by a tick."""
        old = self.commitments[robot]
        visits = old.trip.visits if old.trip else ()
        done = [stop.visit for stop in old.trajectory.stops if stop.leave <= tick]
        return self._loads[robot] + sum(LOAD_CHANGE[visits[i].load] for i in done)

    def _is_at(self, name: str, pose: Pose) -> bool:
        at = self._zones[name].pose
        return at is not None and math.dist(at, pose) < SAME_PLACE
