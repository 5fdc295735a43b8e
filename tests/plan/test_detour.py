"""Obstacles that come to light while robots drive."""

from dataclasses import replace

import pytest
from tests.plan.endless import BAYS, Endless, hall, parked, trip
from tests.plan.rooms import CART, EAST, SOUTH, block, rectangle, room, to

from clearway.model import Commitment, Pose, Robot, Scenario, Zone
from clearway.plan.tail_trips import TailTrips

# Two doors of 1.4 m.
DOORS = (block(8.0, 0.0, 8.6, 2.3), block(8.0, 3.7, 8.6, 8.3), block(8.0, 9.7, 8.6, 12.0))
LOWER_SHUT = block(8.0, 2.0, 8.6, 4.0)
UPPER_SHUT = block(8.0, 8.0, 8.6, 10.0)


def on_the_way(*obstacles, count=2):
    """Robot a on its way to the lower right, b standing; and what has been committed to."""
    scenario = parked(hall(*obstacles), count)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    run.commit(trip("a", to(20.0, 3.0, 0.0, 5.0)), 0)
    return trips, run


def with_obstacle(run, *more):
    site = run.scenario.site
    return replace(site, obstacles=(*site.obstacles, *more))


def test_a_shut_door_sends_a_robot_through_the_other():
    """It makes the same visit by the other door; who does not come there is left alone."""
    trips, run = on_the_way(*DOORS)
    before = {robot: trips.commitment(robot) for robot in "ab"}
    assert trips.block(LOWER_SHUT, 2000) == ("a",)
    assert trips.commitment("b") is before["b"]
    new = trips.commitment("a")
    run.note("a", 2000)
    assert new.trip is before["a"].trip
    assert len(new.trajectory.stops) == 1
    assert new.served > before["a"].served
    assert new.trajectory.at(2000) == pytest.approx(before["a"].trajectory.at(2000), abs=1e-9)
    assert run.judged(with_obstacle(run, LOWER_SHUT)) == []


def test_an_obstacle_off_the_way_changes_nothing():
    """Nobody comes to the upper door."""
    trips, _ = on_the_way(*DOORS)
    before = trips.commitment("a")
    assert trips.block(UPPER_SHUT, 2000) == ()
    assert trips.commitment("a") is before


def test_a_robot_cut_off_from_its_visit_goes_to_a_bay():
    """With both doors shut there is no way on: the trip ends, and the robot goes to rest."""
    trips, run = on_the_way(*DOORS)
    trips.block(UPPER_SHUT, 1000)
    assert trips.block(LOWER_SHUT, 2000) == ("a",)
    run.note("a", 2000)
    new = trips.commitment("a")
    assert new.trip is None
    assert new.rest in BAYS
    assert run.judged(with_obstacle(run, LOWER_SHUT, UPPER_SHUT)) == []


def test_a_robot_cut_off_from_all_bays_stands():
    """On the far side of both doors it has its visit, but no way home: it stands there."""
    trips, run = on_the_way(*DOORS)
    trips.block(UPPER_SHUT, 1000)
    inside = next(
        tick for tick in range(0, 60_000, 100) if run.past["a"][-1][1].trajectory.at(tick).x > 12.0
    )
    assert trips.block(LOWER_SHUT, inside) == ("a",)
    run.note("a", inside)
    new = trips.commitment("a")
    assert new.trip is None
    assert new.rest is None
    assert new.waits[-1].causes == ("obstacle",)
    assert new.trajectory.final_pose.x > 8.6
    assert run.judged() == []


def test_what_is_served_is_not_served_again():
    """The second of two visits is still to come when the door to it shuts; the first one's stop
    stays as it was."""
    scenario = parked(hall(*DOORS), 1)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    old = run.commit(trip("a", to(4.0, 2.0, 0.0, 2.0), to(20.0, 3.0, 0.0, 2.0)), 0)
    now = old.trajectory.stops[0].leave + 500
    assert trips.block(LOWER_SHUT, now) == ("a",)
    run.note("a", now)
    new = trips.commitment("a")
    assert new.trajectory.stops[0] == old.trajectory.stops[0]
    assert [stop.visit for stop in new.trajectory.stops] == [0, 1]
    assert run.judged(with_obstacle(run, LOWER_SHUT)) == []


def test_a_robot_in_service_serves_before_it_is_led_on():
    """Its way home is barred while it serves; the service is not cut short."""
    trips, run = on_the_way(*DOORS)
    old = trips.commitment("a")
    now = old.trajectory.stops[0].arrive + 1000
    assert trips.block(LOWER_SHUT, now) == ("a",)
    run.note("a", now)
    new = trips.commitment("a")
    assert not [span for span in new.trajectory.timing if now <= span[0] < old.served]
    back = [piece for piece in new.trajectory.pieces if 8.0 < piece.start.x < 8.6]
    assert all(piece.start.y > 8.3 for piece in back)
    assert new.trajectory.final_pose.x < 8.0
    assert run.judged() == []


def test_a_covered_bay_is_nobodys_rest():
    """A bay under the obstacle is dropped, for those who go there and for later trips."""
    trips, run = on_the_way()
    rest = trips.commitment("a").rest
    pose = next(zone.pose for zone in run.scenario.site.zones if zone.name == rest)
    lid = block(pose.x - 0.4, pose.y - 0.2, pose.x + 0.4, pose.y + 0.2)
    assert trips.block(lid, trips.commitment("a").served - 1000) == ("a",)
    assert trips.commitment("a").rest not in (None, rest)
    answer = trips.plan(trip("b", to(12.0, 6.0)), 100_000)
    assert isinstance(answer, Commitment)
    assert answer.rest != rest


def crossing():
    """Robot a, which only drives forwards, on a lane from west to east; b crosses it from north to
    south in a lane of its own at x = 10.7, or goes round by another one at x = 18.7."""
    blocks = [
        block(0.0, 0.0, 10.0, 5.3),
        block(0.0, 6.7, 10.0, 12.0),
        block(11.4, 1.6, 18.0, 5.3),
        block(11.4, 6.7, 18.0, 10.4),
        block(19.4, 0.0, 24.0, 5.3),
        block(19.4, 6.7, 24.0, 12.0),
    ]
    site = replace(room(24.0, 12.0, *blocks), zones=())
    poses = (Pose(1.0, 6.0, EAST), Pose(10.7, 11.0, SOUTH), Pose(22.0, 6.0, EAST))
    zones = tuple(
        Zone(name, "parking", rectangle(x - 0.3, y - 0.3, x + 0.3, y + 0.3), Pose(x, y, theta))
        for name, (x, y, theta) in zip(BAYS, poses, strict=False)
    )
    ahead = replace(CART, name="ahead", modes=("stop", "forward"))
    robots = (Robot("a", "ahead", poses[0]), Robot("b", "cart", poses[1]))
    kinds = {"ahead": ahead, "cart": CART}
    return Scenario("crossing", replace(site, zones=zones), kinds, robots, ())


def test_who_must_stop_in_the_way_sends_the_others_round():
    """An obstacle just behind the crossing stops a in it, and it cannot drive back: b, whose way
    is not barred by the obstacle, goes round by the other lane."""
    scenario = crossing()
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    first = run.commit(trip("a", to(20.0, 6.0), rests=BAYS[2:3]), 0)
    late = replace(to(10.7, 0.8, SOUTH), not_before=30.0)
    second = run.commit(trip("b", late, rests=BAYS[1:2]), 0)
    now = next(tick for tick in range(0, 30_000, 50) if first.trajectory.at(tick).x > 10.0)
    wall = block(11.9, 5.3, 12.2, 6.7)
    assert trips.block(wall, now) == ("a", "b")
    for robot in "ab":
        run.note(robot, now)
    assert 10.0 < trips.commitment("a").trajectory.final_pose.x < 11.0
    assert trips.commitment("b").trip is second.trip
    assert max(piece.end.x for piece in trips.commitment("b").trajectory.pieces) > 18.0
    assert run.judged(with_obstacle(run, wall)) == []
