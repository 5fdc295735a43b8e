"""Orders with visits that arrive: the nearest one away from others, or the oldest one."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from clearway.assign import NearestOrder, NearestOrderParams, OldestOrder
from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Order,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
    Zone,
)
from clearway.protocols import Board, Choice, Dispatcher, RobotView

CART = RobotType(
    "cart", Footprint((((-1, -1), (1, -1), (1, 1), (-1, 1)),)), "holonomic", Limits(1.0)
)
FORK = replace(CART, name="fork", capabilities=frozenset({"lift"}))
SHELF = Obstacle(polygon=((20.0, 40.0), (80.0, 40.0), (80.0, 42.0), (20.0, 42.0)))  # two aisles


DOCK = Pose(95.0, 5.0, 0.0)


def order(
    name: str, x: float, y: float, release: float = 0.0, to: Pose | None = None, **more: object
) -> Order:
    """Pick at a pose; drop there too where it is not told, so that only the way there counts."""
    visits = (
        Visit(name, Pose(x, y, 0.0), 5.0, "pick", needs=more.pop("needs", None)),  # type: ignore[arg-type]
        Visit(name, to or Pose(x, y, 0.0), 5.0, "drop"),
    )
    robot = more.pop("robot", None)
    return Order(Task(name, visits, robot=robot), release, **more)  # type: ignore[arg-type]


def hall(*robots: tuple[str, float, float], kind: RobotType = CART) -> Scenario:
    square = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
    zones = (
        Zone("bay", "parking", square, Pose(1.0, 1.0, 0.0)),
        Zone("dock", "station", square, DOCK),
    )
    bounds = ((0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0))
    fleet = tuple(Robot(id, kind.name, Pose(x, y, 0.0)) for id, x, y in robots)
    return Scenario("hall", Site(bounds, (SHELF,), zones), {kind.name: kind}, fleet, ())


def board(scenario: Scenario, orders: Sequence[Order], now: int = 0) -> Board:
    views = {r.id: RobotView(r.id, r.type, r.start) for r in scenario.robots}
    open_orders = {o.task.id: o for o in orders}
    return Board(now, views, open_orders, arrived=tuple(open_orders))


def commit(state: Board, choice: Choice) -> None:
    trip = choice.trip
    view = state.robots[trip.robot]
    state.robots[trip.robot] = replace(view, trip=trip, ready=state.now + 100_000)
    state.taken[trip.order or ""] = trip.robot


def decide(
    dispatcher: Dispatcher, state: Board, refused: Sequence[tuple[str, str]] = ()
) -> list[tuple[str, str]]:
    """Return (robot, order) as wanted; all are committed but those refused."""
    wanted = []
    for choice in dispatcher(state):
        wanted.append((choice.trip.robot, choice.trip.order or ""))
        if wanted[-1] not in refused:
            commit(state, choice)
    return wanted


NEAREST = [("a", 10.0, 30.0), ("b", 10.0, 60.0)]


def test_pairs_are_taken_in_the_order_of_their_distance() -> None:
    """Robot b is 5 m from o1, a 10 m from o2; o3 is left."""
    scenario = hall(*NEAREST)
    state = board(
        scenario, [order("o3", 90.0, 90.0), order("o2", 20.0, 30.0), order("o1", 15.0, 60.0)]
    )
    assert decide(NearestOrder(scenario), state) == [("b", "o1"), ("a", "o2")]


def test_a_trip_has_the_orders_visits_and_may_rest_in_any_bay() -> None:
    scenario = hall(("a", 10.0, 30.0))
    state = board(scenario, [order("o1", 15.0, 60.0, to=DOCK, due=300.0), order("o2", 90.0, 90.0)])
    (choice,) = NearestOrder(scenario)(state)
    assert choice.trip.visits == state.open["o1"].visits
    assert choice.trip.visits[-1].due == 300.0
    assert choice.trip.goals == (None, "dock")
    assert choice.trip.rests == ("bay",)
    assert (choice.kind, choice.chosen, choice.completes) == ("order", "o1", True)
    assert [a.name for a in choice.alternatives] == ["o2"]
    assert choice.score < choice.alternatives[0].score


def test_an_aisle_where_another_works_is_avoided() -> None:
    """From (10, 50), o2 at (30, 35) below the shelf is nearer than o3 above it at (35, 47).

    But a serves o1 at (50, 35), in sight of o2; from o3 the shelf hides it.
    """
    scenario = hall(("a", 45.0, 35.0), ("b", 10.0, 42.0))
    orders = [order("o1", 50.0, 35.0), order("o2", 30.0, 35.0), order("o3", 35.0, 47.0)]
    state = board(scenario, orders)
    assert decide(NearestOrder(scenario), state) == [("a", "o1"), ("b", "o3")]
    state = board(scenario, orders)
    careless = NearestOrder(scenario, NearestOrderParams(crowd=0.0))
    assert decide(careless, state) == [("a", "o1"), ("b", "o2")]


def test_who_has_served_its_pick_is_in_nobodys_way() -> None:
    """A's trip of 100 s has 5 m to the pick and 54 m on: the aisle is free after some 10 s."""
    scenario = hall(("a", 45.0, 35.0), ("b", 10.0, 42.0))
    orders = [order("o2", 30.0, 35.0), order("o3", 35.0, 47.0)]
    for now, expected in ((5_000, "o3"), (20_000, "o2")):
        dispatcher = NearestOrder(scenario)
        state = board(scenario, [order("o1", 50.0, 35.0, to=DOCK)])
        later = state.robots.pop("b")
        assert decide(dispatcher, state) == [("a", "o1")]
        state.robots["b"] = later
        state.now = now
        state.open |= {o.task.id: o for o in orders}
        assert decide(dispatcher, state) == [("b", expected)]


def test_old_orders_get_their_turn() -> None:
    """At 0.1 m a second, 80 m farther away is made up for by 800 s more of waiting."""
    scenario = hall(("a", 10.0, 30.0))
    for now, expected in ((700_000, "near"), (900_000, "far")):
        far = order("far", 95.0, 30.0, release=0.0)
        state = board(scenario, [far, order("near", 15.0, 30.0, release=now / 1000.0)], now)
        params = NearestOrderParams(age=0.1)
        assert decide(NearestOrder(scenario, params), state) == [("a", expected)]


def test_remote_orders_are_not_left_to_the_end() -> None:
    """From (50, 20) it is 40 m to the deep order and 30 m to the other one.

    But whoever comes from the dock drives 86 m to the deep one, and 21 m to the other.
    """
    scenario = hall(("a", 50.0, 20.0))
    orders = [order("deep", 10.0, 20.0, to=DOCK), order("other", 80.0, 20.0, to=DOCK)]
    assert decide(NearestOrder(scenario), board(scenario, orders)) == [("a", "deep")]


def test_urgent_orders_go_first() -> None:
    scenario = hall(("a", 10.0, 30.0))
    state = board(scenario, [order("o1", 15.0, 30.0), order("o2", 90.0, 90.0, priority=1.0)])
    assert decide(NearestOrder(scenario), state) == [("a", "o2")]


def test_what_is_refused_goes_to_another() -> None:
    """A robot is tried once; the order stays for the next one."""
    scenario = hall(*NEAREST)
    orders = [order("o1", 15.0, 60.0), order("o2", 90.0, 90.0)]
    wanted = decide(NearestOrder(scenario), board(scenario, orders), refused=[("b", "o1")])
    assert wanted == [("b", "o1"), ("a", "o1")]
    wanted = decide(OldestOrder(scenario), board(scenario, orders), refused=[("b", "o1")])
    assert wanted == [("b", "o1"), ("a", "o1"), ("b", "o2")]


def test_the_oldest_order_goes_to_the_nearest_robot() -> None:
    scenario = hall(*NEAREST, ("c", 50.0, 90.0))
    state = board(scenario, [order("o1", 90.0, 90.0), order("o2", 10.0, 59.0)])
    choices = []
    dispatcher = OldestOrder(scenario)
    for choice in dispatcher(state):
        choices.append(choice)
        commit(state, choice)
    assert [(c.chosen, c.trip.order) for c in choices] == [("c", "o1"), ("b", "o2")]
    assert [a.name for a in choices[0].alternatives] == ["b", "a"]


@pytest.mark.parametrize("rule", [NearestOrder, OldestOrder])
def test_more_urgent_orders_go_first(rule: type[NearestOrder] | type[OldestOrder]) -> None:
    scenario = hall(("a", 10.0, 10.0))
    orders = [order("o1", 10.0, 12.0), order("o2", 90.0, 90.0, priority=1.0)]
    assert decide(rule(scenario), board(scenario, orders)) == [("a", "o2")]


@pytest.mark.parametrize("rule", [NearestOrder, OldestOrder])
def test_only_who_may_and_can_is_asked(rule: type[NearestOrder] | type[OldestOrder]) -> None:
    """Orders may need a capability, be kept for a robot, be had by another, or have to wait."""
    scenario = hall(*NEAREST)
    lifting = [order("o1", 15.0, 30.0, needs="lift")]
    assert decide(rule(scenario), board(scenario, lifting)) == []
    forks = hall(*NEAREST, kind=FORK)
    assert decide(rule(forks), board(forks, lifting)) == [("a", "o1")]
    kept = [order("o1", 10.0, 30.0, robot="b")]
    assert decide(rule(scenario), board(scenario, kept)) == [("b", "o1")]
    first, second = order("o1", 15.0, 60.0), order("o2", 10.0, 30.0, after=("o1",))
    state = board(scenario, [first, second])
    dispatcher = rule(scenario)
    assert decide(dispatcher, state) == [("b", "o1")]
    assert decide(dispatcher, state) == []
    del state.open["o1"]
    assert decide(dispatcher, state) == [("a", "o2")]


def test_an_order_for_a_shelf_is_refused_by_name() -> None:
    scenario = hall(("a", 10.0, 30.0))
    state = board(scenario, [Order(Task("o1", (), fetches="g1"))])
    with pytest.raises(ValueError, match=r"order o1 fetches shelf g1.*give it visits"):
        list(NearestOrder(scenario)(state))


def test_orders_would_starve_without_age() -> None:
    with pytest.raises(ValueError, match=r"age must be above 0.*starve"):
        NearestOrderParams(age=0.0)
