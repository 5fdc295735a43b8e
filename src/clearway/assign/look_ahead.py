"""Orders in good sequences, stations and places chosen with the next order in mind."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from clearway.assign.nearest_idle import TRIES
from clearway.assign.place_matching import match_places
from clearway.assign.ruin_recreate import RuinRecreateParams
from clearway.assign.sequences import improve_sequences
from clearway.assign.shelf_cycle import ShelfCycle, ShelfParams
from clearway.model import Order, Scenario, to_seconds, to_ticks
from clearway.protocols import Alternative, Board, Choice, RobotView, Weights
from clearway.world.lane_times import LaneTimes

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LookAheadParams:
    """How far ahead, and how hard.

    Parameters
    ----------
    rounds
        Times that orders are taken out of the first sequences and put back.
    again
        The same whenever sequences are made anew.
    every
        Sequences are made anew after so many orders have been begun, or when new ones are known.
    horizon
        Most orders in sequences at a time, and at least twice as many as robots; more find
        nearer neighbours and cost effort.
    patience
        Seconds after which an order goes before all that came later.
    top_up
        Level below which a robot without orders charges.
    weights
        What a second of the longest sequence, one of any, and one after an order is due cost.
    """

    rounds: int = 10_000
    again: int = 300
    every: int = 10
    horizon: int = 300
    patience: float = 3600.0
    top_up: float = 0.6
    weights: Weights = field(default_factory=lambda: Weights(1.0, 0.1, 0.0, 1.0))

    def __post_init__(self) -> None:
        for name in ("rounds", "again", "every", "horizon"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be 1 or more, got {getattr(self, name)}")
        if not self.patience > 0.0:
            raise ValueError(f"patience must be above 0, got {self.patience}")
        if not 0.0 <= self.top_up <= 1.0:
            raise ValueError(f"top_up must be in [0, 1], got {self.top_up}")


class LookAhead(ShelfCycle):
    """Dispatching that knows what comes next.

    Open orders stand in one sequence per robot, made by ruin and recreate on driving times: the
    longest sequence counts most, so that ends are even. In them a shelf is believed to be stored
    where it was, which is always possible. A robot that has lifted a shelf chooses the station, and
    there the vacant place, from which the way by the place to its next shelf is shortest. A
    shelf with an idle robot under it is fetched by that one. A robot with nothing to do charges.
    Nobody begins an order while a more urgent one can be begun; orders that are due weigh their
    lateness in the sequences.

    Shelves on board are matched with vacant places all at once, so that no robot stores where
    another counts on. Memory grows with the square of the number of endpoints: some thousands.

    Parameters
    ----------
    times
        Driving times between the site's endpoints; made of the scenario's layout if not given.
    """

    station_rule = "the station with the shortest way on to the next order"
    place_rule = "the vacant place on the shortest way to the next order"

    def __init__(
        self,
        scenario: Scenario,
        params: ShelfParams | None = None,
        ahead: LookAheadParams | None = None,
        times: LaneTimes | None = None,
    ) -> None:
        super().__init__(scenario, params)
        self.ahead = ahead or LookAheadParams()
        self._times = times = times or LaneTimes.of(scenario)
        self._far = times.matrix()
        self._seed = scenario.seed
        kinds = self.yard.kind
        stations = [times.number[name] for name in self.yard.pose if kinds[name] == "station"]
        places = [times.number[name] for name in self.yard.pose if kinds[name] == "shelf"]
        loaded = self._far[np.ix_(places, stations)] + self._far[np.ix_(stations, places)].T
        service = self.params.lift + self.params.residence + self.params.lower
        self._inner = np.zeros(len(self._far))
        self._inner[places] = loaded.min(axis=1) + service
        self._sequences: dict[str, list[str]] = {robot.id: [] for robot in scenario.robots}
        self._planned: dict[str, tuple[int, str]] = {}  # orders in sequences: number, shelf
        self._shelves: set[str] = set()  # of those
        self._free: dict[str, tuple[int, int]] = {}  # endpoint, and tick, at which a robot is free
        # Robots with a shelf on board: where they are, and the stations that they may bring it to.
        self._bring: dict[str, tuple[int, list[int]]] = {}
        self._begun = 0
        self._plans = 0

    def _begin(self, board: Board) -> Iterator[Choice]:
        """Yield the trips that begin orders, then those of robots that charge early."""
        for id in [id for id in self._planned if id not in board.open]:
            self._drop(id)  # withdrawn, or given up
        has_new = self._take_up(board)
        wanting = any(not self._sequences[r] for r in self.idle.names()) and self._planned
        if has_new or wanting or self._begun >= self.ahead.every:
            self._plan(board)
        for robot in self.idle.names():
            refused = 0
            if robot not in self.idle:
                continue  # it has fetched the shelf that it was under
            for id in self._candidates(robot, board):
                order = board.open[id]
                place = self.yard.where[self._planned[id][1]] or ""
                fetcher = self.yard.owner(place) or robot  # an idle one under the shelf goes first
                if self._is_barred(fetcher, id) and self._may_others_fetch(fetcher, place, board):
                    continue
                choice = self._propose(board.robots[fetcher], order, place)
                others = self._may_others_fetch(fetcher, place, board)
                choice = replace(choice, elsewhere=others)
                yield choice
                if board.robots[fetcher].trip is choice.trip:
                    self._commit_fetch(choice, self._planned[id][0], order, board)
                    self._drop(id)
                    self._begun += 1
                else:
                    refused += 1
                    if id not in board.open:
                        self.yard.freed.append(self._planned[id][1])
                        self._drop(id)  # it cannot be done
                if fetcher == robot or refused > 1:
                    break
        if not self._planned and not self._low:
            yield from self._top_up(board)

    def _candidates(self, robot: str, board: Board) -> list[str]:
        """Return the orders that a robot may begin now.

        More urgent ones than its own come first, then those long open, then its own; before them
        all those that the robots whose they are cannot begin.
        """
        late = board.now - to_ticks(self.ahead.patience)
        old = [id for id in self._planned if to_ticks(board.open[id].release) < late]
        old.sort(key=lambda id: self._planned[id])
        own = [id for id in self._sequences[robot] if id not in old]
        ids = list(dict.fromkeys(self._strays(board) + old + own))
        priority = {id: board.open[id].priority for id in self._planned}
        if len(set(priority.values())) > 1:
            mine = [priority[id] for id in own if self._is_ready(id)]
            least = mine[0] if mine else min(priority.values())
            urgent = [id for id in self._planned if priority[id] > least and id not in ids]
            ids += sorted(urgent, key=lambda id: self._way(robot, id))
            ids.sort(key=lambda id: -priority[id])  # those alike stay in turn
        return [id for id in ids if self._is_ready(id)]

    def _strays(self, board: Board) -> list[str]:
        """Return orders in sequences of robots that cannot get there, or are refused often."""
        if not (self._barred or self._gone or board.refusals):
            return []
        return [
            id
            for robot, sequence in self._sequences.items()
            for id in sequence
            if board.refusals.get(id, 0) >= TRIES or self._is_barred(robot, id)
        ]

    def _is_barred(self, robot: str, id: str) -> bool:
        return robot in self._barred_robots(self.yard.where[self._planned[id][1]] or "")

    def _is_ready(self, id: str) -> bool:
        return super()._is_available(self._planned[id][1])

    def _way(self, robot: str, id: str) -> float:
        """Return the driving time (s) of a robot to the shelf of an order."""
        place = self.yard.where[self._planned[id][1]]
        return math.inf if place is None else self._seconds(robot, place)

    def _seconds(self, robot: str, place: str) -> float:
        return float(self._far[self._at(robot), self._times.number[place]])

    def _is_available(self, shelf: str) -> bool:
        return shelf not in self._shelves and super()._is_available(shelf)

    def _take_up(self, board: Board) -> bool:
        """Move orders from the queue into sequences, up to the horizon."""
        horizon = max(self.ahead.horizon, 2 * len(self._sequences))
        is_low = 4 * len(self._planned) < 3 * horizon
        has_new = False
        while is_low and len(self._planned) < horizon:
            taken = self._pop_order(board)
            if taken is None:
                break
            number, order = taken
            shelf = order.task.fetches or ""
            self._planned[order.task.id] = number, shelf
            self._shelves.add(shelf)
            min(self._sequences.values(), key=len).append(order.task.id)
            has_new = True
        return has_new

    def _drop(self, id: str) -> None:
        _, shelf = self._planned.pop(id)
        self._shelves.discard(shelf)
        for sequence in self._sequences.values():
            if id in sequence:
                sequence.remove(id)

    def _plan(self, board: Board) -> None:
        """Make the sequences anew, from those there are."""
        ids = list(self._planned)
        if not ids:
            return
        index = {id: k for k, id in enumerate(ids)}
        at, busy = [], []
        for robot in self._sequences:
            endpoint, tick = self._free.get(robot, (self._at(robot), 0))
            at.append(endpoint)
            busy.append(max(0.0, to_seconds(tick - board.now)))
        places = [self._times.number[self.yard.where[self._planned[id][1]] or ""] for id in ids]
        routes = improve_sequences(
            self._far,
            at,
            busy,
            places,
            self._inner[places],
            [[index[id] for id in sequence] for sequence in self._sequences.values()],
            self.ahead.weights,
            RuinRecreateParams(
                rounds=self.ahead.again if self._plans else self.ahead.rounds,
                first_temperature=0.1 if self._plans else 1.0,
            ),
            self._seed + self._plans,
            self._due(ids, board),
        )
        for robot, route in zip(self._sequences, routes, strict=True):
            self._sequences[robot] = [ids[k] for k in route]
        self._plans += 1
        self._begun = 0

    def _due(self, ids: list[str], board: Board) -> Floats | None:
        """Return in how many seconds (0 or more) orders are due; ``None``: none is."""
        due = [board.open[id].due for id in ids]
        if all(second is None for second in due):
            return None
        now = to_seconds(board.now)
        return np.array([math.inf if d is None else max(d - now, 0.0) for d in due])

    def _at(self, robot: str) -> int:
        owned = self.yard.owned(robot)
        return self._free[robot][0] if owned is None else self._times.number[owned]

    @property
    def _is_upset(self) -> bool:
        """Whether obstacles have come between shelves and places: nothing is matched any more."""
        return bool(self._barred) or not self.yard.is_whole

    def _driven_off(self, view: RobotView, now: int) -> None:
        """Take a robot to be at the endpoint nearest to where it is."""
        pose = self.yard.pose
        near = min(pose, key=lambda name: (pose[name].distance(view.pose), name))
        self._free[view.id] = self._times.number[near], now
        self._bring.pop(view.id, None)

    def _next_place(self, robot: str) -> int | None:
        """Return where the shelf of a robot's next order is, if it has one."""
        for id in self._sequences[robot]:
            place = self.yard.where[self._planned[id][1]]
            if place is not None:
                return self._times.number[place]
        return None

    def _propose(self, view: RobotView, order: Order, place: str) -> Choice:
        """Return the trip to an order's shelf, beside the nearest other orders."""
        far = self._far[self._at(view.id)]
        others = []
        for id, (_, shelf) in self._planned.items():
            other = self.yard.where[shelf]
            if id != order.task.id and other is not None:
                others.append(Alternative(id, float(far[self._times.number[other]])))
        others.sort(key=lambda one: one.score)
        best = Alternative(order.task.id, float(far[self._times.number[place]]))
        because = f"{order.task.id} is next in the sequence of {view.id}"
        return self._fetch(
            view, order, "order", [best, *others[: self.params.alternatives]], because
        )

    def _stations(self, view: RobotView, shelf: str, number: int) -> list[Alternative]:
        at = self._at(view.id)
        barred = self._barred_from(view.id)
        names = [name for name in self.yard.stations.names() if name not in barred]
        stations = [self._times.number[name] for name in names]
        if not stations:
            return []
        if self._is_upset:
            return _ranked(names, self._far[at, stations], number)
        self._bring[view.id] = at, stations
        place = self._match()[view.id]
        return _ranked(names, self._far[at, stations] + self._far[stations, place], number)

    def _places(self, view: RobotView, number: int) -> list[Alternative]:
        barred = self._barred_from(view.id)
        names = [name for name in self.yard.vacant.names() if name not in barred]
        places = [self._times.number[name] for name in names]
        at = self._at(view.id)
        onward = self._far[at, places] + self._onward(view.id, places)
        if self._is_upset:
            return _ranked(names, onward, number)
        best = places.index(self._match(storing=view.id)[view.id])
        ranked = _ranked(names, onward, number)
        mine = Alternative(names[best], float(onward[best]))
        return [mine, *(other for other in ranked if other.name != mine.name)][:number]

    def _match(self, storing: str | None = None) -> dict[str, int]:
        """Give each shelf on board a place, also those lifted and not left, with theirs."""
        places = [self._times.number[name] for name in self.yard.vacant.names()]
        vacant = len(places)
        ends = [at for at, _ in self._bring.values()]
        places += [at for at in ends if self.yard.kind[self._times.names[at]] == "shelf"]
        onward = {robot: self._onward(robot, places) for robot in self._bring}
        return match_places(self._far, self._bring, places, onward, storing, vacant)

    def _onward(self, robot: str, places: list[int]) -> Floats:
        """Return times from places to the next shelf of a robot, if it has one."""
        goal = self._next_place(robot)
        return np.zeros(len(places)) if goal is None else self._far[places, goal]

    def _committed(self, choice: Choice, board: Board) -> None:
        """Remember where and when a robot will be free."""
        trip = choice.trip
        here, goal = self._at(trip.robot), self._times.number[trip.goals[0] or ""]
        seconds = float(self._far[here, goal]) + trip.visits[0].service
        if trip.purpose == "fetch":
            seconds += self._inner[goal] - self.params.lift
        elif trip.purpose == "deliver":
            station = goal
            seconds += float(self._far[goal, here]) + self.params.lower
            goal = here
            self._bring[trip.robot] = station, [station]
        else:
            self._bring.pop(trip.robot, None)
        self._free[trip.robot] = goal, board.now + to_ticks(seconds)

    def _top_up(self, board: Board) -> Iterator[Choice]:
        """Send robots that have nothing to do to free chargers."""
        for robot in self.idle.names():
            view = board.robots[robot]
            battery = self._types[view.type].battery
            if battery is None or view.energy >= self.ahead.top_up or not len(self.yard.chargers):
                continue
            because = f"{robot} has no order and is at {100 * view.energy:.0f} %"
            yield from self._go_charging(view, battery, because, board)


def _ranked(names: list[str], scores: Floats, number: int) -> list[Alternative]:
    order = np.argsort(scores, kind="stable")[:number]
    return [Alternative(names[k], float(scores[k])) for k in order]
