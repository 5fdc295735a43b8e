"""New ways for robots whose committed motion runs into an obstacle that nobody knew of."""

from collections.abc import Callable

from clearway import _core
from clearway.model import Obstacle, Trip
from clearway.plan.cut import Kept
from clearway.plan.tail_fleet import TailFleet

LOOK = 1000  # ticks between two places where a robot may stop
PATIENCE = 8  # a search for a way round has so many times the usual effort

Search = Callable[[_core.TailQuery], _core.Tail]


class Detour:
    """Plans those anew that an obstacle stops, from their motion; the others are left alone.

    In turn, whoever comes to the obstacle first goes first: to what is left of its trip, to any
    free bay, to a place before the obstacle that nobody crosses. Where there is none it stops
    at once, and those who would run into it are planned anew as well. No motion changes before
    tick ``first``, but where the obstacle is reached sooner.
    """

    def __init__(self, fleet: TailFleet, search: Search, limit: int, now: int, first: int) -> None:
        self._fleet, self._search, self._limit = fleet, search, limit
        self._now, self._first = now, first

    def around(self, obstacle: Obstacle) -> tuple[str, ...]:
        """Return the robots that had to be planned anew, in the order of their meetings."""
        left = self._fleet.obstruct(obstacle, self._now)
        done: list[str] = []
        while left:
            robot = min(left, key=lambda one: left[one])
            until = left.pop(robot)
            done.append(robot)
            for other, tick in self._lead(robot, until).items():
                if other not in done:
                    left[other] = min(tick, left.get(other, tick))
        return tuple(done)

    def _lead(self, robot: str, until: int) -> dict[str, int]:
        """Plan one robot anew that may go on up to a tick; return who would now run into it."""
        fleet, now = self._fleet, self._now
        old = fleet.commitments[robot]
        trip = old.trip
        kept = self._cut(robot, min(self._first, until))
        if trip is not None and kept.ready < old.served:
            num_done = sum(stop.leave <= kept.ready for stop in old.trajectory.stops)
            if self._found(robot, kept, trip, num_done):
                return {}
        busy = [s.leave for s in old.trajectory.stops if s.arrive <= now < s.leave]
        fleet.busy[robot] = max([*busy, fleet.busy.get(robot, now)])
        if self._found(robot, kept, None, 0):
            return {}
        tick = kept.ready
        while tick <= until:
            place = self._cut(robot, tick)
            if place.ready <= until and not fleet.crossers(robot, place.pose, place.ready):
                fleet.stand(robot, now, place, "an obstacle bars the way, and no other was found")
                return {}
            tick = max(tick, place.ready) + LOOK
        met = fleet.crossers(robot, kept.pose, kept.ready)
        fleet.stand(robot, now, kept, "an obstacle bars the way; others have to go round")
        return dict.fromkeys(met, kept.ready)

    def _cut(self, robot: str, at: int) -> Kept:
        """Return what is kept up to a tick, or to the end of the service at that time."""
        stops = self._fleet.commitments[robot].trajectory.stops
        busy = [stop.leave for stop in stops if stop.arrive <= at < stop.leave]
        return self._fleet.cut(robot, self._now, max([at, *busy]))

    def _found(self, robot: str, kept: Kept, trip: Trip | None, num_done: int) -> bool:
        """Search for a way through the rest of a trip to a bay, or straight to any bay."""
        fleet = self._fleet
        visits = trip.visits[num_done:] if trip else ()
        near = visits[-1].pose if visits else kept.pose
        names = trip.rests if trip else fleet.bays
        rests = fleet.free(names, robot, near)
        if not rests and (names or not visits):
            return False
        query = fleet.query(robot, self._now, kept, visits, rests)
        query.limit = PATIENCE * self._limit
        tail = self._search(query)
        if tail.found:
            fleet.commit(robot, kept, tail, rests, trip)
        return bool(tail.found)
