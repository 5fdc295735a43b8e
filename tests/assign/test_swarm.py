"""The ladder of assigners on permutations, and the loop of the swarms."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.assign.conftest import random_problem
from tests.oracles.brute_force_assignment import optimum

from clearway.assign import (
    LITERAL,
    Apsga,
    ApsgaParams,
    BreedingParams,
    Coefficients,
    FlightParams,
    Ga,
    GaParams,
    Psga,
    PsgaParams,
    Pso,
    PsoParams,
    SwarmParams,
    swarm,
)
from clearway.assign.flight import fly
from clearway.assign.permutation import decode
from clearway.protocols import check_routes, objective

SHORT = SwarmParams(iterations=60)
LADDER = {
    "pso": Pso(PsoParams(SHORT)),
    "ga": Ga(GaParams(generations=60)),
    "psga": Psga(PsgaParams(SHORT)),
    "apsga": Apsga(ApsgaParams(SHORT)),
    "psga, literal": Psga(PsgaParams(SHORT, breeding=LITERAL)),
    "apsga, literal": Apsga(ApsgaParams(SHORT, LITERAL)),
}


def effort(particles, iterations):
    """All four with as little effort as asked for."""
    swarm = SwarmParams(particles, iterations)
    return (
        Pso(PsoParams(swarm)),
        Ga(GaParams(particles, iterations)),
        Psga(PsgaParams(swarm)),
        Apsga(ApsgaParams(swarm)),
    )


@pytest.fixture(params=LADDER)
def assign(request):
    return LADDER[request.param]


def test_no_proven_optimum_is_beaten(assign, proven):
    """Even routes are worth at least the optimum of even splits."""
    problem, split, answer = proven
    if split == "even":
        for seed in range(2):
            assert assign.trace(problem, seed).objective.value >= answer["F"] - 1e-6


@pytest.mark.parametrize("seed", range(2))
def test_tiny_problems_are_solved_to_the_optimum(assign, seed):
    """Five tasks of two robots, padded to six: 720 permutations, thousands of which are tried."""
    problem = random_problem(seed, m=2, n=5)
    assert assign.trace(problem, 0).objective.value == pytest.approx(optimum(problem, even=True))


def test_elitist_swarms_come_near_the_optimum(proven):
    """Breeding from personal bests ends within a tenth of even optima of 12 and 16 tasks."""
    problem, split, answer = proven
    if split == "even" and len(problem.tasks) >= 12:
        for elitist in (Psga(), Apsga()):
            found = [elitist.trace(problem, seed).objective.value for seed in range(3)]
            assert np.mean(found) <= 1.1 * answer["F"]


def test_readings_differ_as_the_paper_needs():
    """Breeding from personal bests ends at least a tenth below breeding to the letter."""
    problem = random_problem(0, m=4, n=16)

    def mean(assign):
        return np.mean([assign.trace(problem, seed).objective.value for seed in range(3)])

    assert mean(Apsga()) < 0.9 * mean(Apsga(ApsgaParams(breeding=LITERAL)))


def test_routes_are_even_with_one_short_where_they_must_be():
    """Eleven tasks of four robots have one seat too many."""
    problem = random_problem(0, m=4, n=11)
    for assign in LADDER.values():
        trace = assign.trace(problem, 1)
        assert sorted(map(len, trace.routes)) == [2, 3, 3, 3]
        assert trace.padding == 1


def test_a_trace_tells_how_the_routes_were_found(assign):
    """Its history falls to the value of its routes, one number per iteration and the start."""
    problem = random_problem(2, m=4, n=12)
    trace = assign.trace(problem, 3)
    check_routes(problem, trace.routes)
    assert trace.objective == objective(problem, trace.routes)
    assert trace.padding == 0
    assert len(trace.history) == 61
    assert list(trace.history) == sorted(trace.history, reverse=True)
    assert trace.history[-1] == pytest.approx(trace.objective.value, rel=1e-12)
    assert trace.history[-1] < trace.history[0]
    assert assign(problem, 3) == trace.routes


def test_the_best_leads_and_the_loop_tells_how_it_stands(monkeypatch):
    """Four steps at 0, 1/4, 1/2 and 3/4 of the run, each behind the best found by then."""
    problem = random_problem(2, m=4, n=12)
    told, led = [], []

    def coefficients(*state):
        told.append(state)
        return Coefficients()

    def watched(rng, params, step, positions, velocities, bests, leader):
        mean = np.mean([value(row) for row in positions])
        led.append((value(leader), mean))
        return fly(rng, params, step, positions, velocities, bests, leader)

    def value(row):
        return objective(problem, decode(row, 4, 12)).value

    monkeypatch.setattr(swarm, "fly", watched)
    trace = swarm.search(problem, 0, SwarmParams(iterations=4), coefficients)
    assert [progress for progress, _, _ in told] == [0.0, 0.25, 0.5, 0.75]
    assert [best for _, best, _ in told] == list(trace.history[:-1])
    assert np.array(led) == pytest.approx(np.array(told)[:, 1:], rel=1e-12)


def test_effort_is_counted():
    """30 permutations at the start and in each of 60 iterations; elitist swarms price twice."""
    problem = random_problem(2, m=4, n=12)
    counts = {name: assign.trace(problem, 0).evaluations for name, assign in LADDER.items()}
    once, twice = 30 * 61, 30 * 121
    assert counts == {
        "pso": once,
        "ga": once,
        "psga": twice,
        "apsga": twice,
        "psga, literal": once,
        "apsga, literal": once,
    }


def test_the_seed_decides_everything(assign):
    """Same seed, same trace; another seed, another one."""
    problem = random_problem(3, m=4, n=16)
    assert assign.trace(problem, 7) == assign.trace(problem, 7)
    assert assign.trace(problem, 7).history != assign.trace(problem, 8).history


def test_all_costs_scale_together(assign):
    """Twice the distances and turns (exact in binary) lead to the same routes, worth twice."""
    problem = random_problem(4, m=3, n=9)
    twice = replace(
        problem,
        start_to_task=2.0 * problem.start_to_task,
        task_to_task=2.0 * problem.task_to_task,
        start_turn=2.0 * problem.start_turn,
        task_turn=2.0 * problem.task_turn,
        inner=2.0 * problem.inner,
    )
    one, other = assign.trace(problem, 5), assign.trace(twice, 5)
    assert other.routes == one.routes
    assert other.objective.value == 2.0 * one.objective.value


@pytest.mark.parametrize(
    "other",
    [
        ApsgaParams(breeding=BreedingParams(parents="positions")),
        ApsgaParams(breeding=BreedingParams(survival="always")),
        ApsgaParams(breeding=BreedingParams(p_mutation=0.5)),
        ApsgaParams(breeding=BreedingParams(p_crossover=0.5)),
        ApsgaParams(swarm=SwarmParams(flight=FlightParams("textbook"))),
        ApsgaParams(swarm=SwarmParams(flight=FlightParams(velocity_bound=2.0))),
    ],
)
def test_every_choice_changes_the_run(other):
    """From the same start another choice leads elsewhere."""
    problem = random_problem(5, m=4, n=16)
    other = replace(other, swarm=replace(other.swarm, iterations=20))
    default = Apsga(ApsgaParams(SwarmParams(iterations=20))).trace(problem, 0).history
    chosen = Apsga(other).trace(problem, 0).history
    assert chosen[0] == default[0]
    assert chosen != default


@pytest.mark.parametrize("particles", [1, 2, 3])
def test_a_swarm_may_be_tiny(particles):
    """One particle, alone with itself, and odd numbers of them still make legal routes."""
    problem = random_problem(6, m=3, n=7)
    for assign in effort(particles, 20):
        trace = assign.trace(problem, 0)
        check_routes(problem, trace.routes)
        assert len(trace.history) == 21


def test_no_iterations_leave_the_best_of_the_start():
    """T = 0 returns the best of N random permutations, better than one alone on the mean."""
    problem = random_problem(6, m=3, n=9)
    for alone, many in zip(effort(1, 0), effort(30, 0), strict=True):
        traces = [alone.trace(problem, seed) for seed in range(20)]
        assert all(len(trace.history) == trace.evaluations == 1 for trace in traces)
        best = [many.trace(problem, seed).objective.value for seed in range(20)]
        assert np.mean(best) < np.mean([trace.objective.value for trace in traces])


def test_a_site_without_distances_is_no_trouble():
    """All costs 0: any routes will do, and nothing is divided by 0."""
    problem = replace(
        random_problem(0, m=2, n=4),
        start_to_task=np.zeros((2, 4)),
        task_to_task=np.zeros(()),
        start_turn=np.zeros(()),
        task_turn=np.zeros(()),
        inner=np.zeros(()),
    )
    for assign in LADDER.values():
        assert assign.trace(problem, 0).objective.value == 0.0


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"due": np.array([9.0, np.inf, np.inf])}, "task t0 has a due time.*RuinRecreate"),
        ({"before": ((2, 1),)}, "task t1 waits for task t2.*leave out due and before"),
        (
            {"allowed": np.array([[True, True, True], [True, False, True]])},
            "robot r1 may not do task t1.*InsertionLocalSearch",
        ),
        (
            {"task_to_task": np.array([[0.0, 1.0, 1.0], [1.0, 0.0, np.inf], [1.0, 1.0, 0.0]])},
            "robot r0 finds no way from task t1 to task t2.*InsertionLocalSearch",
        ),
    ],
)
def test_what_permutations_cannot_encode_is_refused_with_a_mend(assign, changes, told):
    problem = replace(random_problem(0, m=2, n=3), **changes)
    assert len(assign.unsupported(problem)) == 1
    for call in (assign, assign.trace):
        with pytest.raises(ValueError, match=told):
            call(problem, 0)


def test_no_way_from_a_task_to_itself_is_no_matter(assign):
    """The diagonal is never driven."""
    problem = random_problem(0, m=2, n=3)
    between = problem.task_to_task.copy()
    between[:, range(3), range(3)] = np.inf
    problem = replace(problem, task_to_task=between)
    assert assign.unsupported(problem) == ()
    check_routes(problem, assign(problem, 0))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("particles", 0),
        ("particles", math.nan),
        ("particles", 1.5),
        ("iterations", -1),
        ("iterations", math.nan),
        ("iterations", math.inf),
    ],
)
def test_wrong_effort_is_named(name, value):
    with pytest.raises(ValueError, match=name):
        SwarmParams(**{name: value})
