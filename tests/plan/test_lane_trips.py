"""Trips on lanes: always possible, never two robots in a cell."""

from collections import Counter
from dataclasses import replace
from itertools import pairwise

import pytest
from tests.plan.lane_traffic import LAYOUTS, Traffic

from clearway.execute import CellConflicts, RightOfWay
from clearway.model import Commitment, Footprint, Layout, Obstacle, Robot, Trip, Visit
from clearway.plan import LaneTrips
from clearway.plan.lane_motion import stays_of
from clearway.protocols import Refusal
from clearway.validate import validate_plan
from clearway.world.channels import agv_type
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import CROSSING, HORIZONTAL, LONGITUDINAL, T_CROSSING

CHANNELS = (HORIZONTAL, LONGITUDINAL)


@pytest.mark.parametrize("rules", ["waiting", "search"])
@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_random_trips_all_end_and_no_bodies_meet(rule, turn_seconds, rules):
    """Twenty robots on every layout, judged on their true bodies."""
    traffic = Traffic(Layout(rule), 20, turn_seconds, seed=1, rules=rules)
    assert traffic.run(150) == []
    assert validate_plan(traffic.record()) == []


@pytest.mark.parametrize("rules", ["waiting", "search"])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_nobody_waits_inside_a_crossing(rule, rules):
    """R-B35: a crossing is entered only if the cell behind it is free as well."""
    traffic = Traffic(Layout(rule, blocks=(3, 3, 3), bands=3), 14, seed=2, rules=rules)
    traffic.run(200)
    region, passed = traffic.grid.region, 0
    for told in traffic.told.values():
        for commitment in told:
            stays = stays_of(traffic.grid, commitment.trajectory)
            crossed = [stay for stay in stays if region.flat[stay.cell] in (CROSSING, T_CROSSING)]
            passed += len(crossed)
            assert all(stay.arrive == stay.depart for stay in crossed)
    assert passed > 200


def box_at(grid, cell, half=0.3):
    """An obstacle in the middle of a cell."""
    x, y, _ = grid.centre(cell)
    return Obstacle(
        polygon=(
            (x - half, y - half),
            (x + half, y - half),
            (x + half, y + half),
            (x - half, y + half),
        )
    )


def busiest(traffic, now):
    """The channel cell, no crossing, that most robots come to later, and where nobody is now."""
    cells, here = Counter(), set()
    for told in traffic.told.values():
        stays = stays_of(traffic.grid, told[-1].trajectory)
        for before, stay in pairwise(stays):
            cell = (stay.cell % traffic.grid.size[0], stay.cell // traffic.grid.size[0])
            if before.depart > now and traffic.grid.region[cell[::-1]] in CHANNELS:
                cells[cell] += 1
            if before.depart <= now <= stay.depart + 1000:
                here.add(cell)
    return max(cells.keys() - here, key=lambda cell: (cells[cell], cell))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_robots_drive_round_an_obstacle_that_turns_up(rule, turn_seconds, seed):
    """Nobody drives into it, nobody meets anybody, and those whom it does not concern go on."""
    traffic = Traffic(Layout(rule), 20, turn_seconds, seed=seed)
    now = 40_000
    traffic.run(200, until=now)
    before = {name: told[-1] for name, told in traffic.told.items()}
    place = busiest(traffic, now)
    obstacle = box_at(traffic.grid, place)
    concerned = traffic.block(obstacle, now)
    assert concerned
    for name, told in traffic.told.items():
        assert (told[-1] is before[name]) == (name not in concerned)
    refused = traffic.run(60)
    assert validate_plan(traffic.record()) == []
    assert all(v.time < 40.0 for v in validate_plan(traffic.record([obstacle])))
    assert None not in traffic.rests.values()
    shut = {
        name
        for name, point in traffic.grid.endpoints.items()
        if traffic.grid.entrances(point.cell) == (place,)
    }
    assert all(trip.goals[0] in shut or traffic.rests[trip.robot] in shut for trip in refused)


def test_waits_say_for_whom_and_why():
    """Each wait is standing that the motion shows, and its words name its causes."""
    for rules in ("waiting", "search"):
        traffic = Traffic(Layout("bidirectional"), 30, seed=2, rules=rules)
        traffic.run(200)
        waits = [
            (commitment, wait)
            for told in traffic.told.values()
            for commitment in told
            for wait in commitment.waits
        ]
        assert len(waits) > 30
        assert len(waits) <= traffic.planner.counters["waits"]
        for commitment, wait in waits:
            path = commitment.trajectory
            assert path.at(wait.begin)[:2] == pytest.approx(path.at(wait.end)[:2])
            assert wait.end in {begin for begin, _ in path.timing}
            assert commitment.robot not in wait.causes
            assert all(f"{cause} goes first" in wait.because for cause in wait.causes)


def test_committed_robots_wait_for_new_ones_by_rule():
    """Commitments that a trip changed are told, at later times only, and kept by the planner."""
    traffic = Traffic(Layout("bidirectional"), 30, seed=2)
    changes = 0
    for _ in range(200):
        before = {name: told[-1] for name, told in traffic.told.items() if told}
        traffic.run(1)
        for changed in traffic.planner.changed:
            changes += 1
            old = before[changed.robot]
            assert changed is traffic.planner.commitment(changed.robot)
            assert changed.trip is old.trip and changed.rest == old.rest
            assert changed.served > old.served
            assert changed.trajectory.final_pose == old.trajectory.final_pose
    assert changes > 10


def test_no_committed_robot_is_stopped_without_notice():
    """Within two seconds of now nobody's motion changes, however conflicts are resolved."""
    traffic = Traffic(Layout("bidirectional"), 40, seed=6)
    for _ in range(200):
        before = {name: told[-1] for name, told in traffic.told.items() if told}
        now = min(traffic.done)[0]
        traffic.run(1)
        for changed in traffic.planner.changed:
            path, old = changed.trajectory, before[changed.robot].trajectory
            for tick in range(now, now + 2001, 250):
                assert path.at(tick) == pytest.approx(old.at(tick))


def test_what_rules_leave_goes_to_the_search():
    """With no conflict to be resolved by rule, conflicts leave a trip to the search."""
    traffic = Traffic(Layout("bidirectional"), 30, seed=2, rounds=0)
    traffic.run(100)
    assert traffic.planner.counters["fallbacks"] > 0
    assert validate_plan(traffic.record()) == []


def test_plans_that_a_rule_gave_up_leave_no_trace():
    """Rounds that end too soon undo the waits of others: who went first still does."""
    traffic = Traffic(Layout("bidirectional", blocks=(3, 3), bands=2), 20, seed=4, rounds=1)
    traffic.run(200)
    assert traffic.planner.counters["fallbacks"] > 5
    assert validate_plan(traffic.record()) == []


def test_a_trip_may_be_planned_before_the_last_one_is_over():
    """The motion not driven yet stays, its pieces first; the new one begins when served."""
    traffic = Traffic(Layout("bidirectional"), 1)
    robot = traffic.robots[0].id
    first = traffic.planner.plan(traffic.trip_to(robot, "p3"), 0)
    at = first.trajectory.timing[0][1] + 1
    second = traffic.planner.plan(traffic.trip_to(robot, "g7"), at)
    left = sum(end > at for _, end in first.trajectory.timing)
    assert second.trajectory.timing[:left] == first.trajectory.timing[-left:]
    assert second.trajectory.timing[left][0] == first.served
    assert len(second.trajectory.stops) == 1
    assert stays_of(traffic.grid, second.trajectory)[-1].arrive <= second.trajectory.end


def test_refusals_name_who_or_what_is_in_the_way():
    """An endpoint that another owns is refused until that one leaves; nonsense is for good."""
    traffic = Traffic(Layout("bidirectional"), 2)
    one, other = (robot.id for robot in traffic.robots)
    plan = traffic.planner.plan
    refused = plan(traffic.trip_to(one, traffic.rests[other]), 0)
    assert refused == Refusal(f"{traffic.rests[other]} is taken by {other}", (other,))
    assert isinstance(plan(traffic.trip_to(other, "p9"), 0), Commitment)
    assert isinstance(plan(traffic.trip_to(one, traffic.rests[other]), 0), Commitment)
    lane = Trip(one, (Visit(None, traffic.grid.centre((1, 8))),), "order")
    two = Trip(one, 2 * lane.visits, "order")
    for trip, reason in ((lane, "is not the middle of an endpoint"), (two, "has one visit")):
        refused = plan(trip, 0)
        assert refused.for_good and reason in refused.reason
    assert plan(Trip("nobody", lane.visits, "order"), 0).for_good


def test_robots_start_at_endpoints_of_their_own():
    """Who starts in a lane, or where another does, is named with the mend."""
    traffic = Traffic(Layout("bidirectional"), 2)
    one, other = traffic.robots
    moves = DynamicMap(traffic.grid)
    lane = Robot("lost", "agv", traffic.grid.centre((1, 8)))
    with pytest.raises(ValueError, match=r"robot lost starts in cell \(1, 8\)"):
        LaneTrips(traffic.grid, [one, lane], traffic.type, moves)
    twin = Robot("twin", "agv", one.start)
    with pytest.raises(ValueError, match=f"robots {one.id} and twin both start at"):
        LaneTrips(traffic.grid, [one, other, twin], traffic.type, moves)


@pytest.mark.parametrize(("side", "fits"), [(0.7, True), (0.8, True), (0.9, False)])
def test_bodies_turn_beside_others_or_are_refused(side, fits):
    """Of 0.8 m squares only one of two neighbours may turn; 0.9 m ones reach their neighbours."""
    kind = replace(
        agv_type(Layout("bidirectional"), 1.0), footprint=Footprint.rectangle(side, side)
    )
    if not fits:
        with pytest.raises(ValueError, match=r"0\.450 m to a side and 0\.636 m when it turns"):
            Traffic(Layout("bidirectional"), 2, kind=kind)
        return
    for rules in ("waiting", "search"):
        layout = Layout("bidirectional", blocks=(3, 3), bands=2)
        traffic = Traffic(layout, 20, seed=3, kind=kind, rules=rules)
        traffic.run(200)
        # Endpoints lie at the border, over which larger bodies turn.
        record = traffic.record()
        assert validate_plan(replace(record, site=replace(record.site, border="open"))) == []


def test_delays_become_the_new_times():
    """One robot stands for 20 s on its way; others plan by what the ledger expects then."""
    traffic = Traffic(Layout("bidirectional"), 20, seed=1)
    now = 30_000
    traffic.run(200, until=now)
    ledger = RightOfWay(CellConflicts(traffic.grid))
    commit = {robot.id: traffic.planner.commitment(robot.id) for robot in traffic.robots}
    ledger.commit(commit, now)
    late = max(commit, key=lambda name: commit[name].trajectory.end)
    for name in commit:
        ledger.report(name, now)
    standing = now + 20_000
    for tick in range(now, standing + 1, 500):
        for name in sorted(set(commit) - {late}):
            ledger.report(name, min(tick, ledger.grant(name)))
    expected = ledger.projected(standing)
    assert expected[late].end > commit[late].trajectory.end + 10_000  # it skips planned waits
    traffic.retime(expected, standing)
    traffic.run(60)
    assert validate_plan(traffic.record()) == []
