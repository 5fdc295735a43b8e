"""The cycle of robots that fetch shelves, with the choices in it left open."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Set
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from itertools import count

from clearway.assign.nearby import Nearby
from clearway.assign.shelf_yard import ShelfYard, require_shelves
from clearway.model import Battery, Order, Scenario, Trip, Visit
from clearway.protocols import Alternative, Board, Choice, RobotView

# An order in the queue: more urgent ones first, then by number; its id.
Entry = tuple[float, int, str]
NOTHING: Set[str] = frozenset()


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

    A robot that an obstacle has driven off its trip begins that part of its order again; one that
    stands on a lane without a shelf drives to an endpoint. Where a station or place can never be
    reached others are tried, and other robots for an order; where none is left, the order fails.

    Subclasses say who fetches what, and to which station and place a shelf goes.
    """

    def __init__(self, scenario: Scenario, params: ShelfParams | None = None) -> None:
        self.params = params or ShelfParams()
        self.yard = ShelfYard(scenario.site)
        self.idle = Nearby({robot.id: robot.start for robot in scenario.robots})
        self._types = scenario.robot_types
        self._low: dict[str, None] = {}  # robots that need a charger, oldest first
        self._next: dict[str, str] = {}  # robots in the middle of an order: the part that is done
        self._doing: dict[str, tuple[Order, int]] = {}  # with its number in the queue
        self._trips: dict[str, Trip] = {}  # under way
        self._astray: dict[str, None] = {}  # robots on lanes, without a shelf
        self._gone: set[str] = set()  # robots that can never drive to where they are needed
        self._barred: dict[str, set[str]] = {}
        self._all_stations = {name for name, kind in self.yard.kind.items() if kind == "station"}
        self._is_begun = False
        self._open: list[Entry] = []
        self._blocked: dict[str, list[Entry]] = {}
        self._later: list[Entry] = []  # orders that wait for others to be done
        self._known: set[str] = set()
        self._numbers = count()

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield wanted trips: orders under way first, then charging, then new orders."""
        self._take_in(board)
        for choice in self._wanted(board):
            yield choice
            if board.robots[choice.trip.robot].trip is choice.trip:
                self._trips[choice.trip.robot] = choice.trip

    def _wanted(self, board: Board) -> Iterator[Choice]:
        if self._gone:
            yield from self._fail(board)
        for robot in sorted(self._next, key=lambda r: self._next[r] != "deliver"):
            yield from self._go_on(robot, board)  # those at stations first, to free them
        yield from self._leave(board)
        yield from self._charge(board)
        yield from self._begin(board)
        if not self.yard.is_whole or self._barred:
            yield from self._give_up(board)

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
            heappush(self._open, (-board.open[id].priority, next(self._numbers), id))
            self._known.add(id)
        if not self._is_begun:
            self._is_begun = True
            for view in board.robots.values():
                self._place(view)
                self._rest(view)
        self._barred = board.barred
        for ended in board.ended:
            self._trips.pop(ended.robot, None)
            if ended.trip.purpose == "store":
                self.yard.lower(ended.robot)
            if ended.trip.purpose in ("fetch", "deliver"):
                self._next[ended.robot] = ended.trip.purpose
            else:
                self._rest(board.robots[ended.robot])
        self._notice_driven_off(board)
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

    def _notice_driven_off(self, board: Board) -> None:
        """Learn which robots an obstacle has driven off, and where they are now."""
        at = {
            view.id: view.place or self.yard.endpoint_at(view.pose)
            for view in board.robots.values()
            if view.is_idle and view.id not in self._gone
        }
        off = [r for r in at if r in self._trips or at[r] != self.yard.owned(r)]
        for robot in off:
            self.yard.give_up(robot)
            self.idle.discard(robot)
            self._low.pop(robot, None)
            self._astray.pop(robot, None)
        for robot in off:
            trip = self._trips.pop(robot, None)
            place = at[robot]
            if place is not None:
                self.yard.move(robot, place)
            if trip is not None and trip.purpose == "fetch":
                self.yard.drop_selection(robot)
                order, number = self._doing.pop(robot)
                if order.task.id in board.open:
                    self._put_back(number, order)
            elif trip is not None and trip.purpose in ("deliver", "store"):
                self._next[robot] = "fetch" if trip.purpose == "deliver" else "deliver"
            self._driven_off(board.robots[robot], board.now)
            if robot not in self._next:
                self._rest(board.robots[robot])

    @abstractmethod
    def _driven_off(self, view: RobotView, now: int) -> None:
        """Learn that an obstacle has driven a robot off to where it is, or will be."""

    def _rest(self, view: RobotView) -> None:
        """Let a robot without a trip be idle, or wait for a charger."""
        battery = self._types[view.type].battery
        if battery is not None and view.energy < battery.reserve and self._can_charge(view.id):
            self._low[view.id] = None
        elif self.yard.owned(view.id) is None:
            self._astray[view.id] = None
        else:
            self._be_idle(view)

    def _be_idle(self, view: RobotView) -> None:
        self.idle.add(view.id, view.pose)
        self.yard.free_above(view.id)

    def _can_charge(self, robot: str) -> bool:
        return bool(self._reachable(robot, "charger"))

    def _reachable(self, robot: str, kind: str) -> list[str]:
        """Return the endpoints of a kind that a robot is not barred from."""
        barred = self._barred_from(robot)
        return [name for name, its in self.yard.kind.items() if its == kind and name not in barred]

    def _barred_from(self, robot: str) -> Set[str]:
        return self._barred.get(robot, NOTHING)

    def _barred_robots(self, place: str) -> Set[str]:
        """Return the robots that can never drive to a place."""
        if not (self._barred or self._gone):
            return NOTHING
        barred = {
            robot
            for robot, zones in self._barred.items()
            if place in zones or not self._reachable(robot, "station")
        }
        return self._gone | barred

    def _may_others_fetch(self, robot: str | None, place: str, board: Board) -> bool:
        """Whether some other robot may drive to a place, now or later."""
        barred = self._barred_robots(place)
        return any(other != robot and other not in barred for other in board.robots)

    def _is_available(self, shelf: str) -> bool:
        """Whether an order may have a shelf now: stored, not selected, nobody busy under it."""
        place = self.yard.where[shelf]
        if place is None or not self.yard.is_free(shelf):
            return False
        owner = self.yard.owner(place)
        return owner is None or owner in self.idle

    def _go_on(self, robot: str, board: Board) -> Iterator[Choice]:
        """Yield the next trip of a robot in the middle of an order, until it is committed to one.

        Where a goal turns out to be out of reach for good, the next best one is tried.
        """
        view, shelf, order = board.robots[robot], self.yard.carried(robot), self._doing[robot][0]
        number = 1 + self.params.alternatives
        while robot in self._next:
            is_open = order.task.id in board.open
            is_lost = robot in board.stranded
            to_station = is_open and self._next[robot] == "fetch"
            if not is_open and (is_lost or not self._reachable(robot, "shelf")):
                self._lose(robot)
                return
            lifted_from = self.yard.where[shelf]
            if to_station:
                best = self._stations(view, shelf, number)
                if not self._reachable(robot, "station"):
                    best = [Alternative(min(self._barred_from(robot) & self._all_stations), 0.0)]
                elsewhere = not is_lost and len(self._reachable(robot, "station")) > 1
                choice = self._deliver(view, order, shelf, best, elsewhere)
            else:
                if lifted_from is None:
                    best = self._places(view, number)
                else:
                    best = [Alternative(lifted_from, 0.0)]  # its order failed meanwhile
                elsewhere = not is_lost and len(self._reachable(robot, "shelf")) > 1
                choice = self._store(view, order if is_open else None, shelf, best, elsewhere)
            if choice is None:
                return  # until a station or place is free
            yield choice
            if board.robots[robot].trip is choice.trip:
                self._committed(choice, board)
                del self._next[robot]
                if to_station:
                    self.yard.carry_off(robot, choice.chosen)
                elif lifted_from is None:
                    self.yard.bring_back(robot, choice.chosen)
            elif choice.chosen not in self._barred_from(robot):
                return
            elif lifted_from is not None and not to_station:
                self._lose(robot)

    def _lose(self, robot: str) -> None:
        """Let a robot, with what it has on board, be out of everybody's reach."""
        self._gone.add(robot)
        for those in (self._next, self._astray, self._low):
            those.pop(robot, None)

    def _give_up(self, board: Board) -> Iterator[Choice]:
        """Fail orders whose shelves have no place to go to, once nobody does anything any more."""
        if any(not view.is_idle for view in board.robots.values()):
            return
        for robot in list(self._next):
            view, order = board.robots[robot], self._doing[robot][0]
            barred = self._barred_from(robot)
            if self._places(view, 1) or self.yard.where[self.yard.carried(robot)] is not None:
                continue
            if self._next[robot] == "fetch" and order.task.id in board.open:
                continue  # it waits for a station
            if order.task.id in board.open and (places := barred & self.yard.where.keys()):
                place = min(places, key=lambda name: (name not in self.yard.vacant, name))
                best = [Alternative(place, 0.0)]
                choice = self._store(view, order, self.yard.carried(robot), best, False)
                assert choice is not None
                yield choice
                if board.robots[robot].trip is choice.trip or order.task.id in board.open:
                    continue
            if barred:
                self._lose(robot)
        if self._gone:
            yield from self._fail(board)

    def _fail(self, board: Board) -> Iterator[Choice]:
        """Yield trips of robots that are gone for what only they could do: those orders fail."""
        gone = sorted(self._gone)
        carriers = {shelf: r for r in gone if (shelf := self.yard.held_by(r)) is not None}
        is_over = len(gone) == len(board.robots)
        for id, order in list(board.open.items()):
            robot = carriers.get(order.task.fetches or "", gone[0] if is_over else None)
            if robot is None or id in board.taken:
                continue
            place = min(self._barred_from(robot), key=lambda p: (self.yard.owner(p) or "", p))
            visit = Visit(id, self.yard.pose[place])
            trip = Trip(robot, (visit,), "fetch", id, (place,))
            because = f"{robot} has {order.task.fetches} on board" if carriers else ""
            yield Choice(trip, "robot", robot, 0.0, completes=False, because=because)

    def _leave(self, board: Board) -> Iterator[Choice]:
        """Send robots that stand on lanes, or where shelves on board must go, to endpoints."""
        short = len(self.yard.vacant) < self.yard.homeless
        away = [r for r in self.idle.names() if self.yard.blocks_place(r)] if short else []
        for robot in [*self._astray, *away]:
            view, number = board.robots[robot], 1 + self.params.alternatives
            while True:
                barred = self._barred_from(robot)
                free = (self.yard.sheltered, self.yard.chargers, self.yard.stations)
                ranked = next(
                    (some for f in free if (some := f.nearest(view.pose, number, None, barred))),
                    [],
                )
                if robot in board.stranded or not ranked:
                    if barred and robot in self._astray:
                        self._lose(robot)
                    break
                place = ranked[0].name
                trip = Trip(robot, (Visit(None, self.yard.pose[place]),), "park", goals=(place,))
                because = f"an obstacle drove {robot} off; {place} is the nearest free endpoint"
                choice = _choice(trip, "location", ranked, completes=False, because=because)
                choice = replace(choice, elsewhere=True)
                yield choice
                if board.robots[robot].trip is trip:
                    self._committed(choice, board)
                    self._astray.pop(robot, None)
                    self.idle.discard(robot)
                    self.yard.move(robot, place)
                    break
                if place not in self._barred_from(robot):
                    break

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
        self,
        view: RobotView,
        order: Order,
        shelf: str,
        ranked: list[Alternative],
        elsewhere: bool,
    ) -> Choice | None:
        if not ranked:
            return None
        station = ranked[0].name
        visit = Visit(order.task.id, self.yard.pose[station], self.params.residence)
        trip = Trip(view.id, (visit,), "deliver", order.task.id, (station,), (), (shelf,))
        because = f"{station} is {self.station_rule} for {shelf}"
        choice = _choice(trip, "station", ranked, completes=False, because=because)
        return replace(choice, elsewhere=elsewhere)

    def _store(
        self,
        view: RobotView,
        order: Order | None,
        shelf: str,
        ranked: list[Alternative],
        elsewhere: bool,
    ) -> Choice | None:
        if not ranked:
            return None
        place, id = ranked[0].name, None if order is None else order.task.id
        visit = Visit(id, self.yard.pose[place], self.params.lower, "drop")
        if order is not None and order.due is not None:
            visit = replace(visit, due=order.due)
        trip = Trip(view.id, (visit,), "store", id, (place,))
        because = f"{place} is {self.place_rule} for {shelf}"
        choice = _choice(trip, "location", ranked, completes=True, because=because)
        return replace(choice, elsewhere=elsewhere)

    station_rule = "the nearest available station"
    place_rule = "the nearest vacant place"

    def _charge(self, board: Board) -> Iterator[Choice]:
        """Send robots below their reserve to chargers, and others away from there if need be."""
        for robot in list(self._low):
            if robot in board.stranded:
                self._lose(robot)
                continue
            if not self._can_charge(robot):
                del self._low[robot]
                self._rest(board.robots[robot])
                continue
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
        barred, number = self._barred_from(view.id), 1 + self.params.alternatives
        ranked = self.yard.chargers.nearest(view.pose, number, None, barred)
        if not ranked:
            return
        speed = self._types[view.type].limits.speed
        service = _charging(battery, view.energy, ranked[0].score / speed)
        charger = ranked[0].name
        visit = Visit(None, self.yard.pose[charger], service)
        trip = Trip(view.id, (visit,), "charge", goals=(charger,))
        because = f"{because}; {charger} is the nearest free charger"
        choice = _choice(trip, "charger", ranked, completes=False, because=because)
        choice = replace(choice, elsewhere=True)
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
            barred, number = self._barred_from(robot), 1 + self.params.alternatives
            ranked = self.yard.sheltered.nearest(view.pose, number, None, barred)
            if not ranked:
                continue
            visit = Visit(None, self.yard.pose[ranked[0].name])
            trip = Trip(robot, (visit,), "park", goals=(ranked[0].name,))
            because = f"others need {self.yard.owned(robot)}; {robot} is charged and idle"
            choice = _choice(trip, "location", ranked, completes=False, because=because)
            choice = replace(choice, elsewhere=True)
            yield choice
            if board.robots[robot].trip is trip:
                self._committed(choice, board)
                self.idle.discard(robot)
                self.yard.move(robot, ranked[0].name)
                return

    def _pop_order(self, board: Board) -> tuple[int, Order] | None:
        """Take the most urgent, then oldest, order whose shelf is available, with its number.

        Those whose shelf is not are put aside until it is, those that wait for another order
        until that one is done.
        """
        while self._open:
            entry = heappop(self._open)
            order = board.open.get(entry[2])
            if order is None:
                continue  # withdrawn
            if any(other in board.open or other not in self._known for other in order.after):
                self._later.append(entry)
                continue
            shelf = order.task.fetches or ""
            if self._is_available(shelf):
                return entry[1], order
            self._blocked.setdefault(shelf, []).append(entry)
        return None

    def _put_back(self, number: int, order: Order) -> None:
        """Let an order be the one with its number in the queue again."""
        heappush(self._open, (-order.priority, number, order.task.id))

    def _commit_fetch(self, choice: Choice, number: int, order: Order, board: Board) -> None:
        """Remember that a robot is on its way to the shelf of an order with a number."""
        self._doing[choice.trip.robot] = order, number
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
