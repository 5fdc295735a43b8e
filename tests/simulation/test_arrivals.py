"""When orders arrive, and which."""

import math
from collections import Counter
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clearway.model import (
    Draw,
    Footprint,
    Limits,
    Order,
    OrderStream,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Simulation,
    Site,
    Task,
    Visit,
    Zone,
    to_ticks,
)
from clearway.simulation.arrivals import Arrivals

BOX = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
SHELVES = [Zone(f"g{i}", "shelf", BOX, Pose(float(i), 2.0, 0.0)) for i in range(1, 6)]
DOCKS = [Zone(f"p{i}", "station", BOX, Pose(float(i), 8.0, 0.0)) for i in range(1, 3)]
SITE = Site(((0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)), (), (*SHELVES, *DOCKS))
CART = RobotType("cart", Footprint(radius=0.4), "holonomic", Limits(1.0))
HOUR = 3_600_000
CARRY = (Draw("shelf", 5.0, "pick"), Draw("station", 3.0, "drop"))


def running(*streams: OrderStream, orders: tuple[Order, ...] = (), until: float = 3600.0):
    robots = (Robot("r1", "cart", Pose(10.0, 10.0, 0.0)),)
    simulation = Simulation(until, streams)
    return Scenario("s", SITE, {"cart": CART}, robots, orders, simulation=simulation)


def fetch(name: str, shelf: str, release: float = 0.0) -> Order:
    return Order(Task(name, (), None, shelf), release)


def all_of(arrivals: Arrivals) -> list[Order]:
    """Every order of streams that wait for nobody, each taken up when it arrives."""
    orders = []
    while (tick := arrivals.next_tick()) is not None:
        for order in arrivals.pop(tick):
            assert to_ticks(order.release) == tick
            arrivals.taken(order.task.id, tick)
            orders.append(order)
    assert arrivals.exhausted
    return orders


def test_listed_orders_arrive_at_their_release_and_equal_ones_as_listed() -> None:
    """Nothing is returned early, late or twice."""
    listed = (fetch("c", "g3", 2.0), fetch("a", "g1", 0.0), fetch("b", "g2", 2.0))
    arrivals = Arrivals(running(orders=listed), 0)
    assert arrivals.next_tick() == 0
    assert [order.task.id for order in arrivals.pop(0)] == ["a"]
    assert arrivals.pop(1999) == []
    assert not arrivals.exhausted
    assert arrivals.next_tick() == 2000
    assert [order.task.id for order in arrivals.pop(5000)] == ["c", "b"]
    assert arrivals.next_tick() is None
    assert arrivals.exhausted


def test_orders_of_a_stream_are_what_it_says() -> None:
    """Visits at poses of zones of the kinds asked for; due a while after release; ids count up."""
    stream = OrderStream("s", rate=60.0, draws=CARRY, due_after=90.0, priority=2.0)
    orders = all_of(Arrivals(running(stream), 1))
    assert [order.task.id for order in orders] == [f"s-{i + 1}" for i in range(len(orders))]
    shelves, docks = ({zone.pose for zone in zones} for zones in (SHELVES, DOCKS))
    for order in orders:
        pick, drop = order.task.visits
        assert pick.pose in shelves
        assert drop.pose in docks
        assert (pick.service, pick.load, drop.service, drop.load) == (5.0, "pick", 3.0, "drop")
        assert order.due == order.release + 90.0
        assert order.priority == 2.0
    # Each is drawn: of 5 shelves and 2 docks none is missing among some 60 orders.
    assert {order.task.visits[0].pose for order in orders} == shelves
    assert {order.task.visits[1].pose for order in orders} == docks


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**63 - 1), rate=st.floats(1.0, 2000.0), first=st.floats(0.0, 1800.0))
def test_a_stream_keeps_its_rate_and_its_hours(seed: int, rate: float, first: float) -> None:
    """Counts of a Poisson process lie within 5 sigma (and one) of their mean."""
    stream = OrderStream("s", rate=rate, draws=CARRY, first=first, last=3000.0)
    releases = [order.release for order in all_of(Arrivals(running(stream), seed))]
    assert all(first <= release < 3000.0 for release in releases)
    mean = rate * (3000.0 - first) / 3600.0
    assert abs(len(releases) - mean) <= 5.0 * math.sqrt(mean) + 1.0


def test_times_between_orders_are_exponential() -> None:
    """The share of gaps above the mean is 1/e, within 5 sigma."""
    stream = OrderStream("s", rate=7200.0, draws=CARRY)
    times = [order.release for order in all_of(Arrivals(running(stream, until=7200.0), 5))]
    long = sum(b - a > 0.5 for a, b in pairwise(times)) / (len(times) - 1)
    share = math.exp(-1.0)
    assert abs(long - share) <= 5.0 * math.sqrt(share * (1.0 - share) / len(times))


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32), rates=st.lists(st.floats(10.0, 300.0), min_size=1, max_size=3))
def test_streams_do_not_touch_each_other(seed: int, rates: list[float]) -> None:
    """Same seed, same orders; and each stream's are the same with the others or alone."""
    streams = [OrderStream(f"s{i}", rate=rate, draws=CARRY) for i, rate in enumerate(rates)]
    together = all_of(Arrivals(running(*streams), seed))
    assert together == all_of(Arrivals(running(*streams), seed))
    assert [o.release for o in together] == sorted(o.release for o in together)
    for stream in streams:
        alone = all_of(Arrivals(running(stream), seed))
        assert [o for o in together if o.task.id.startswith(f"{stream.name}-")] == alone


def test_seeds_and_names_make_different_orders() -> None:
    """Two streams of one rate, or one stream under two seeds, do not march in step."""
    one, two = (OrderStream(name, rate=100.0, draws=CARRY) for name in ("one", "two"))
    orders = all_of(Arrivals(running(one, two), 0))
    releases = [{o.release for o in orders if o.task.id.startswith(name)} for name in ("one", "t")]
    assert not releases[0] & releases[1]
    assert all_of(Arrivals(running(one), 0)) != all_of(Arrivals(running(one), 1))


def test_a_stream_keeps_its_number_of_open_orders() -> None:
    """One that is taken up is followed at once, until the stream ends."""
    stream = OrderStream("s", open=3, draws=CARRY, first=10.0, last=100.0)
    arrivals = Arrivals(running(stream), 0)
    assert arrivals.next_tick() == 10_000
    assert [o.task.id for o in arrivals.pop(10_000)] == ["s-1", "s-2", "s-3"]
    assert arrivals.next_tick() is None
    assert not arrivals.exhausted
    arrivals.taken("s-2", 50_000)
    assert arrivals.next_tick() == 50_000
    (order,) = arrivals.pop(50_000)
    assert (order.task.id, order.release) == ("s-4", 50.0)
    arrivals.taken("s-1", 100_000)
    assert arrivals.next_tick() is None
    assert arrivals.exhausted


def test_no_open_order_fetches_the_shelf_of_another() -> None:
    """Five shelves, four open orders, 200 taken up in turn: all different at all times."""
    stream = OrderStream("s", open=4, fetch=True)
    arrivals = Arrivals(running(stream), 0)
    open_now = {o.task.id: o.task.fetches for o in arrivals.pop(0)}
    drawn: Counter[str | None] = Counter()
    for k in range(200):
        assert len(set(open_now.values())) == 4
        first = next(iter(open_now))
        arrivals.taken(first, k)
        del open_now[first]
        (order,) = arrivals.pop(k)
        drawn[order.task.fetches] += 1
        open_now[order.task.id] = order.task.fetches
    assert set(drawn) == {zone.name for zone in SHELVES}


def test_listed_orders_hold_their_shelves_from_release_on() -> None:
    """A stream draws the one shelf that is left; with none left, any."""
    listed = tuple(fetch(f"o{i}", f"g{i}") for i in range(1, 5))
    arrivals = Arrivals(running(OrderStream("s", open=1, fetch=True), orders=listed), 3)
    *_, drawn = arrivals.pop(0)
    assert drawn.task.fetches == "g5"
    crowd = OrderStream("t", rate=3600.0, fetch=True, last=20.0)
    arrivals = Arrivals(running(crowd, orders=listed), 3)
    orders = arrivals.pop(HOUR)[4:]
    assert len(orders) > 5
    assert orders[0].task.fetches == "g5"


def test_ids_of_listed_orders_are_left_to_them() -> None:
    """The stream counts on past an id that is taken."""
    listed = (fetch("s-1", "g1"),)
    arrivals = Arrivals(running(OrderStream("s", open=2, fetch=True), orders=listed), 0)
    assert [o.task.id for o in arrivals.pop(0)] == ["s-1", "s-2", "s-3"]


def test_streams_end_with_the_run() -> None:
    """A stream without an end of its own stops at the second at which the run does."""
    scenario = running(OrderStream("s", rate=3600.0, draws=CARRY), until=60.0)
    releases = [order.release for order in all_of(Arrivals(scenario, 0))]
    assert 50.0 < max(releases) < 60.0
    late = replace(scenario, simulation=Simulation(60.0, (OrderStream("s", open=1, fetch=True),)))
    arrivals = Arrivals(late, 0)
    arrivals.pop(0)
    arrivals.taken("s-1", 60_000)
    assert arrivals.exhausted


def test_an_order_is_taken_up_once() -> None:
    """Taking up what is not open is a mistake of the caller."""
    arrivals = Arrivals(running(orders=(fetch("a", "g1"),)), 0)
    arrivals.pop(0)
    arrivals.taken("a", 0)
    with pytest.raises(KeyError):
        arrivals.taken("a", 0)


def test_a_stream_that_nothing_can_serve_is_refused() -> None:
    """The message names the stream and what the site lacks."""
    with pytest.raises(ValueError, match="stream s asks for a charger; add a zone"):
        Arrivals(running(OrderStream("s", open=1, draws=(Draw("charger"),))), 0)


def test_a_visit_draws_every_zone_of_its_kind_evenly() -> None:
    """2000 draws among 5 shelves: each within 5 sigma of 400."""
    stream = OrderStream("s", rate=7200.0, draws=(Draw("shelf"),))
    orders = all_of(Arrivals(running(stream), 9))
    counts = Counter(order.task.visits[0].pose for order in orders)
    mean = len(orders) / 5.0
    assert all(abs(count - mean) <= 5.0 * math.sqrt(mean) for count in counts.values())
    assert orders[0].task.visits == (Visit("s-1", orders[0].task.visits[0].pose),)
