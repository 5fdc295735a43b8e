"""What robots do that know which orders come next."""

import random
from dataclasses import replace

import pytest
from tests.assign.lone_fleet import (
    by_purpose,
    check_ownership,
    check_shelves,
    run,
)

from clearway.assign import LookAhead, LookAheadParams, NearestIdle
from clearway.model import Battery, Layout, Order, Scenario, Task
from clearway.world.lane_times import LaneTimes
from clearway.world.shelf_batch import shelf_batch

PAPER = Layout("bidirectional")
SMALL = Layout("bidirectional", (4, 3), 2)


@pytest.fixture(scope="module")
def times() -> LaneTimes:
    return LaneTimes.of(shelf_batch(PAPER, 1, 0, 0))


def with_orders(scenario: Scenario, *fetches: tuple[str, float]) -> Scenario:
    """Give a scenario orders: shelves with release times."""
    orders = [Order(Task(f"o{k}", (), fetches=s), t) for k, (s, t) in enumerate(fetches)]
    return replace(scenario, orders=tuple(orders))


@pytest.mark.parametrize("seed", range(3))
def test_a_batch_ends_a_fifth_sooner(seed: int, times: LaneTimes) -> None:
    """50 orders, 10 robots: empty ways are half of what they are for nearest idle."""
    scenario = shelf_batch(PAPER, 10, 50, seed)
    nearest = run(scenario, NearestIdle(scenario), times)
    ahead = run(scenario, LookAhead(scenario, times=times), times)
    assert not ahead.open
    assert ahead.makespan < 0.8 * nearest.makespan
    empty = [
        sum(end - begin for begin, end, *_ in by_purpose(log, "fetch")) for log in (ahead, nearest)
    ]
    assert empty[0] < 0.5 * empty[1]


def test_a_shelf_goes_where_the_next_one_is() -> None:
    """One robot is to fetch two shelves side by side: it comes back to where the first was."""
    scenario = with_orders(shelf_batch(PAPER, 1, 0, 0), ("g100", 0.0), ("g101", 0.0))
    log = run(scenario, LookAhead(scenario), LaneTimes.of(scenario))
    first, store, second = log.driven[0][2], log.driven[2][2], log.driven[3][2]
    assert {first.chosen, second.chosen} == {"o0", "o1"}
    assert store.trip.goals == first.trip.goals
    assert second.score <= 3.0  # out, along, and in again
    assert [a.name for a in first.alternatives] == [second.chosen]


@pytest.mark.parametrize("seed", range(6))
def test_no_endpoint_has_two_owners(seed: int) -> None:
    """With orders that arrive, again for the same shelves, refusals and low batteries."""
    draw = random.Random(seed)
    battery = Battery(draw.choice((200.0, 500.0)), charging=100.0)
    base = shelf_batch(SMALL, 7, 0, seed, energy=(0.15, 0.4))
    base = replace(base, robot_types={"agv": replace(base.robot_types["agv"], battery=battery)})
    shelves = [zone.name for zone in base.site.zones_of("shelf")]
    orders = [(draw.choice(shelves), round(draw.uniform(0.0, 500.0), 3)) for _ in range(100)]
    scenario = with_orders(base, *orders)
    params = LookAheadParams(horizon=20)
    log = run(
        scenario, LookAhead(scenario, ahead=params), refuse=lambda c, now: draw.random() < 0.1
    )
    assert not log.open
    assert by_purpose(log, "charge")
    check_ownership(scenario, log)
    check_shelves(scenario, log)


def test_orders_to_come_are_unknown() -> None:
    """Until the last order is released, everything goes as if it did not exist."""
    base = shelf_batch(SMALL, 3, 8, 2)
    later = Order(Task("later", (), fetches="g5"), 70.0)
    scenario = replace(base, orders=(*base.orders, later))
    logs = [run(s, LookAhead(s)) for s in (base, scenario)]
    before = [[one for one in log.driven if one[0] < 70_000] for log in logs]
    assert before[0] == before[1]
    assert len(before[0]) > 9


def test_runs_repeat_exactly() -> None:
    scenario = shelf_batch(SMALL, 4, 20, 7)
    assert run(scenario, LookAhead(scenario)).driven == run(scenario, LookAhead(scenario)).driven


def test_long_open_orders_go_first() -> None:
    """Near orders keep coming; one far away is fetched all the same, when patience ends."""
    base = shelf_batch(PAPER, 1, 0, 0)
    near = [(f"g{1 + k % 9}", 30.0 * k) for k in range(60)]
    scenario = with_orders(base, ("g406", 0.0), *near)
    begun = {}
    for patience in (200.0, 1200.0):
        ahead = LookAhead(scenario, ahead=LookAheadParams(patience=patience))
        log = run(scenario, ahead, LaneTimes.of(scenario))
        begun[patience] = next(b for b, _, c in log.driven if c.trip.order == "o0") / 1000.0
    assert 200.0 <= begun[200.0] < 300.0
    assert begun[1200.0] > begun[200.0]


def test_more_urgent_orders_go_first() -> None:
    """While an urgent order can be begun nobody begins another, wherever its shelf is."""
    base = shelf_batch(SMALL, 3, 24, 5)
    level = {order.task.id: float(k % 3) for k, order in enumerate(base.orders)}
    orders = tuple(replace(order, priority=level[order.task.id]) for order in base.orders)
    scenario = replace(base, orders=orders)
    log = run(scenario, LookAhead(scenario))
    fetched = [level[c.trip.order or ""] for _, _, c in log.driven if c.trip.purpose == "fetch"]
    assert fetched == [2.0] * 8 + [1.0] * 8 + [0.0] * 8


def test_alike_priorities_and_no_due_times_change_nothing() -> None:
    base = shelf_batch(SMALL, 4, 20, 7)
    alike = replace(base, orders=tuple(replace(o, priority=3.0) for o in base.orders))
    one, other = (run(s, LookAhead(s)).driven for s in (base, alike))
    assert [(b, e, c.trip) for b, e, c in one] == [(b, e, c.trip) for b, e, c in other]


@pytest.mark.parametrize("seed", range(3))
def test_orders_that_are_due_are_less_late(seed: int) -> None:
    """Every fourth of 24 orders is due after 100 s: their lateness in sum is less than halved."""
    base = shelf_batch(SMALL, 3, 24, seed)
    soon = {order.task.id for order in base.orders[::4]}
    orders = tuple(
        replace(order, due=100.0 if order.task.id in soon else None) for order in base.orders
    )
    late = []
    for scenario in (base, replace(base, orders=orders)):
        log = run(scenario, LookAhead(scenario))
        stored = {c.trip.order: e / 1000.0 for _, e, c in log.driven if c.trip.purpose == "store"}
        late.append(sum(max(0.0, stored[id] - 100.0) for id in soon))
    assert late[1] < 0.5 * late[0]


def test_an_order_waits_for_those_before_it() -> None:
    base = shelf_batch(SMALL, 3, 9, 4)
    first, *others = base.orders
    scenario = replace(base, orders=(replace(first, after=(others[-1].task.id,)), *others))
    log = run(scenario, LookAhead(scenario))
    assert not log.open
    begin = {c.trip.order: b for b, _, c in log.driven if c.trip.purpose == "fetch"}
    stored = {c.trip.order: e for _, e, c in log.driven if c.trip.purpose == "store"}
    assert begin[first.task.id] >= stored[others[-1].task.id]


def test_a_robot_with_nothing_to_do_charges() -> None:
    """At 50 % after the only order it charges, at 70 % it does not."""
    for level, expected in ((0.5, 1), (0.7, 0)):
        base = shelf_batch(SMALL, 1, 1, 0, energy=(level, level))
        log = run(base, LookAhead(base))
        charges = [c for _, _, c in log.driven if c.trip.purpose == "charge"]
        assert len(charges) == expected
        assert all("has no order" in c.because for c in charges)


def test_who_rests_under_a_shelf_fetches_it() -> None:
    """Robots swap nothing: each of three takes the order for the shelf that it is under."""
    base = shelf_batch(SMALL, 3, 0, 0)
    names = {zone.pose: zone.name for zone in base.site.zones}
    under = [names[robot.start] for robot in base.robots]
    scenario = with_orders(base, *((shelf, 0.0) for shelf in (under[2], under[0], under[1])))
    log = run(scenario, LookAhead(scenario))
    fetches = {c.trip.robot: c.trip.goals[0] for b, _, c in log.driven if c.trip.purpose == "fetch"}
    assert fetches == {robot.id: shelf for robot, shelf in zip(base.robots, under, strict=True)}


def test_settings_that_cannot_be_are_named() -> None:
    for name, value in (("rounds", 0), ("every", 0), ("patience", 0.0), ("top_up", 1.5)):
        with pytest.raises(ValueError, match=f"{name} must be"):
            LookAheadParams(**{name: value})  # type: ignore[arg-type]
