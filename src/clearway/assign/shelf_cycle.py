"""The cycle of robots that fetch shelves, with the choices in it left open."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from itertools import count

from clearway.assign.nearby import Nearby
from clearway.assign.shelf_yard import ShelfYard, require_shelves
from clearway.model import Battery, Order, Scenario, Trip, Visit
from clearway.protocols import Alternative, Board, Choice, RobotView


@dataclass(frozen=True)
class ShelfParams:
    """Times of a shelf's journey (s).

    Parameters
    ----------
    lift, lower
        Time under a shelf to take it up, and to put it down.
    residence
        Time at a station.
    alternatives
        How many other choices are told beside what was chosen.
    """

    lift: float = 0.0
    lower: float = 0.0
    residence: float = 10.0
    alternatives: int = 3

    def __post_init__(self) -> None:
        for name in ("lift", "lower", "residence", "alternatives"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name} must be 0 or above, got {getattr(self, name)}")


class ShelfCycle(ABC):
    """Robots fetch shelves, deliver them at stations and store them (paper B, R-B11 to R-B19).

    An order is three trips: ``fetch``, ``deliver``, ``store``. A robot whose battery is below its
    reserve after an order goes to charge, and is unavailable until it has. It then stays at the
    charger until it has an order; if somebody else needs a charger and none is free, it goes to
    rest under a shelf instead (``park``), so vacant places are left to shelves (R-B13).

    Subclasses say who fetches what, and to which station and place a shelf goes.
    """

    def __init__(self, scenario: Scenario, params: ShelfParams | None = None) -> None:
        self.params = params or ShelfParams()
        self.yard = ShelfYard(scenario.site)
        self.idle = Nearby({robot.id: robot.start for robot in scenario.robots})
        self._types = scenario.robot_types
        self._low: dict[str, None] = {}  # robots that need a charger, oldest first
        self._next: dict[str, Trip] = {}  # robots in the middle of an order: the trip that ended
        self._doing: dict[str, Order] = {}
        self._is_begun = False
        self._open: list[tuple[int, str]] = []
        self._blocked: dict[str, list[tuple[int, str]]] = {}
        self._later: list[tuple[int, str]] = []  # orders that wait for others to be done
        self._known: set[str] = set()
        self._numbers = count()

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield wanted trips: orders under way first, then charging, then new orders."""
        self._take_in(board)
        yield from self._go_on(board)
        yield from self._charge(board)
        yield from self._begin(board)

    @abstractmethod
    def _committed(self, choice: Choice, board: Board) -> None:
        """Learn of a trip that a robot is committed to, while it still owns where it was."""

    @abstractmethod
    def _begin(self, board: Board) -> Iterator[Choice]:
        """Yield the trips that begin orders."""

    @abstractmethod
    def _stations(self, view: RobotView, shelf: str, number: int) -> list[Alternative]:
        """Return the best stations for a shelf that has been lifted, best first."""

    @abstractmethod
    def _places(self, view: RobotView, number: int) -> list[Alternative]:
        """Return the best vacant places for the shelf of a robot at a station, best first."""

    def _take_in(self, board: Board) -> None:
        """Learn which orders have arrived and which trips have ended."""
        orders = board.open if not self._is_begun else board.arrived
        for id in orders:
            fetches = board.open[id].task.fetches
            require_shelves(self.yard, [(id, fetches)])
            heappush(self._open, (next(self._numbers), id))
            self._known.add(id)
        if not self._is_begun:
            self._is_begun = True
            for view in board.robots.values():
                self._place(view)
                self._rest(view)
        for ended in board.ended:
            if ended.trip.purpose == "store":
                self.yard.lower(ended.robot)
            if ended.trip.purpose in ("fetch", "deliver"):
                self._next[ended.robot] = ended.trip
            else:
                self._rest(board.robots[ended.robot])
        for shelf in self.yard.freed:
            for entry in self._blocked.pop(shelf, ()):
                heappush(self._open, entry)
        self.yard.freed.clear()
        for entry in self._later:
            heappush(self._open, entry)
        self._later.clear()

    def _place(self, view: RobotView) -> None:
        endpoint = view.place or self.yard.endpoint_at(view.pose)
        if endpoint not in self.yard.pose:
            raise ValueError(
                f"robot {view.id} starts at ({view.pose.x:g}, {view.pose.y:g}), which is no "
                "endpoint; start it at the pose of a shelf, station, charger or parking zone"
            )
        self.yard.move(view.id, endpoint)

    def _rest(self, view: RobotView) -> None:
        """Let a robot without a trip be idle, or wait for a charger."""
        battery = self._types[view.type].battery
        if battery is not None and view.energy < battery.reserve and self._has_chargers:
            self._low[view.id] = None
        else:
            self._be_idle(view)

    def _be_idle(self, view: RobotView) -> None:
        self.idle.add(view.id, view.pose)
        self.yard.free_above(view.id)

    @property
    def _has_chargers(self) -> bool:
        return "charger" in self.yard.kind.values()

    def _is_available(self, shelf: str) -> bool:
        """Whether an order may have a shelf now: stored, not selected, nobody busy under it."""
        place = self.yard.where[shelf]
        if place is None or not self.yard.is_free(shelf):
            return False
        owner = self.yard.owner(place)
        return owner is None or owner in self.idle

    def _go_on(self, board: Board) -> Iterator[Choice]:
        """Yield the next trips of orders under way; those at stations first, to free them."""
        for robot in sorted(self._next, key=lambda r: self._next[r].purpose != "deliver"):
            view = board.robots[robot]
            ended = self._next[robot]
            shelf = self.yard.carried(robot)
            number = 1 + self.params.alternatives
            if ended.purpose == "fetch":
                best = self._stations(view, shelf, number)
                choice = self._deliver(view, self._doing[robot], shelf, best)
            else:
                best = self._places(view, number)
                choice = self._store(view, self._doing[robot], shelf, best)
            if choice is None:
                continue
            yield choice
            if board.robots[robot].trip is choice.trip:
                self._committed(choice, board)
                del self._next[robot]
                if ended.purpose == "fetch":
                    self.yard.carry_off(robot, choice.chosen)
                else:
                    self.yard.bring_back(robot, choice.chosen)

    def _fetch(
        self, view: RobotView, order: Order, kind: str, ranked: list[Alternative], because: str
    ) -> Choice:
        """Return the trip of a robot under the shelf of an order."""
        shelf = order.task.fetches or ""
        place = self.yard.where[shelf] or ""
        visit = Visit(order.task.id, self.yard.pose[place], self.params.lift, "pick")
        trip = Trip(view.id, (visit,), "fetch", order.task.id, (place,), (), (shelf,))
        return _choice(trip, kind, ranked, completes=False, because=because)

    def _deliver(
        self, view: RobotView, order: Order, shelf: str, ranked: list[Alternative]
    ) -> Choice | None:
        if not ranked:
            return None  # until a station is free
        station = ranked[0].name
        visit = Visit(order.task.id, self.yard.pose[station], self.params.residence)
        trip = Trip(view.id, (visit,), "deliver", order.task.id, (station,), (), (shelf,))
        because = f"{station} is {self.station_rule} for {shelf}"
        return _choice(trip, "station", ranked, completes=False, because=because)

    def _store(
        self, view: RobotView, order: Order, shelf: str, ranked: list[Alternative]
    ) -> Choice | None:
        assert ranked, f"no vacant place for {shelf} (R-B13)"
        place = ranked[0].name
        visit = Visit(order.task.id, self.yard.pose[place], self.params.lower, "drop")
        if order.due is not None:
            visit = replace(visit, due=order.due)
        trip = Trip(view.id, (visit,), "store", order.task.id, (place,))
        because = f"{place} is {self.place_rule} for {shelf}"
        return _choice(trip, "location", ranked, completes=True, because=because)

    station_rule = "the nearest available station"
    place_rule = "the nearest vacant place"

    def _charge(self, board: Board) -> Iterator[Choice]:
        """Send robots below their reserve to chargers, and others away from there if need be."""
        for robot in list(self._low):
            if not len(self.yard.chargers):
                yield from self._make_room(board)
            view = board.robots[robot]
            battery = self._types[view.type].battery
            assert battery is not None
            because = (
                f"{robot} is at {100 * view.energy:.0f} %, below its reserve of "
                f"{100 * battery.reserve:.0f} %"
            )
            yield from self._go_charging(view, battery, because, board)

    def _go_charging(
        self, view: RobotView, battery: Battery, because: str, board: Board
    ) -> Iterator[Choice]:
        """Yield the trip to the nearest free charger, if there is one."""
        ranked = self.yard.chargers.nearest(view.pose, 1 + self.params.alternatives)
        if not ranked:
            return
        speed = self._types[view.type].limits.speed
        service = _charging(battery, view.energy, ranked[0].score / speed)
        charger = ranked[0].name
        visit = Visit(None, self.yard.pose[charger], service)
        trip = Trip(view.id, (visit,), "charge", goals=(charger,))
        because = f"{because}; {charger} is the nearest free charger"
        choice = _choice(trip, "charger", ranked, completes=False, because=because)
        yield choice
        if board.robots[view.id].trip is trip:
            self._committed(choice, board)
            self._low.pop(view.id, None)
            self.idle.discard(view.id)
            self.yard.move(view.id, charger)

    def _make_room(self, board: Board) -> Iterator[Choice]:
        """Send one idle robot from its charger under a shelf."""
        for robot in self.idle.names():
            if self.yard.kind[self.yard.owned(robot) or ""] != "charger":
                continue
            view = board.robots[robot]
            ranked = self.yard.sheltered.nearest(view.pose, 1 + self.params.alternatives)
            if not ranked:
                return
            visit = Visit(None, self.yard.pose[ranked[0].name])
            trip = Trip(robot, (visit,), "park", goals=(ranked[0].name,))
            because = f"others need {self.yard.owned(robot)}; {robot} is charged and idle"
            choice = _choice(trip, "location", ranked, completes=False, because=because)
            yield choice
            if board.robots[robot].trip is trip:
                self._committed(choice, board)
                self.idle.discard(robot)
                self.yard.move(robot, ranked[0].name)
                return

    def _pop_order(self, board: Board) -> tuple[int, Order] | None:
        """Take the oldest order whose shelf is available, with its number in the queue.

        Those whose shelf is not are put aside until it is, those that wait for another order
        until that one is done.
        """
        while self._open:
            entry = heappop(self._open)
            order = board.open.get(entry[1])
            if order is None:
                continue  # withdrawn
            if any(other in board.open or other not in self._known for other in order.after):
                self._later.append(entry)
                continue
            shelf = order.task.fetches or ""
            if self._is_available(shelf):
                return entry[0], order
            self._blocked.setdefault(shelf, []).append(entry)
        return None

    def _put_back(self, number: int, order: Order) -> None:
        """Let an order be the one with its number in the queue again."""
        heappush(self._open, (number, order.task.id))

    def _commit_fetch(self, choice: Choice, order: Order, board: Board) -> None:
        """Remember that a robot is on its way to an order's shelf."""
        self._doing[choice.trip.robot] = order
        self._committed(choice, board)
        self.idle.discard(choice.trip.robot)
        self.yard.select(choice.trip.robot, choice.trip.carries[0])


def _choice(
    trip: Trip, kind: str, ranked: list[Alternative], *, completes: bool, because: str
) -> Choice:
    best, *others = ranked
    return Choice(trip, kind, best.name, best.score, tuple(others), completes, because)


def _charging(battery: Battery, level: float, driving: float) -> float:
    """Return the time (s) from what is left after driving (s) up to full."""
    arrival = max(0.0, level - driving / battery.capacity)
    return max(0.0, battery.full - arrival) * battery.charging
