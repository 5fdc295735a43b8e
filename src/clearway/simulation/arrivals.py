"""Orders that arrive while a scenario runs: those listed, and those of its streams."""

import heapq
import random
from collections import Counter, deque
from collections.abc import Callable, Iterator

from clearway.model import (
    Order,
    OrderStream,
    Scenario,
    Site,
    Task,
    Visit,
    to_seconds,
    to_ticks,
)


class Arrivals:
    """A scenario's orders in the order of their release; equal ones as listed, streams last.

    Each stream has random generators of its own, for times and for what is asked for, made of
    the seed and its name: neither another stream nor how the run goes changes when its orders
    arrive. An order is open from its arrival until it is taken up.

    Raises
    ------
    ValueError
        If a stream asks for a kind of zone that the site has none of.
    """

    def __init__(self, scenario: Scenario, seed: int) -> None:
        simulation = scenario.simulation
        self._ids = {order.task.id for order in scenario.orders}
        self._shelves = tuple(zone.name for zone in scenario.site.zones_of("shelf"))
        self._now = 0
        self._fetched: Counter[str] = Counter()
        self._open: dict[str, tuple[str | None, _Source | None]] = {}
        releases = [(to_ticks(order.release), order) for order in scenario.orders]
        self._listed = deque(sorted(releases, key=lambda release: release[0]))
        self._sources = [
            _Source(stream, simulation.until, scenario.site, seed) for stream in simulation.streams
        ]
        # Ticks at which sources have an order, each with its place among them.
        self._due = [
            (tick, i) for i, source in enumerate(self._sources) for tick in source.first_ticks()
        ]
        heapq.heapify(self._due)

    def next_tick(self) -> int | None:
        """Return the tick of the next order; ``None``: there is none until one is taken up."""
        ticks = [self._listed[0][0]] if self._listed else []
        if self._due:
            ticks.append(self._due[0][0])
        return min(ticks, default=None)

    def pop(self, now: int) -> list[Order]:
        """Return the orders that have arrived by tick ``now`` and were not returned before."""
        self._now = max(self._now, now)
        arrived: list[Order] = []
        while (tick := self.next_tick()) is not None and tick <= now:
            if self._listed and self._listed[0][0] == tick:
                order, source = self._listed.popleft()[1], None
            else:
                order, source = self._draw()
            fetches = order.task.fetches
            if fetches is not None:
                self._fetched[fetches] += 1
            self._open[order.task.id] = (fetches, source)
            arrived.append(order)
        return arrived

    def taken(self, order: str, now: int) -> None:
        """Learn that a robot has taken up an open order, by its id.

        Raises
        ------
        KeyError
            If no such order is open.
        """
        self._now = max(self._now, now)
        fetches, source = self._open.pop(order)
        if fetches is not None:
            self._fetched[fetches] -= 1
            if not self._fetched[fetches]:
                del self._fetched[fetches]
        if source is not None and source.follows(now):
            heapq.heappush(self._due, (now, self._sources.index(source)))

    @property
    def exhausted(self) -> bool:
        """Whether no more orders will arrive, whatever is taken up."""
        if self._listed or self._due:
            return False
        return not any(
            source is not None and source.follows(self._now) for _, source in self._open.values()
        )

    def _draw(self) -> tuple[Order, "_Source"]:
        """Return the next order of the streams, and its own."""
        tick, i = heapq.heappop(self._due)
        source = self._sources[i]
        if (later := source.next_tick()) is not None:
            heapq.heappush(self._due, (later, i))
        name = source.next_id()
        while name in self._ids:
            name = source.next_id()
        return source.order(name, tick, self._free_shelf), source

    def _free_shelf(self, rng: random.Random) -> str:
        """Draw a shelf that no open order fetches; any, where all are fetched."""
        all_fetched = len(self._fetched) == len(self._shelves)
        while True:
            shelf = rng.choice(self._shelves)
            if all_fetched or shelf not in self._fetched:
                return shelf


class _Source:
    """One stream: when its orders arrive, and what they ask for."""

    def __init__(self, stream: OrderStream, until: float | None, site: Site, seed: int) -> None:
        self._stream = stream
        ends = [end for end in (stream.last, until) if end is not None]
        self._end = to_ticks(min(ends))
        self._poses = {
            draw.kind: [zone.pose for zone in site.zones_of(draw.kind) if zone.pose is not None]
            for draw in stream.draws
        }
        asked = {"shelf": site.zones_of("shelf")} if stream.fetch else self._poses
        for kind, places in asked.items():
            if not places:
                raise ValueError(f"stream {stream.name} asks for a {kind}; add a zone of that kind")
        self._times = self._ticks(random.Random(f"{seed} times of {stream.name}"))
        self._draws = random.Random(f"{seed} draws of {stream.name}")
        self._number = 0

    def _ticks(self, rng: random.Random) -> Iterator[int]:
        """Yield the ticks of a Poisson process, from first to end."""
        if self._stream.rate is None:
            return
        seconds = self._stream.first
        while True:
            seconds += rng.expovariate(self._stream.rate / 3600.0)
            if (tick := to_ticks(seconds)) >= self._end:
                return
            yield tick

    def next_tick(self) -> int | None:
        """Return the tick of the next order that waits for nobody."""
        return next(self._times, None)

    def first_ticks(self) -> list[int]:
        """Return the ticks of the orders that are known from the beginning."""
        first = to_ticks(self._stream.first)
        if self._stream.open is not None:
            return [first] * self._stream.open if first < self._end else []
        tick = self.next_tick()
        return [] if tick is None else [tick]

    def follows(self, now: int) -> bool:
        """Whether an order that is taken up at tick ``now`` is followed by a new one."""
        return self._stream.open is not None and now < self._end

    def next_id(self) -> str:
        """Return the id of the next order."""
        self._number += 1
        return f"{self._stream.name}-{self._number}"

    def order(self, name: str, tick: int, shelf: Callable[[random.Random], str]) -> Order:
        """Return the order of a tick; ``shelf`` draws one."""
        stream, rng, release = self._stream, self._draws, to_seconds(tick)
        visits = tuple(
            Visit(name, rng.choice(self._poses[draw.kind]), draw.service, draw.load)
            for draw in stream.draws
        )
        task = Task(name, visits, fetches=shelf(rng) if stream.fetch else None)
        due = None if stream.due_after is None else release + stream.due_after
        return Order(task, release, due, stream.priority)
