"""Who slows for whom, on plans that are written down by hand."""

import numpy as np
import pytest

from clearway.formats.ready_made import scenario_folder
from clearway.formats.scenario_file import read_scenario
from clearway.model import (
    Footprint,
    Limits,
    PlanRecord,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Track,
    Visit,
)
from clearway.study.alignment import alignments
from clearway.study.yielding import lone_records, yieldings
from clearway.systems import HierarchicalSettings, choose_system, hierarchical, make_plan
from clearway.validate import gaps_over_time

CARRIER = RobotType(
    name="carrier",
    footprint=Footprint.rectangle(3.0, 2.0),
    kinematics="four_wheel",
    limits=Limits(speed=2.0),
    clearance=0.1,
)


def track(*points, theta=0.0):
    """Straight motion through ``(t, x, y)``, with samples every 0.1 s."""
    t, x, y = (np.array(values) for values in zip(*points, strict=True))
    times = np.unique(np.concatenate([np.arange(0.0, t[-1], 0.1), t]))
    xs, ys = np.interp(times, t, x), np.interp(times, t, y)
    return Track(times, xs, ys, np.full(len(times), theta), (None,) * len(times))


def record(**tracks):
    """A plan of carriers, each with one visit where its track ends."""
    start = {k: Pose(float(v.x[0]), float(v.y[0]), float(v.theta[0])) for k, v in tracks.items()}
    end = {k: Pose(float(v.x[-1]), float(v.y[-1]), float(v.theta[-1])) for k, v in tracks.items()}
    return PlanRecord(
        scenario="crossing",
        system="hierarchical",
        seed=0,
        status=Status.SOLVED,
        site=Site(((-50.0, -50.0), (50.0, -50.0), (50.0, 50.0), (-50.0, 50.0))),
        robot_types={"carrier": CARRIER},
        robots=tuple(Robot(name, "carrier", start[name]) for name in tracks),
        tours={name: (Visit(f"to-{name}", end[name]),) for name in tracks},
        tracks=tracks,
        assignment={name: (f"to-{name}",) for name in tracks},
        sum_of_costs=sum(float(each.t[-1]) for each in tracks.values()),
        makespan=max(float(each.t[-1]) for each in tracks.values()),
    )


# East along y = 0 at 2 m/s; north along x = 0 at 2 m/s, so both would be at (0, 0) after 10 s.
EAST = track((0.0, -20.0, 0.0), (20.0, 20.0, 0.0))
NORTH = track((0.0, 0.0, -20.0), (20.0, 0.0, 20.0), theta=np.pi / 2.0)
# North waits from 5 to 8 s, then goes on.
WAITS = track(
    (0.0, 0.0, -20.0), (5.0, 0.0, -10.0), (8.0, 0.0, -10.0), (23.0, 0.0, 20.0), theta=np.pi / 2.0
)
# North drives at 1 m/s from 4 to 10 s.
SLOWS = track(
    (0.0, 0.0, -20.0), (4.0, 0.0, -12.0), (10.0, 0.0, -6.0), (23.0, 0.0, 20.0), theta=np.pi / 2.0
)
ALONE = {"east": record(east=EAST), "north": record(north=NORTH)}


def test_a_robot_that_waits_tells_for_whom():
    """Three seconds, from the fifth on; it would have met the other before the tenth."""
    (found,) = yieldings(record(east=EAST, north=WAITS), ALONE)
    assert (found.robot, found.kind, found.partner) == ("north", "waits", "east")
    assert found.begin == pytest.approx(5.0, abs=1.0)
    assert found.end == pytest.approx(8.0, abs=1.0)
    assert found.lost == pytest.approx(3.0, abs=0.3)
    assert found.place == pytest.approx((0.0, -10.0), abs=1.5)
    # Noses meet when both are 2.5 m (half a length and half a width) or less from the middle.
    assert found.meeting == pytest.approx(10.0 - 2.5 / 2.0, abs=0.3)


def test_a_robot_that_drives_slower_yields_too():
    """Six metres in six seconds instead of three."""
    (found,) = yieldings(record(east=EAST, north=SLOWS), ALONE)
    assert (found.robot, found.kind, found.partner) == ("north", "slows", "east")
    assert found.lost == pytest.approx(3.0, abs=0.3)
    assert found.end - found.begin == pytest.approx(6.0, abs=1.2)


def test_of_two_the_first_that_it_would_meet_is_named():
    """Another crosses ten metres farther on, where the robot would be five seconds later."""
    later = track((0.0, -30.0, 10.0), (20.0, 10.0, 10.0))
    plan = record(later=later, east=EAST, north=WAITS)
    (found,) = yieldings(plan, ALONE | {"later": record(later=later)})
    assert (found.robot, found.partner) == ("north", "east")
    without = record(later=later, north=WAITS)
    (found,) = yieldings(without, ALONE | {"later": record(later=later)})
    assert (found.robot, found.partner) == ("north", "later")
    assert found.meeting == pytest.approx(15.0 - 2.5 / 2.0, abs=0.3)


def test_a_second_wait_is_measured_from_where_the_first_left_it():
    """Three seconds lost for nobody; then it would be at the crossing at 16 s, as the other."""
    north = track((0.0, 0.0, -26.0), (23.0, 0.0, 20.0), theta=np.pi / 2.0)
    twice = track(
        (0.0, 0.0, -26.0),
        (2.0, 0.0, -22.0),
        (5.0, 0.0, -22.0),
        (11.0, 0.0, -10.0),
        (15.0, 0.0, -10.0),
        (30.0, 0.0, 20.0),
        theta=np.pi / 2.0,
    )
    east = track((0.0, -32.0, 0.0), (26.0, 20.0, 0.0))
    alone = {"east": record(east=east), "north": record(north=north)}
    first, second = yieldings(record(east=east, north=twice), alone)
    assert (first.partner, second.partner) == (None, "east")
    assert (first.lost, second.lost) == (pytest.approx(3.0, abs=0.3), pytest.approx(4.0, abs=0.3))
    assert second.meeting == pytest.approx(16.0 - 2.5 / 2.0, abs=0.3)


def test_who_waits_for_nobody_has_no_partner():
    """The other is far away."""
    away = track((0.0, -20.0, 40.0), (20.0, 20.0, 40.0))
    (found,) = yieldings(record(east=away, north=WAITS), ALONE | {"east": record(east=away)})
    assert (found.robot, found.partner, found.meeting) == ("north", None, None)


def test_who_drives_as_alone_does_not_yield():
    """Though the plans conflict: that is the judge's business."""
    assert yieldings(record(east=EAST, north=NORTH), ALONE) == []


def test_robots_that_swap_in_a_dead_end_wait_for_each_other():
    """The tight room: those in the hall cannot go in before the others came out."""
    scenario = read_scenario(scenario_folder() / "tight-room.toml")
    system = choose_system(scenario)
    plan = make_plan(scenario, system=system, seed=0).record
    found = yieldings(plan, lone_records(plan, system.plan, 0))
    assert {"r3", "r4"} <= {each.robot for each in found}
    late = {robot.id: float(plan.tracks[robot.id].t[-1]) for robot in scenario.robots}
    assert all(each.partner not in (None, each.robot) for each in found)
    assert all(0.0 <= each.begin < each.end <= late[each.robot] + 1e-6 for each in found)


def test_gaps_are_those_of_the_true_bodies():
    """Side by side 2 m apart; nose to flank at the crossing; overlap told by its depth."""
    beside = record(a=EAST, b=track((0.0, -20.0, 4.0), (20.0, 20.0, 4.0)))
    assert gaps_over_time(beside, np.array([0.0, 7.3, 99.0]))["a", "b"] == pytest.approx([2.0] * 3)
    crossing = gaps_over_time(record(a=EAST, b=NORTH), np.array([0.0, 10.0]))["a", "b"]
    # At first corner to corner: 17.5 m along both axes.
    assert crossing[0] == pytest.approx(17.5 * 2**0.5)
    assert crossing[1] == pytest.approx(-2.5)


def test_alignment_is_a_distance_along_one_axis():
    """East passes x = 0 after 10 s, when the robot that stands at (0, 30) is 30 m north of it."""
    stands = track((0.0, 0.0, 30.0), (0.1, 0.0, 30.0))
    (found,) = alignments(record(east=EAST, far=stands))
    assert (found.along, found.time, found.distance) == (
        "y",
        pytest.approx(10.0),
        pytest.approx(30.0),
    )


def test_robots_in_line_stay_aligned():
    """Both on y = 0, 8 m apart, all the time: from the first sample to the last."""
    ahead = track((0.0, -12.0, 0.0), (20.0, 28.0, 0.0))
    found = [each for each in alignments(record(a=EAST, b=ahead)) if each.along == "x"]
    assert (found[0].time, found[-1].time) == (0.0, pytest.approx(20.0))
    assert all(each.distance == pytest.approx(8.0) for each in found)


def test_the_lone_planner_is_asked_for_each_robot():
    """A plan with room for everybody is that of robots alone: nobody yields."""
    scenario = read_scenario(scenario_folder() / "warehouse-8x24.toml")
    system = hierarchical(HierarchicalSettings())
    plan = make_plan(scenario, system=system, seed=0).record
    alone = lone_records(plan, system.plan, 0)
    assert set(alone) == {robot.id for robot in scenario.robots}
    slower = sum(each.lost for each in yieldings(plan, alone))
    behind = plan.sum_of_costs - sum(float(each.tracks[k].t[-1]) for k, each in alone.items())
    assert slower == pytest.approx(behind, abs=5.0)
