"""Optima, proven."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.oracles.brute_force_assignment import optimum

from clearway.assign import ExactAssigner, RuinRecreate, RuinRecreateParams
from clearway.protocols import Weights, objective


def test_every_published_optimum_is_hit(proven):
    """Even and free splits of the published instances, 16 tasks and 8 robots among them."""
    problem, split, answer = proven
    worth = objective(problem, ExactAssigner(even=split == "even")(problem, 0))
    assert worth.value == pytest.approx(answer["F"], abs=1e-5)


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("even", [True, False])
def test_trying_everything_finds_nothing_better(make_problem, seed, even):
    """Unlike robots, a third of the pairs forbidden, one to three robots, any weights."""
    weights = None
    if seed % 3 == 0:
        weights = Weights(
            *[(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0,) * 3][seed % 4]
        )
    problem = make_problem(seed, m=1 + seed % 3, n=5, refused=0.3, weights=weights)
    assign = ExactAssigner(even)
    least = optimum(problem, even)
    if math.isinf(least):
        assert "split" in assign.unsupported(problem)[0]
    else:
        assert objective(problem, assign(problem, seed)).value == pytest.approx(least)


@pytest.mark.parametrize("seed", range(8))
def test_ways_that_are_missing_are_not_driven(make_problem, seed):
    """With two of three legs between tasks missing, the best of what is left is found."""
    problem = make_problem(seed, m=2, n=5)
    missing = np.random.default_rng(seed).random((2, 5, 5)) < 0.66
    problem = replace(problem, task_to_task=np.where(missing, np.inf, problem.task_to_task))
    least = optimum(problem)
    if math.isinf(least):
        with pytest.raises(ValueError, match="no way: robot r"):
            ExactAssigner(even=False)(problem, 0)
    else:
        found = objective(problem, ExactAssigner(even=False)(problem, 0)).value
        assert found == pytest.approx(least)


def test_equal_distances_are_no_trap(make_problem):
    """Where every leg takes 1 m, 16 tasks of 4 robots take 4 + 16 m, whatever the order."""
    problem = make_problem(0, m=4, n=16, weights=Weights(1.0, 1.0, 0.0))
    problem = replace(
        problem, start_to_task=np.ones(()), task_to_task=np.ones(()), inner=np.zeros(())
    )
    assert objective(problem, ExactAssigner(even=False)(problem, 0)).value == 20.0


def test_a_single_robot_takes_the_shortest_order(make_problem):
    """One robot, nine tasks on a line from 9 m to 1 m: it drives to the near end first."""
    problem = make_problem(0, m=1, n=9, weights=Weights(1.0, 1.0, 0.0))
    place = np.arange(9, 0, -1.0)
    problem = replace(
        problem,
        start_to_task=place,
        task_to_task=np.abs(place[:, None] - place),
        inner=np.zeros(()),
    )
    assert ExactAssigner()(problem, 0) == (tuple(range(8, -1, -1)),)


def test_the_free_optimum_is_never_above_the_even_one(make_problem):
    """Every even split is a free one, too (A-26)."""
    for seed in range(5):
        problem = make_problem(seed, m=3, n=10)
        even, free = (objective(problem, ExactAssigner(e)(problem, 0)).value for e in (True, False))
        assert free <= even + 1e-9


@pytest.mark.parametrize("seed", range(8))
def test_a_long_search_finds_nothing_better(make_problem, seed):
    """Thirteen tasks, unlike robots, a fifth of the pairs forbidden: no value below the proof."""
    problem = make_problem(seed, m=1 + seed % 4, n=13, refused=0.2)
    for even in (True, False):
        if not ExactAssigner(even).unsupported(problem):
            proof = objective(problem, ExactAssigner(even)(problem, 0)).value
            search = RuinRecreate(even, RuinRecreateParams(rounds=4000))
            assert proof <= objective(problem, search(problem, seed)).value + 1e-9


def test_more_than_it_can_prove_is_refused(make_problem):
    """Seventeen tasks, or timed ones; both told at once."""
    (told,) = ExactAssigner().unsupported(make_problem(0, m=3, n=17))
    assert "17 tasks are more than the 16" in told
    timed = make_problem(0, m=3, n=17, timed=0)
    assert len(ExactAssigner().unsupported(timed)) == 2
    with pytest.raises(ValueError, match="17 tasks"):
        ExactAssigner()(timed, 0)
