"""Conflict-based search against joint brute force, what it refuses, and how it stops."""

import math
from dataclasses import replace

import pytest
from tests.oracles.joint_lattice import least_cost
from tests.plan.rooms import CAR, CARRIER, EAST, TRUCK, TUG, WEST, judged, room, team, to
from tests.plan.tiny_seeds import FREE, MEETING, NO_PLAN
from tests.plan.tiny_teams import SPINNER, tiny_team

from clearway.metrics.paper_cost import paper_cost
from clearway.model import Plan, Problem, Robot, Status, to_seconds
from clearway.plan.conflict_based import ConflictBasedSearch, ConflictParams
from clearway.protocols import Budget

LARGEST = 4_000  # joint states that brute force looks at
FACTOR = 1.2


def settings(seed: int) -> dict:
    """Slots of half a second or a whole one; time or the paper's cost."""
    return {"slot": (500, 1000)[seed % 2], "paper_cost": seed % 4 >= 2}


def plan(problem: Problem, expansions: int | None = None, **params) -> Plan:
    """What conflict-based search makes of a problem."""
    search = ConflictBasedSearch(ConflictParams(**params))
    return search(problem, Budget(expansions=expansions), seed=0)


def cost_of(problem: Problem, made: Plan, paper: bool) -> float:
    """What a plan costs by its trajectories: metres of the paper's cost, or seconds."""
    if not paper:
        return sum(to_seconds(t.end) for t in made.trajectories.values())
    types = {robot.id: problem.robot_types[robot.type] for robot in problem.robots}
    return sum(paper_cost(t, types[name]) for name, t in made.trajectories.items())


def both(seed: int) -> tuple[Problem, dict, float, float]:
    """A tiny problem, its settings, and its least cost by brute force: met, and each alone."""
    problem, chosen = tiny_team(seed), settings(seed)
    best, alone = least_cost(problem, chosen["slot"], chosen["paper_cost"], LARGEST)
    unit = 1.0 if chosen["paper_cost"] else 1000.0
    return problem, chosen, best / unit, alone / unit


@pytest.mark.parametrize("seed", [*MEETING, *FREE])
def test_no_plan_on_the_graph_is_cheaper(seed):
    """The optimum is that of brute force; a bounded plan keeps its factor, a greedy one is none
    the better."""
    problem, chosen, best, alone = both(seed)
    assert (best > alone + 1e-6) == (seed in MEETING)
    near = pytest.approx(best, abs=5e-6)
    optimal = plan(problem, mode="optimal", **chosen)
    assert optimal.status is Status.SOLVED
    assert optimal.counters["proven"] == 1
    assert cost_of(problem, optimal, chosen["paper_cost"]) == near
    assert optimal.discrete_bound["value"] == near
    assert judged(problem, optimal) == []
    bounded = plan(problem, mode="bounded", factor=FACTOR, **chosen)
    assert bounded.counters["proven"] == 1
    assert bounded.discrete_bound["value"] <= best + 1e-6
    cost = cost_of(problem, bounded, chosen["paper_cost"])
    assert best - 5e-6 <= cost <= FACTOR * bounded.discrete_bound["value"] + 5e-6
    assert bounded.discrete_bound["factor"] <= FACTOR + 1e-5
    greedy = plan(problem, mode="adaptive", expansions=50_000, **chosen)
    if greedy.status is Status.SOLVED:
        assert cost_of(problem, greedy, chosen["paper_cost"]) >= best - 5e-6
        assert judged(problem, greedy) == []
    assert "value" not in greedy.discrete_bound


@pytest.mark.parametrize("seed", NO_PLAN)
def test_where_brute_force_ends_without_a_plan_nobody_finds_one(seed):
    """It says so or stops, and calls nothing infeasible that has ways for each robot alone."""
    problem, chosen, best, alone = both(seed)
    assert math.isinf(best) and math.isfinite(alone)
    for mode in ("optimal", "bounded", "adaptive"):
        made = plan(problem, expansions=2_000, mode=mode, **chosen)
        assert made.status is Status.STOPPED
        assert made.reason and not made.trajectories


def test_the_cases_are_of_all_kinds():
    """Two hundred: robots that meet, three of them, two visits, unlike ones, services."""
    seeds = [*MEETING, *FREE, *NO_PLAN]
    assert len(seeds) == len(set(seeds)) == 200
    problems = [tiny_team(seed) for seed in MEETING]
    assert len(problems) >= 50
    assert any(len(p.robots) == 3 for p in problems)
    assert sum(any(len(tour) == 2 for tour in p.tours.values()) for p in problems) >= 10
    assert sum(len({robot.type for robot in p.robots}) > 1 for p in problems) >= 20
    assert {settings(seed)["paper_cost"] for seed in MEETING} == {False, True}


@pytest.mark.parametrize("name", ["factor", "xi"])
@pytest.mark.parametrize("value", [0.99, math.nan, math.inf])
def test_factors_below_one_or_not_finite_are_refused(name, value):
    with pytest.raises(ValueError, match=f"{name} must be 1 or above and finite"):
        ConflictParams(**{name: value})


def test_slots_of_nothing_are_refused():
    with pytest.raises(ValueError, match="slot must be 1 or above"):
        ConflictParams(slot=0)


def test_names_that_nobody_knows_are_refused_with_those_that_are_known():
    with pytest.raises(ValueError, match="mode must be one of optimal, bounded, adaptive, got 'x'"):
        ConflictParams(mode="x")
    with pytest.raises(ValueError, match="heuristic must be one of auto, look_back, bound, paper"):
        ConflictParams(heuristic="x")
    with pytest.raises(ValueError, match="heuristic paper may say too much"):
        ConflictParams(heuristic="paper", mode="optimal")


def test_limits_of_acceleration_are_refused_by_the_name_of_the_robot_type():
    quick = replace(SPINNER, limits=replace(SPINNER.limits, acceleration=1.0))
    problem = team(room(5.0, 3.0), (quick, (1.0, 1.0, EAST), to(3.0, 1.0)))
    with pytest.raises(ValueError, match=r"spinner.*acceleration"):
        plan(problem)


def test_robots_that_start_in_motion_are_refused_by_name():
    problem = team(room(5.0, 3.0), (SPINNER, (1.0, 1.0, EAST), to(3.0, 1.0)))
    rolling = replace(
        problem, robots=(Robot("a", "spinner", problem.robots[0].start, start_speed=0.5),)
    )
    with pytest.raises(ValueError, match="robot a"):
        plan(rolling)


@pytest.mark.parametrize("kind", [TRUCK, TUG, CAR])
def test_the_bound_of_a_lone_robot_is_its_cost(kind):
    """Those that have no named modes pay no changes of mode."""
    problem = team(room(14.0, 10.0), (kind, (2.0, 2.0, EAST), to(8.0, 6.0, math.pi / 2.0)))
    made = plan(problem, mode="optimal")
    cost = cost_of(problem, made, True)
    assert made.discrete_bound["value"] == pytest.approx(cost, abs=5e-6)


def crossing() -> Problem:
    """Three cars and a carrier whose ways cross in the middle of a hall."""
    return team(
        room(16.0, 14.0),
        (CARRIER, (2.0, 7.0, EAST), to(14.0, 7.0)),
        (CAR, (14.0, 7.0, WEST), to(2.0, 7.0, WEST)),
        (CAR, (8.0, 2.0, math.pi / 2.0), to(8.0, 12.0, math.pi / 2.0)),
        (CAR, (8.0, 12.0, -math.pi / 2.0), to(8.0, 2.0, -math.pi / 2.0)),
    )


@pytest.mark.parametrize("mode", ["optimal", "bounded", "adaptive"])
def test_the_same_effort_gives_the_same_plan(mode):
    plans = [plan(crossing(), expansions=20_000, mode=mode) for _ in range(2)]
    assert plans[0] == plans[1]
    assert plans[0].status is Status.SOLVED


def test_a_search_that_proves_keeps_its_first_plan_when_time_is_up():
    """The bound at hand goes with it, and the factor that it leaves."""
    problem = crossing()
    search = ConflictBasedSearch(ConflictParams(mode="optimal"))
    greedy = search(problem, Budget(expansions=1_000_000), 0)
    stopped = search(problem, Budget(seconds=0.3), 0)
    assert greedy.status is stopped.status is Status.SOLVED
    assert judged(problem, stopped) == []


@pytest.mark.parametrize("seed", [116, 260])
def test_service_where_a_robot_rests_anyway_is_no_cost(seed):
    """It comes after the last arrival: the bound on the graph is not above the sum of arrivals."""
    problem = tiny_team(seed)
    made = plan(problem, mode="optimal", paper_cost=False)
    arrivals = sum(to_seconds(way.end) for way in made.trajectories.values())
    assert made.discrete_bound["value"] <= arrivals + 1e-6
    assert made.discrete_bound["factor"] == 1.0
