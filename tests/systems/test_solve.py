"""From a scenario to a judged plan."""

from dataclasses import replace

import pytest
from tests.systems.sites import CARRIER, hall

from clearway.coordinate import Unsupported
from clearway.metrics import to_json
from clearway.model import Limits, Order, Pose, Robot, Status, Task, Visit
from clearway.protocols import Budget
from clearway.systems import IllegalScenario, choose_system, solve
from clearway.validate import validate_plan

ENOUGH = Budget(expansions=50_000)


class Counting:
    """A clock that goes on by a second each time it is read."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += 1.0
        return self.now


def test_a_hall_is_solved_and_judged_right():
    """Both tasks are done, and the record, the figures and the plan agree."""
    run = solve(hall(), budget=ENOUGH)
    assert run.plan.status is Status.SOLVED
    assert run.violations == ()
    assert validate_plan(run.record) == []
    assert sorted(task for done in run.record.assignment.values() for task in done) == ["t1", "t2"]
    assert run.record.tours == run.plan.tours
    assert not run.interrupted
    assert to_json(run.metrics)["sum_of_costs"] == run.record.sum_of_costs


def test_without_a_clock_nothing_depends_on_time():
    """Two runs are equal, timings included: there are none."""
    one, other = solve(hall(), budget=ENOUGH), solve(hall(), budget=ENOUGH)
    assert one.record == other.record
    assert one.plan == other.plan
    assert one.record.timings == {}


def test_timings_come_from_the_clock_that_is_handed_in():
    """Each stage takes one reading of a clock that counts them; so does the first plan."""
    run = solve(hall(), budget=ENOUGH, clock=Counting())
    stages = ("check_s", "assign_s", "first_plan_s", "sample_s", "judge_s")
    assert run.record.timings == {**dict.fromkeys(stages, 1.0), "plan_s": 2.0}


def test_the_seed_is_the_scenarios_unless_another_is_given():
    """The record tells which one was used."""
    assert solve(hall(), budget=ENOUGH).record.seed == 5
    assert solve(hall(), budget=ENOUGH, seed=0).record.seed == 0


def test_the_system_is_the_one_named_unless_another_is_given():
    """The settings that were used stand in the record, whoever chose them."""
    chosen = choose_system(replace(hall(), settings={"assign": "random", "park": "never"}))
    parameters = solve(hall(), system=chosen, budget=ENOUGH).record.parameters
    assert parameters["assign"] == "random"
    assert parameters["park"] == "never"


def test_without_effort_the_record_still_holds_everything():
    """Stopped, with a reason, and right as far as it goes: everybody stands at the start."""
    run = solve(hall(), budget=Budget(expansions=0))
    assert run.plan.status is Status.STOPPED
    assert run.record.reason
    assert run.violations == ()
    assert len(run.record.robots) == 2


def test_a_fleet_without_tasks_is_done_at_once():
    """Nothing to do costs nothing."""
    run = solve(hall(orders=()), budget=ENOUGH)
    assert run.plan.status is Status.SOLVED
    assert run.record.sum_of_costs == 0.0
    assert run.record.makespan == 0.0


def test_a_pose_that_cannot_be_is_refused_before_any_search():
    """All findings are held, the message tells the first and how many there are."""
    pillar = Pose(15.0, 6.0, 0.0)
    bad = hall(robots=(Robot("a", "carrier", pillar), Robot("b", "carrier", Pose(40.0, 3.0, 0.0))))
    asked = []
    with pytest.raises(IllegalScenario) as error:
        solve(bad, budget=ENOUGH, progress=lambda *numbers: asked.append(numbers))
    assert {finding.kind for finding in error.value.findings} >= {
        "start_in_obstacle",
        "start_outside",
    }
    assert "robots[0].start" in str(error.value)
    assert "more" in str(error.value)
    assert asked == []


def test_what_no_part_can_take_is_refused_by_name():
    """Ramps in any direction at once are not planned: the robot type and the mend are named."""
    limits = Limits(speed=2.5, yaw_rate=0.57, acceleration=1.0)
    heavy = replace(CARRIER, kinematics="holonomic", limits=limits)
    with pytest.raises(Unsupported, match=r"carrier: acceleration.*remove"):
        solve(hall(robot_types={"carrier": heavy}), budget=ENOUGH)


def test_a_type_without_a_turning_radius_is_solved_too():
    """It drives straight, sideways and turns on the spot."""
    square = replace(CARRIER, limits=Limits(speed=2.5, yaw_rate=0.57))
    run = solve(hall(robot_types={"carrier": square}), budget=ENOUGH)
    assert run.plan.status is Status.SOLVED
    assert run.violations == ()


def test_progress_is_handed_through():
    """It is the planner's: at last all are planned, for a cost not below the bound."""
    told = []
    solve(hall(), budget=ENOUGH, progress=lambda *numbers: told.append(numbers))
    assert told[-1][:2] == (2, 2)
    assert told[-1][3] >= told[-1][4] > 0.0


def test_tasks_kept_for_robots_are_done_by_them():
    """Each crosses to the other side of the hall, because the tasks say so."""
    orders = tuple(
        Order(Task(id_, (Visit(id_, pose),), robot))
        for id_, pose, robot in (
            ("t1", Pose(25.0, 3.0, 0.0), "b"),
            ("t2", Pose(25.0, 9.0, 0.0), "a"),
        )
    )
    run = solve(hall(orders=orders), budget=ENOUGH)
    assert run.record.assignment == {"a": ("t2",), "b": ("t1",)}
    assert run.violations == ()
