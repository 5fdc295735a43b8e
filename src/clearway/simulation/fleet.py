"""A fleet that exists only here: it moves, tells what happens, and takes decisions."""

from collections.abc import Callable

from clearway.model import (
    Battery,
    Commitment,
    Obstacle,
    Scenario,
    Surprise,
    Trip,
    Visit,
    to_seconds,
    to_ticks,
)
from clearway.protocols import Decision, Observation
from clearway.simulation import events
from clearway.simulation.arriving import Arriving
from clearway.simulation.events import Record
from clearway.simulation.kernel import Kernel
from clearway.simulation.motion import Occurrence, RobotMotion

# Called now and then: second, orders done, orders open.
Tell = Callable[[float, int, int], None]


class SimulatedFleet:
    """Runs a scenario's robots through time, deaf to who decides.

    Parameters
    ----------
    motion
        How robots move along what they are committed to.
    arriving
        Where orders come from.
    record
        Takes each event as it happens.
    """

    def __init__(
        self,
        scenario: Scenario,
        motion: RobotMotion,
        arriving: Arriving,
        record: Record,
        tell: Tell = lambda second, done, left: None,
    ) -> None:
        self._motion, self._arriving, self._record, self._tell = motion, arriving, record, tell
        robots = scenario.robots
        types = {robot.id: scenario.type_of(robot) for robot in robots}
        self._battery: dict[str, Battery | None] = {id_: t.battery for id_, t in types.items()}
        self._has_modes = {id_: t.kinematics == "four_wheel" for id_, t in types.items()}
        self._level = {robot.id: robot.energy for robot in robots}
        self._trips: dict[str, Trip | None] = {robot.id: None for robot in robots}
        self._since = {robot.id: 0 for robot in robots}  # when its trip began
        self._moved = {robot.id: 0 for robot in robots}  # ticks in motion since then
        self._at_visits = {robot.id: 0 for robot in robots}  # ticks, since then
        self._arrived: dict[str, tuple[int, int]] = {}  # when, of those at a visit, and at which
        # Services that go on though their trips were given up.
        self._left_over: Kernel[tuple[str, Trip, int]] = Kernel()
        self._leaves = {robot.id: 0 for robot in robots}  # when the last of those ends
        self._rest_at = {robot.id: 0 for robot in robots}
        self._objects: dict[str, tuple[str, ...]] = {robot.id: () for robot in robots}
        self._idle_for: dict[str, tuple[str, ...]] = {}
        self._left_idle = [robot.id for robot in robots]  # since the last decision
        self._surprises = sorted(scenario.simulation.surprises, key=lambda one: one.at)
        self._num_found = 0
        until = scenario.simulation.until
        self._until = None if until is None else to_ticks(until)
        self._now, self._wake = 0, None
        self._open: set[str] = set()
        self._taken: set[str] = set()
        self._taken_up: set[str] = set()  # at least once
        self._assigned: set[str] = set()  # but not started
        self._done, self._failed = 0, 0
        self._last_done = 0
        self._waited = 0
        self._distance = 0.0
        self._begun = False
        for robot in robots:
            if types[robot.id].battery is not None:
                record(events.energy(0, robot.id, robot.energy))

    _wake: int | None

    def observe(self) -> Observation | None:
        """Let time pass until somebody must decide something; ``None`` when the run is over."""
        while True:
            tick = self._next_tick()
            if tick is None:
                return None
            self._now = tick
            self._tell(to_seconds(tick), self._done, len(self._open))
            served, energy = self._advance()
            if self._until is not None and tick >= self._until:
                return None
            found = self._find()
            arrived = tuple(self._arriving.pop(tick))
            for order in arrived:
                self._open.add(order.task.id)
                self._record(events.released(tick, order))
            woken = self._wake is not None and tick >= self._wake
            first, self._begun = not self._begun, True
            if served or arrived or found or woken or first:
                self._wake = None
                expected = self._motion.expected(tick)
                return Observation(tick, arrived, tuple(served), energy, found, expected)

    def execute(self, decision: Decision) -> None:
        """Carry a decision out."""
        now = self._now
        for id_ in decision.done:
            self._open.discard(id_)
            self._done += 1
            self._last_done = now
            self._record(events.order(now, id_, "done"))
        for id_ in decision.given_back:
            self._taken.discard(id_)
            self._assigned.discard(id_)
            reason = "given back: an obstacle bars the way"
            self._record(events.order(now, id_, "released", reason=reason))
        for robot in decision.diverted:
            commitment = decision.commitments[robot]
            self._record(events.detour(now, self._trips[robot], commitment))
        for told in decision.told:
            self._record(events.decision(now, told))
            trip = told.choice.trip
            if isinstance(told.outcome, Commitment) and trip.order in self._open:
                self._take(trip)
        for id_, reason in decision.failed.items():
            self._open.discard(id_)
            self._failed += 1
            self._take_up(id_)
            self._record(events.order(now, id_, "failed", reason=reason))
        for robot, commitment in decision.commitments.items():
            self._flush(robot)
            if commitment.trip is not self._trips[robot]:
                if self._trips[robot] is not None:
                    self._account(robot, now)
                self._begin(robot, commitment.trip)
            self._rest_at[robot] = commitment.trajectory.end
        self._motion.commit(decision.commitments, now)
        self._tell_idle(decision)
        self._wake = decision.wake

    def close(self, status: str | None = None) -> str:
        """Write what is left, and how it ended; return that status.

        Parameters
        ----------
        status
            Absent: ``done`` where no order is open or to come, ``ended`` where time was up
            before, ``stuck`` where it was not.
        """
        if status is None:
            if not self._open and self._arriving.exhausted:
                status = "done"
            else:
                is_up = self._until is not None and self._now >= self._until
                status = "ended" if is_up else "stuck"
        if status == "done":
            # The last ones still drive to their rest; late ones come there later than planned.
            self._now = max(self._now, *self._rest_at.values())
            self._advance()
            while (tick := self._motion.next_tick()) is not None:
                self._now = max(self._now, tick)
                self._advance()
        for robot in self._trips:
            self._flush(robot)
            if self._trips[robot] is not None:
                self._account(robot, self._now)
        self._record(
            {
                "event": "end",
                "t": to_seconds(self._now),
                "status": status,
                "makespan": to_seconds(self._last_done),
                "orders_done": self._done,
                "orders_open": len(self._open),
                "distance": round(self._distance, 6),
                "waiting": to_seconds(self._waited),
            }
        )
        return status

    def _next_tick(self) -> int | None:
        if not self._begun:
            return 0
        busy = any(trip is not None for trip in self._trips.values())
        if not self._open and not busy and self._arriving.exhausted:
            return None
        ticks = [self._motion.next_tick(), self._arriving.next_tick(), self._wake]
        ticks.append(self._left_over.next_tick())
        if self._num_found < len(self._surprises):
            ticks.append(to_ticks(self._surprises[self._num_found].at))
        ahead = [max(tick, self._now) for tick in ticks if tick is not None]
        if self._until is not None:
            return min([*ahead, self._until])
        return min(ahead) if ahead else None

    def _advance(self) -> tuple[list[str], dict[str, float]]:
        """Let occur what occurs; return who has served its last visit, and changed levels."""
        served: list[str] = []
        energy: dict[str, float] = {}
        for one in self._motion.advance(self._now):
            if one.kind == "waits":
                assert one.wait is not None
                wait = one.wait
                self._record(events.wait(one.tick, one.robot, wait.causes, wait.end, wait.because))
            elif one.kind in ("stops", "moves"):
                state = "stopped" if one.kind == "stops" else "moving"
                self._record(events.stop(one.tick, one.robot, state))
            elif self._visited(one):
                served.append(one.robot)
                if self._battery[one.robot] is not None:
                    energy[one.robot] = self._level[one.robot]
        while (over := self._left_over.pop(self._now)) is not None:
            robot, trip, number = over
            self._record(events.visit(self._now, robot, trip, number, "left", None))
            self._load(self._now, trip, trip.visits[number], False)
        return served, energy

    def _visited(self, one: Occurrence) -> bool:
        """Tell an arrival or departure; return whether it was the trip's last departure."""
        robot, trip = one.robot, self._trips[one.robot]
        assert trip is not None
        self._flush(robot)
        # A robot may have to bring back what it fetched for an order that has failed.
        serves = trip.order if trip.order in self._open else None
        self._record(events.visit(one.tick, robot, trip, one.visit, one.kind, serves))
        if one.kind == "arrived":
            self._arrived[robot] = one.tick, one.visit
            if trip.order is not None and trip.order in self._assigned:
                self._assigned.discard(trip.order)
                self._record(events.order(one.tick, trip.order, "started", robot=robot))
            return False
        self._at_visits[robot] += one.tick - self._arrived.pop(robot)[0]
        last = one.visit == len(trip.visits) - 1
        self._load(one.tick, trip, trip.visits[one.visit], last)
        if not last:
            return False
        self._account(robot, one.tick)
        self._trips[robot] = None
        self._left_idle.append(robot)
        self._charge(one.tick, robot, trip)
        return True

    def _load(self, tick: int, trip: Trip, visit: Visit, last: bool) -> None:
        robot = trip.robot
        on_board = self._objects[robot]
        if last and trip.carries:
            on_board = trip.carries
        elif visit.load == "pick":
            on_board = (*on_board, visit.task or "load")
        elif visit.load == "drop":
            on_board = on_board[:-1]
        if on_board != self._objects[robot]:
            self._objects[robot] = on_board
            self._record(events.load(tick, robot, on_board))

    def _charge(self, tick: int, robot: str, trip: Trip) -> None:
        battery = self._battery[robot]
        if battery is None:
            return
        if trip.purpose == "charge":
            gained = sum(visit.service for visit in trip.visits) / battery.charging
            full = max(battery.full, self._level[robot])
            self._level[robot] = min(full, self._level[robot] + gained)
        self._record(events.energy(tick, robot, self._level[robot]))

    def _take(self, trip: Trip) -> None:
        assert trip.order is not None
        if trip.order in self._taken:
            return
        self._taken.add(trip.order)
        self._assigned.add(trip.order)
        self._record(events.order(self._now, trip.order, "assigned", robot=trip.robot))
        self._take_up(trip.order)

    def _take_up(self, order: str) -> None:
        """Tell where orders come from, once, that one is no longer waiting."""
        if order not in self._taken_up:
            self._taken_up.add(order)
            self._arriving.taken(order, self._now)

    def _begin(self, robot: str, trip: Trip | None) -> None:
        given_up, arrived = self._trips[robot], self._arrived.pop(robot, None)
        if given_up is not None and arrived is not None:
            since, number = arrived
            self._leaves[robot] = since + to_ticks(given_up.visits[number].service)
            self._left_over.at(self._leaves[robot], (robot, given_up, number))
        self._trips[robot] = trip
        if trip is None:
            self._left_idle.append(robot)
        self._since[robot], self._moved[robot] = self._now, 0
        self._at_visits[robot] = max(0, self._leaves[robot] - self._now)

    def _flush(self, robot: str) -> None:
        """Write what has been driven, and count it."""
        driven = self._motion.driven(robot, self._now)
        event = events.motion(driven, self._has_modes[robot])
        if event is None:
            return
        self._record(event)
        moved = sum(end - first for first, end in driven.timing)
        self._moved[robot] += moved
        self._distance += driven.distance
        battery = self._battery[robot]
        if battery is not None:
            self._level[robot] = max(0.0, self._level[robot] - to_seconds(moved) / battery.capacity)

    def _account(self, robot: str, end: int) -> None:
        """Count the standing of a trip that was not at a visit."""
        at_visits = self._at_visits[robot]
        if robot in self._arrived:
            at_visits += end - self._arrived[robot][0]
        lasted = end - self._since[robot]
        self._waited += max(0, lasted - self._moved[robot] - at_visits)

    def _find(self) -> tuple[Obstacle, ...]:
        found: list[Obstacle] = []
        while self._num_found < len(self._surprises):
            surprise: Surprise = self._surprises[self._num_found]
            if to_ticks(surprise.at) > self._now:
                break
            self._num_found += 1
            found.append(surprise.obstacle)
            name = f"obstacle-{self._num_found}"
            self._record(events.obstacle(self._now, name, surprise.obstacle))
        return tuple(found)

    def _tell_idle(self, decision: Decision) -> None:
        """Tell what robots without a trip wait for, where that has changed."""
        causes: dict[str, tuple[tuple[str, ...], str]] = {
            robot: (("order",), "nothing to do") for robot in self._left_idle
        }
        self._left_idle = []
        for told in decision.told:
            robot = told.choice.trip.robot
            if isinstance(told.outcome, Commitment):
                self._idle_for.pop(robot, None)
            elif self._trips[robot] is None:
                causes[robot] = (told.outcome.causes or ("plan",), told.outcome.reason)
        for robot, (waits_for, because) in causes.items():
            if self._trips[robot] is None and self._idle_for.get(robot) != waits_for:
                self._idle_for[robot] = waits_for
                self._record(events.wait(self._now, robot, waits_for, None, because))
