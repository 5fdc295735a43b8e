"""Who fetches which shelf by the paper's rules, and where it goes."""

import random
from dataclasses import replace

import pytest
from tests.assign.lone_fleet import (
    by_purpose,
    check_ownership,
    check_shelves,
    paper_yard,
    run,
    yard,
)

from clearway.assign.nearest_idle import NearestIdle
from clearway.assign.shelf_cycle import ShelfParams
from clearway.model import Battery, Layout
from clearway.protocols import Board, RobotView
from clearway.world.channels import lane_grid

SMALL = lane_grid(Layout("bidirectional", (3,), 1))  # 6 shelves, 6 stations, 3 chargers


def test_an_order_is_fetched_delivered_and_stored() -> None:
    """Agv-1 rests under g1 at (3, 2); g3 at (5, 2) is 2 m away; p3 at (0, 2) is 5 m from there.

    The vacant place nearest to p3 is the one that g3 left: 2 + 5 + 10 + 5 = 22 s.
    """
    scenario = yard(SMALL, 1, ["g3"])
    log = run(scenario, NearestIdle(scenario))
    assert [(b, e, g) for b, e, _, g in by_purpose(log, "fetch")] == [(0, 2000, "g3")]
    assert [(b, e, g) for b, e, _, g in by_purpose(log, "deliver")] == [(2000, 17000, "p3")]
    assert [(b, e, g) for b, e, _, g in by_purpose(log, "store")] == [(17000, 22000, "g3")]
    assert [c.trip.carries for _, _, c in log.driven] == [("g3",), ("g3",), ()]
    assert [c.completes for _, _, c in log.driven] == [False, False, True]


def test_a_robot_under_the_shelf_is_nearest() -> None:
    """With robots under g1 and g2, each order is fetched by who is under its shelf."""
    scenario = yard(SMALL, 2, ["g2", "g1"])
    log = run(scenario, NearestIdle(scenario))
    fetches = [c for _, _, c in log.driven if c.trip.purpose == "fetch"]
    assert [(c.trip.robot, c.score) for c in fetches] == [("agv-2", 0.0), ("agv-1", 0.0)]
    assert [(a.name, a.score) for a in fetches[0].alternatives] == [("agv-1", 1.0)]


def test_a_shelf_that_is_busy_is_skipped() -> None:
    """The second order for g1 waits until g1 is stored; the third does not wait for it."""
    scenario = yard(SMALL, 2, ["g1", "g1", "g2"])
    log = run(scenario, NearestIdle(scenario))
    begin = {c.trip.order: b for b, _, c in log.driven if c.trip.purpose == "fetch"}
    stored = {c.trip.order: e for _, e, c in log.driven if c.trip.purpose == "store"}
    assert begin["o3"] == 0
    assert begin["o2"] == stored["o1"]


def test_the_shelf_under_a_robot_that_must_charge_is_skipped() -> None:
    """Agv-1 is under g1 with an empty battery: g1 is fetched when agv-1 has left for a charger."""
    battery = Battery(5000.0, charging=500.0)
    scenario = yard(SMALL, 1, ["g1"], battery, energy=0.1)
    log = run(scenario, NearestIdle(scenario))
    charge, fetch = log.driven[0], log.driven[1]
    # c1 at (3, 6) is 4 m from g1, so 0.1 - 4/5000 is left: 0.8508 of 500 s until 95 %.
    assert charge[2].trip.purpose == "charge"
    assert charge[2].trip.goals == ("c1",)
    assert charge[1] == 4000 + 425400
    assert fetch[:2] == (charge[1], charge[1] + 4000)


def test_who_is_charged_makes_room() -> None:
    """Ten of ten robots must charge at three chargers: those done rest elsewhere, all get done."""
    grid = lane_grid(Layout("bidirectional", (6,), 1))  # 6 chargers
    battery = Battery(5000.0, charging=500.0)
    scenario = yard(grid, 10, [], battery, energy=0.1)
    log = run(scenario, NearestIdle(scenario))
    assert len({r for _, _, r, _ in by_purpose(log, "charge")}) == 10
    assert len(by_purpose(log, "park")) == 4
    check_ownership(scenario, log)


def test_a_refused_trip_is_wanted_again() -> None:
    """Whoever is refused for a while gets the same order's trip later; nothing is lost."""
    draw = random.Random(5)
    scenario = paper_yard(10, 40, 1)
    log = run(scenario, NearestIdle(scenario), refuse=lambda choice, now: draw.random() < 0.4)
    assert log.refused > 20
    assert not log.open
    check_ownership(scenario, log)
    check_shelves(scenario, log)


def test_more_urgent_orders_go_first() -> None:
    """Of one robot's orders the two of priority 2 go first, as they arrived; then 1, then 0."""
    scenario = yard(SMALL, 1, ["g2", "g3", "g4", "g5"])
    given = zip(scenario.orders, (0.0, 2.0, 1.0, 2.0), strict=True)
    orders = tuple(replace(order, priority=priority) for order, priority in given)
    scenario = replace(scenario, orders=orders)
    log = run(scenario, NearestIdle(scenario))
    fetched = [c.trip.order for _, _, c in log.driven if c.trip.purpose == "fetch"]
    assert fetched == ["o2", "o4", "o3", "o1"]


def test_an_order_that_is_refused_again_and_again_goes_to_another_robot() -> None:
    """The robot under g1 never gets a way, so the other one fetches g1 in the end."""
    scenario = yard(SMALL, 2, ["g1"])
    board = Board(0, {r.id: RobotView(r.id, r.type, r.start) for r in scenario.robots})
    board.open = {"o1": scenario.orders[0]}
    dispatcher = NearestIdle(scenario)
    tried = []
    for refusals in range(7):
        board.refusals["o1"] = refusals
        tried += [choice.trip.robot for choice in dispatcher(board)]
    assert tried == ["agv-1"] * 3 + ["agv-2"] * 3 + ["agv-1"]


def test_an_order_waits_for_those_before_it() -> None:
    """An order for g2 that waits for one for g1 begins when that one is done."""
    scenario = yard(SMALL, 2, ["g2", "g1"])
    first, second = scenario.orders
    scenario = replace(scenario, orders=(replace(first, after=("o2",)), second))
    log = run(scenario, NearestIdle(scenario))
    begin = {c.trip.order: b for b, _, c in log.driven if c.trip.purpose == "fetch"}
    stored = {c.trip.order: e for _, e, c in log.driven if c.trip.purpose == "store"}
    assert begin["o1"] == stored["o2"]


@pytest.mark.parametrize("seed", range(6))
def test_no_endpoint_has_two_owners(seed: int) -> None:
    """Also with few chargers and stations, low batteries, shelves ordered again and again."""
    draw = random.Random(seed)
    grid = lane_grid(Layout("bidirectional", (4, 3), 2))
    shelves = [point.name for point in grid.of_kind("shelf")]
    orders = draw.choices(shelves, k=120)
    releases = sorted(draw.uniform(0.0, 600.0) for _ in orders)
    battery = Battery(draw.choice((200.0, 500.0)), charging=100.0)
    scenario = yard(grid, 12, orders, battery, draw.uniform(0.15, 0.35), releases)
    log = run(scenario, NearestIdle(scenario), refuse=lambda choice, now: draw.random() < 0.1)
    assert not log.open
    assert by_purpose(log, "charge")
    check_ownership(scenario, log)
    check_shelves(scenario, log)


def test_distance_along_routes_may_choose_otherwise() -> None:
    """Where the way from agv-1 is long, agv-2 fetches, though agv-1 is nearer as the crow flies."""
    scenario = yard(SMALL, 2, ["g4"])  # above g1, where agv-1 is
    far = {("g1", "g4"): 9.0}

    def distance(a: str, b: str) -> float:
        p, q = poses[a], poses[b]
        return far.get((a, b), abs(p.x - q.x) + abs(p.y - q.y))

    poses = {zone.name: zone.pose for zone in scenario.site.zones if zone.pose}
    log = run(scenario, NearestIdle(scenario, distance=distance))
    assert log.driven[0][2].trip.robot == "agv-2"
    assert log.driven[0][2].alternatives[0].score == 9.0
    assert run(scenario, NearestIdle(scenario)).driven[0][2].trip.robot == "agv-1"


def test_an_order_for_no_shelf_is_named() -> None:
    scenario = yard(SMALL, 1, ["g99"])
    with pytest.raises(ValueError, match=r"order o1 fetches g99.*no shelf.*such as g1"):
        run(scenario, NearestIdle(scenario))


def test_a_robot_in_a_channel_is_named() -> None:
    scenario = yard(SMALL, 1, ["g1"])
    start = SMALL.centre((1, 1))
    scenario = replace(scenario, robots=(replace(scenario.robots[0], start=start),))
    with pytest.raises(ValueError, match=r"robot agv-1 starts at \(1.5, 1.5\)"):
        run(scenario, NearestIdle(scenario))


def test_times_are_parameters() -> None:
    """2 s to lift, 3 s to lower, 20 s at the station: 22 + 2 + 3 + 10 s."""
    scenario = yard(SMALL, 1, ["g3"])
    log = run(scenario, NearestIdle(scenario, ShelfParams(lift=2.0, lower=3.0, residence=20.0)))
    assert log.makespan == 37.0
    with pytest.raises(ValueError, match="lift must be 0 or above"):
        ShelfParams(lift=-1.0)
