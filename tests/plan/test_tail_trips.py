"""Trips that replace the tail of a complete motion."""

import random
import signal
from dataclasses import replace

import pytest
from tests.plan.endless import BAYS, Endless, fleet, hall, parked, trip
from tests.plan.rooms import CART, TRUCK, block, to

from clearway.model import Commitment, Limits, Pose, RobotType, to_ticks
from clearway.plan.tail_trips import TailTrips, TailTripsParams
from clearway.protocols import Refusal

# One door of 1.4 m between bays and places: only one cart fits, whichever way it looks.
DOOR = (block(8.0, 0.0, 8.6, 5.3), block(8.0, 6.7, 8.6, 12.0))


def place(rng: random.Random):
    return to(round(rng.uniform(11.0, 22.0), 1), round(rng.uniform(2.0, 10.0), 1), 0.0, 2.0)


@pytest.mark.parametrize("seed", range(3))
def test_orders_without_end_through_one_door(seed):
    """Five robots take 25 trips through a door for one; nobody ever meets anybody, bays are
    never shared, and what was committed before is driven as it was said."""
    rng = random.Random(seed)
    scenario = parked(hall(*DOOR), 5)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    now = done = 0
    while done < 25:
        for robot in sorted("abcde", key=lambda r: trips.commitment(r).served):
            old = trips.commitment(robot)
            if old.served > now:
                continue
            answer = trips.plan(trip(robot, place(rng)), now, 4)
            if isinstance(answer, Refusal):
                assert trips.commitment(robot) is old
                continue
            run.note(robot, now)
            done += 1
        rests = [trips.commitment(robot).rest for robot in "abcde"]
        assert len(set(rests)) == 5
        now += 1500
        assert now < 600_000
    assert run.judged() == []


def test_a_new_tail_begins_where_the_services_end():
    """Asked for at 3 s, while the robot still has 20 s of service before it, the next trip keeps
    all that it does until its service is over."""
    scenario = parked(hall(), 1)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    old = run.commit(trip("a", to(12.0, 6.0, 0.0, 20.0)), 0)
    new = run.commit(trip("a", to(20.0, 2.0, 0.0, 1.0)), 3000)
    for tick in range(3000, old.served + 1, 250):
        assert new.trajectory.at(tick) == pytest.approx(old.trajectory.at(tick), abs=1e-9)
    assert min(begin for begin, _ in new.trajectory.timing if begin > 12_000) >= old.served


def test_a_robot_on_its_way_to_rest_turns_round_at_once():
    """Between its service and its bay a robot may be sent elsewhere from where it is."""
    scenario = parked(hall(), 1)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    old = run.commit(trip("a", to(20.0, 6.0, 0.0, 1.0)), 0)
    now = old.served + 3000
    new = run.commit(trip("a", to(20.0, 9.0, 0.0, 1.0)), now)
    assert new.trajectory.at(now) == pytest.approx(old.trajectory.at(now), abs=1e-9)
    assert new.served < old.trajectory.end
    assert run.judged() == []


def test_who_cannot_stop_at_once_is_led_on_from_where_it_rests():
    """With limits on acceleration a piece in motion is driven to where the robot stands."""
    slow = replace(CART, limits=replace(CART.limits, acceleration=0.3, deceleration=0.3))
    scenario = parked(hall(), 1, slow)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    old = run.commit(trip("a", to(20.0, 6.0, 0.0, 1.0)), 0)
    run.commit(trip("a", to(20.0, 9.0, 0.0, 1.0)), old.served + 3000)
    assert run.judged() == []


def test_refused_where_somebody_rests_for_ever():
    """A place at which another robot rests cannot be visited; nothing changes, and it is no
    reason to give the trip up for good."""
    scenario = fleet(hall(bays=1), Pose(1.0, 1.5, 0.0), Pose(12.0, 6.0, 0.0))
    trips = TailTrips(scenario)
    before = {robot: trips.commitment(robot) for robot in "ab"}
    answer = trips.plan(trip("a", to(12.0, 6.0, 0.0, 1.0), rests=BAYS[:1]), 0)
    assert isinstance(answer, Refusal)
    assert not answer.for_good
    assert {robot: trips.commitment(robot) for robot in "ab"} == before


def test_refused_for_good_where_no_way_leads():
    """Behind walls nobody gets to a place, whoever else is there."""
    walls = (block(15.0, 4.0, 15.3, 8.0), block(19.0, 4.0, 19.3, 8.0))
    lids = (block(15.0, 4.0, 19.3, 4.3), block(15.0, 7.7, 19.3, 8.0))
    scenario = parked(hall(*walls, *lids, width=22.0), 1)
    answer = TailTrips(scenario).plan(trip("a", to(17.0, 6.0)), 0)
    assert isinstance(answer, Refusal)
    assert answer.for_good


def test_refused_while_no_bay_is_free():
    """Both bays that the trip may end in are reserved: the refusal names for whom."""
    scenario = parked(hall(), 3)
    answer = TailTrips(scenario).plan(trip("a", to(12.0, 6.0), rests=BAYS[1:3]), 0)
    assert isinstance(answer, Refusal)
    assert answer.causes == ("b", "c")


def test_nobody_starves():
    """A robot whose searches are too short to find a way gets one for sure after its patience:
    it begins when all the others have come to rest."""
    params = TailTripsParams(search_limit=1, patience=30.0)
    scenario = parked(hall(), 2)
    long = TailTrips(scenario)
    answer = long.plan(trip("b", to(20.0, 6.0, 0.0, 40.0)), 0)
    assert isinstance(answer, Commitment)
    trips = TailTrips(scenario, params)
    wanted = trip("a", to(20.0, 2.0, 0.0, 1.0))
    assert isinstance(trips.plan(wanted, 0), Refusal)
    assert isinstance(trips.plan(wanted, 29_000), Refusal)
    found = trips.plan(wanted, 30_000)
    assert isinstance(found, Commitment)
    assert found.trajectory.timing[0][0] >= 30_000


def test_a_start_out_of_the_bays_is_left_for_one():
    """A robot that starts in the hall is committed to a bay at once."""
    scenario = fleet(hall(), Pose(12.0, 6.0, 0.0), Pose(1.0, 1.5, 0.0))
    trips = TailTrips(scenario)
    assert trips.commitment("b").rest == "bay-1"
    assert trips.commitment("a").rest in BAYS[1:]
    assert Endless(scenario, trips).judged() == []


def test_waits_name_whom_a_robot_waits_for():
    """The door is free only when the first robot is through; the second one says so."""
    scenario = parked(hall(*DOOR), 4)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    for robot in "abc":
        run.commit(trip(robot, to(20.0, 6.0, 0.0, 5.0)), 0, 8)
    held = run.commit(trip("d", to(20.0, 6.0, 0.0, 5.0)), 0, 8)
    assert held.waits
    for wait in held.waits:
        assert set(wait.causes) <= {"a", "b", "c"}
        pose = held.trajectory.at(wait.begin)
        assert held.trajectory.at(wait.end) == pytest.approx(pose)
    assert any(wait.causes and "would meet" in wait.because for wait in held.waits)


def test_delays_are_taken_over():
    """A robot that is 20 s late is avoided where it is, not where it was to be."""
    scenario = parked(hall(*DOOR), 2)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    first = run.commit(trip("a", to(20.0, 6.0, 0.0, 5.0)), 0)
    late = replace(
        first.trajectory,
        timing=tuple((b + 20_000, e + 20_000) for b, e in first.trajectory.timing),
        stops=tuple(
            replace(s, arrive=s.arrive + 20_000, leave=s.leave + 20_000)
            for s in first.trajectory.stops
        ),
    )
    trips.retime({"a": late})
    run.past["a"] = [(0, trips.commitment("a"))]
    run.commit(trip("b", to(20.0, 8.0, 0.0, 5.0)), 0)
    assert trips.commitment("a").served == first.served + 20_000
    assert run.judged() == []


def test_an_interrupt_ends_a_search_and_changes_nothing():
    """Ctrl-C is heard within a second, though the search goes on for minutes."""
    walls = (block(40.0, 0.0, 40.3, 29.3), block(40.0, 30.7, 40.3, 60.0))
    site = hall(*walls, width=60.0, height=60.0, bays=2)
    bays = [zone.pose for zone in site.zones]
    # The third robot rests in the only door, for there is no bay for it.
    scenario = fleet(site, *bays, Pose(40.1, 30.0, 0.0))
    trips = TailTrips(scenario, TailTripsParams(search_limit=100_000_000))
    old = trips.commitment("a")
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            trips.plan(trip("a", to(50.0, 30.0), rests=BAYS[:1]), 0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, previous)
    assert trips.commitment("a") is old
    assert isinstance(trips.plan(trip("b", to(8.0, 6.0), rests=BAYS[1:2]), 0), Commitment)


def test_loads_are_counted():
    """A cart that is wider when it carries something needs the wide door on its way back."""
    wide = RobotType(
        "wide",
        CART.footprint,
        "four_wheel",
        Limits(speed=1.0, yaw_rate=0.8, turning_radius=1.0),
        loaded_footprint=TRUCK.footprint,
    )
    scenario = parked(hall(), 1, wide)
    trips = TailTrips(scenario)
    run = Endless(scenario, trips)
    first = run.commit(trip("a", to(12.0, 6.0, 0.0, 1.0, "pick")), 0)
    assert [piece.loaded for piece in first.trajectory.pieces][-1]
    second = run.commit(trip("a", to(20.0, 6.0, 0.0, 1.0, "drop")), first.served)
    begin = second.trajectory.timing[0][0]
    assert begin >= first.served
    assert second.trajectory.pieces[0].loaded
    assert not second.trajectory.pieces[-1].loaded
    assert to_ticks(1.0) == second.trajectory.stops[0].leave - second.trajectory.stops[0].arrive
    assert run.judged() == []
