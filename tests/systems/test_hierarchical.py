"""System A as a composition."""

import math
from dataclasses import replace

import pytest
from tests.systems.sites import CARRIER, hall

from clearway.formats.plan_file import dump_plan, parse_plan
from clearway.model import (
    Footprint,
    Limits,
    Order,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Task,
    Visit,
    Zone,
)
from clearway.protocols import Budget
from clearway.systems import choose_system, solve

ENOUGH = Budget(expansions=50_000)


def bay_hall(park):
    """A hall with a bay for each of two robots."""
    bays = tuple(
        Zone(
            f"bay-{k}",
            "parking",
            ((1, y - 1), (5, y - 1), (5, y + 1), (1, y + 1)),
            Pose(3.0, y, 0.0),
        )
        for k, y in ((1, 1.5), (2, 10.5))
    )
    base = hall()
    return hall(site=replace(base.site, zones=bays), settings={"park": park})


def ends(run):
    return {robot: tour[-1].task for robot, tour in run.plan.tours.items() if tour}


def test_robots_park_always_or_never_as_they_are_told():
    """Parking is a visit without a task, at the end of the tour."""
    always = solve(bay_hall("always"), budget=ENOUGH)
    assert set(ends(always).values()) == {None}
    assert always.violations == ()
    assert always.plan.status is Status.SOLVED
    never = solve(bay_hall("never"), budget=ENOUGH)
    assert None not in ends(never).values()


def test_parking_is_not_a_task():
    """It is in nobody's assignment."""
    run = solve(bay_hall("always"), budget=ENOUGH)
    assert sorted(task for done in run.record.assignment.values() for task in done) == ["t1", "t2"]


def test_an_even_split_gives_everybody_as_many():
    """Four tasks beside one robot: two each if even, or as it comes if not."""
    orders = tuple(
        Order(Task(f"t{k}", (Visit(f"t{k}", Pose(8.0 + 4.5 * k, 2.0, 0.0)),))) for k in range(4)
    )
    run = solve(hall(orders=orders, settings={"even": True}), budget=ENOUGH)
    assert [len(done) for done in run.record.assignment.values()] == [2, 2]


@pytest.mark.parametrize(("mode", "change"), [("lateral-left", 3.0), ("stop", 0.0)])
def test_the_cost_counts_the_change_from_the_mode_at_the_start(mode, change):
    """3 m for what leaves another mode than that it drives off in, 0 for what stands."""
    plain = solve(hall(), budget=ENOUGH)
    robots = tuple(replace(robot, start_mode=mode) for robot in hall().robots)
    run = solve(hall(robots=robots), budget=ENOUGH)
    assert run.violations == ()
    moving = len(run.plan.trajectories)
    assert run.record.cost == pytest.approx(plain.record.cost + moving * change)


def test_plans_for_the_paper_objective_are_right():
    """Metres, turning and mode switches are minimised instead of time."""
    run = solve(hall(settings={"objective": "paper"}), budget=ENOUGH)
    assert run.violations == ()
    assert run.record.cost_name == "paper"
    assert run.record.cost >= run.record.cost_lower_bound - 1e-6


def test_two_seeds_are_two_choices_of_random_tasks():
    """The random assigner draws from the seed alone."""
    site = Site(((0, 0), (60, 0), (60, 12), (0, 12)))
    orders = tuple(
        Order(Task(f"t{k}", (Visit(f"t{k}", Pose(8.0 + 4.5 * k, 6.0, 0.0)),))) for k in range(8)
    )
    scenario = hall(
        site=site,
        orders=orders,
        robots=(
            Robot("a", CARRIER.name, Pose(3.0, 1.5, 0.0)),
            Robot("b", CARRIER.name, Pose(3.0, 10.5, 0.0)),
        ),
        settings={"assign": "random"},
    )
    shared = {
        tuple(solve(scenario, budget=Budget(expansions=0), seed=seed).record.assignment.items())
        for seed in range(6)
    }
    assert len(shared) > 1


def test_a_system_is_a_value_made_anew():
    """Two scenarios of other settings do not share parts."""
    one, other = choose_system(hall()), choose_system(hall(settings={"weight": 3.0}))
    assert one.plan.params.search.weight != other.plan.params.search.weight


def test_a_task_waits_for_another_robots_task_and_for_its_release():
    """t2 is kept for b and waits for t1, a's; t1 is released at 30 s and due at 20 s."""
    first, second = hall().orders
    orders = (
        Order(replace(first.task, robot="a"), release=30.0, due=20.0),
        Order(replace(second.task, robot="b"), after=("t1",)),
    )
    run = solve(hall(orders=orders), budget=ENOUGH)
    assert run.violations == ()
    assert run.plan.status is Status.SOLVED
    one, other = (run.record.paths[robot].stops[0] for robot in ("a", "b"))
    assert one.arrive == 30_000
    assert other.arrive >= one.leave
    assert run.metrics.tardiness == pytest.approx(11.0)
    assert run.record.tours["b"][0].after == ("t1",)
    assert parse_plan(dump_plan(run.record)).tours == run.record.tours


@pytest.mark.parametrize("travel", ["grid", "curves", "planned"])
def test_whatever_ways_are_believed_the_plan_is_right_and_repeats(travel):
    """Two rounds within a budget of expansions, twice alike."""
    scenario = hall(settings={"travel": travel, "rounds": 2})
    budget = Budget(expansions=20_000)
    one, other = (solve(scenario, budget=budget) for _ in range(2))
    assert one.violations == ()
    assert one.record == other.record
    assert 0 < one.plan.counters["expansions"] <= 20_000
    assert one.plan.counters["reassigned"] in (0, 1, 2)


def test_tasks_change_hands_where_a_plan_shows_a_detour():
    """Which robot is nearer by the grid tells nothing of a car's turning round.

    The car that heads west stands 3 m behind the task, the other 12 m before it and heads for
    it. The grid gives the task to the first, whose way then proves to be the longer one.
    """
    car = RobotType(
        "car", Footprint.rectangle(3.0, 1.5), "ackermann", Limits(1.0, turning_radius=5.0)
    )
    scenario = hall(
        site=Site(((0, 0), (60, 0), (60, 30), (0, 30))),
        robot_types={"car": car},
        robots=(
            Robot("near", "car", Pose(27.0, 12.0, math.pi)),
            Robot("far", "car", Pose(18.0, 15.0, 0.0)),
        ),
        orders=(Order(Task("t", (Visit("t", Pose(30.0, 15.0, 0.0)),))),),
    )
    zero = {"turning": 0.0}
    before = solve(replace(scenario, settings=zero))
    after = solve(replace(scenario, settings={**zero, "rounds": 1}))
    planned = solve(replace(scenario, settings={**zero, "travel": "planned"}))
    assert before.record.assignment == {"near": ("t",), "far": ()}
    assert after.record.assignment == {"near": (), "far": ("t",)}
    assert planned.record.assignment == {"near": (), "far": ("t",)}
    gain = 1.0 - after.record.sum_of_costs / before.record.sum_of_costs
    assert after.plan.counters["reassigned"] == 1
    assert after.plan.counters["reassignment_gain_permille"] == round(1000.0 * gain) > 0
