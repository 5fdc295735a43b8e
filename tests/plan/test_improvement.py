"""What more effort makes of a plan, and what is told meanwhile."""

import math
from dataclasses import replace

import pytest
from tests.plan.rooms import CARRIER, CART, EAST, NORTH, PIVOT, TRUCK, WEST, room, team, to
from tests.systems.sites import hall

from clearway.model import Pose, Status
from clearway.plan import PrioritisedPlanner
from clearway.plan.bounds import curve_bound, lower_bounds
from clearway.protocols import Budget
from clearway.systems import solve
from clearway.world.generate import generate

ORIGIN = Pose(0.0, 0.0, EAST)
ROOT = math.sqrt(3.0)


@pytest.fixture(scope="module")
def shelves():
    """A store of 40 m x 30 m with 14 robots."""
    return generate("shelves", robots=14, size=(40.0, 30.0), fleet="cars", seed=3)


@pytest.fixture(scope="module")
def first(shelves):
    """Its plan without a budget."""
    return solve(shelves)


@pytest.fixture(scope="module")
def runs(shelves, first):
    """Plans for more and more effort; the least is just enough for one."""
    enough = first.plan.counters["expansions"]
    return [solve(shelves, budget=Budget(expansions=enough + n)) for n in (0, 2_000, 60_000)]


def arrivals(plan):
    """When each robot comes to its last visit (s)."""
    return [t.stops[-1].arrive / 1000.0 for t in plan.trajectories.values() if t.stops]


def test_a_plan_is_right_wherever_its_effort_ends(runs):
    """The judge finds nothing wrong with any of them."""
    for run in runs:
        assert run.plan.status is Status.SOLVED
        assert [str(violation) for violation in run.violations] == []


def test_costs_fall_with_effort(runs):
    """Never a dearer plan for more of it, and in a crowd a cheaper one for much."""
    costs = [run.record.sum_of_costs for run in runs]
    assert costs == sorted(costs, reverse=True)
    assert costs[-1] < costs[0]


def test_the_first_plan_is_told_by_the_counters(first, runs):
    """All runs of one seed begin with the same plan, whose cost the last of them remembers."""
    for run in runs:
        told = run.plan.counters["first_sum_of_costs_ms"] / 1000.0
        assert told == pytest.approx(first.record.sum_of_costs)
        assert run.plan.counters["repaired"] <= run.plan.counters["repairs"]
    assert runs[-1].plan.counters["repaired"] > 0


def test_no_plan_costs_less_than_the_bound(runs):
    """However much effort is spent."""
    for run in runs:
        assert run.plan.lower_bound <= run.record.sum_of_costs + 1e-6
        assert run.plan.lower_bound == pytest.approx(runs[0].plan.lower_bound)


def test_without_a_budget_the_first_plan_is_the_answer(first, runs):
    """Nothing says when to stop, so nothing is improved."""
    assert first.plan.counters["repairs"] == 0
    assert first.plan.trajectories == runs[0].plan.trajectories


def test_progress_tells_of_ever_better_plans(shelves):
    """From the first complete plan on a sum is told that never rises nor passes the bound."""
    told = []
    run = solve(shelves, budget=Budget(expansions=60_000), progress=lambda *each: told.append(each))
    planned, totals, expansions, sums, bounds = zip(*told, strict=True)
    assert set(totals) == {14}
    assert set(bounds) == {run.plan.lower_bound}
    assert list(expansions) == sorted(expansions)
    complete = [cost for cost in sums if cost is not None]
    assert sums[-len(complete) :] == tuple(complete)
    assert set(planned[-len(complete) :]) == {14}
    assert complete == sorted(complete, reverse=True)
    assert run.plan.lower_bound <= complete[-1]
    assert complete[0] == pytest.approx(run.plan.counters["first_sum_of_costs_ms"] / 1000.0)
    assert complete[-1] >= math.fsum(arrivals(run.plan)) - 1e-6


def test_where_nothing_can_be_improved_the_told_sum_is_the_plans():
    """10 m at 1 m/s each, nobody in the way: one complete plan is told of, and it is the last."""
    problem = team(
        room(14.0, 8.0),
        (CART, (2.0, 2.0, EAST), to(12.0, 2.0)),
        (CART, (2.0, 6.0, EAST), to(12.0, 6.0)),
    )
    told = []
    plan = PrioritisedPlanner()(
        problem, Budget(expansions=50_000), 0, lambda *each: told.append(each)
    )
    assert [each[3] for each in told if each[3] is not None] == [20.0]
    assert math.fsum(arrivals(plan)) == pytest.approx(20.0)
    assert plan.lower_bound == pytest.approx(20.0)


def test_for_the_makespan_the_last_never_comes_later(shelves, first, runs):
    """The same first plan, then another aim."""
    settings = {**shelves.settings, "objective": "makespan"}
    spent = runs[-1].plan.counters["expansions"]
    soonest = solve(replace(shelves, settings=settings), budget=Budget(expansions=spent))
    assert soonest.violations == ()
    assert soonest.record.makespan <= first.record.makespan
    assert soonest.record.parameters["objective"] == "makespan"


def test_a_hall_is_planned_for_the_makespan():
    """A setting of the scenario like any other."""
    run = solve(hall(settings={"objective": "makespan"}), budget=Budget(expansions=20_000))
    assert run.plan.status is Status.SOLVED
    assert run.violations == ()
    assert run.record.makespan == pytest.approx(max(arrivals(run.plan)))


@pytest.mark.parametrize(
    ("goal", "length"),
    [
        (Pose(10.0, 0.0, EAST), 10.0),
        (Pose(-7.0, 0.0, EAST), 7.0),
        (Pose(2.0, 2.0, NORTH), math.pi),  # a quarter of a circle of radius 2
        (Pose(0.0, 4.0, WEST), 2.0 * math.pi),  # half of it
        (Pose(0.0, 0.0, WEST), 2.0 * math.pi),  # three turn about on the spot, of pi / 3 each
        (Pose(7.0, 2.0, NORTH), 5.0 + math.pi),  # 5 m and a quarter
        # A lane change: left by pi / 6, 3 m straight, right by pi / 6. Each arc goes
        # 2 sin(pi / 6) = 1 ahead and 2 - sqrt(3) aside, the straight 1.5 sqrt(3) and 1.5.
        (Pose(2.0 + 1.5 * ROOT, 5.5 - 2.0 * ROOT, EAST), 3.0 + 2.0 * math.pi / 3.0),
    ],
)
def test_a_car_drives_no_shorter_than_its_curve(goal, length):
    """Arcs of 2 m and straights, from the origin, and likewise from anywhere else."""
    assert curve_bound(TRUCK, ORIGIN, goal) == pytest.approx(length)
    start = Pose(3.0, -4.0, 2.5)
    assert curve_bound(TRUCK, start, start.compose(goal)) == pytest.approx(length)


@pytest.mark.parametrize("robot_type", [PIVOT, CARRIER])
def test_who_can_turn_on_the_spot_is_bound_by_the_air_line(robot_type):
    """A quarter turn beside it costs no way."""
    assert curve_bound(robot_type, ORIGIN, Pose(3.0, 4.0, NORTH)) == pytest.approx(5.0)


def test_a_cars_time_is_bound_by_its_curve():
    """Half a circle of radius 2 at 2 m/s, where the air line of 4 m would take 2 s."""
    problem = team(room(20.0, 20.0), (TRUCK, (10.0, 5.0, EAST), to(10.0, 9.0, WEST)))
    assert lower_bounds(problem).seconds == pytest.approx(math.pi)
    assert lower_bounds(problem).metres == pytest.approx(2.0 * math.pi)
