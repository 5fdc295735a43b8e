"""A swarm whose children descend."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.oracles.brute_force_assignment import optimum

from clearway.assign import MemeticApsga, MemeticParams
from clearway.protocols import objective


def test_published_optima_are_hit_by_nearly_every_seed(proven):
    """A-24: at least 19 of 20 seeds reach the optimum of an even split within 20 iterations."""
    problem, split, answer = proven
    if split == "even":
        assign = MemeticApsga(MemeticParams(iterations=20))
        found = np.array([objective(problem, assign(problem, seed)).value for seed in range(20)])
        assert found.min() >= answer["F"] - 1e-5
        assert (found <= answer["F"] + 1e-5).sum() >= 19


@pytest.mark.parametrize("timed", [None, 0, 2])
@pytest.mark.parametrize("seed", range(10))
def test_small_problems_are_solved(make_problem, seed, timed):
    """Unlike robots, forbidden pairs, due times, order, five tasks for two: the optimum."""
    problem = make_problem(seed, m=2, n=5, refused=0.2, timed=timed)
    least = optimum(problem, even=True)
    if math.isinf(least):
        assert "split" in MemeticApsga().unsupported(problem)[0]
    else:
        found = objective(problem, MemeticApsga()(problem, seed)).value
        assert found == pytest.approx(least)


def test_tasks_that_do_not_divide_are_padded(make_problem):
    """Seven tasks for three robots: nobody has more than three, the third may have one."""
    routes = MemeticApsga()(make_problem(0, m=3, n=7), 0)
    assert max(map(len, routes)) <= 3
    assert sorted(task for route in routes for task in route) == list(range(7))


def test_without_iterations_the_best_of_the_first_stays(make_problem):
    """T = 0 is a random swarm: legal, and seldom as good as one that descends."""
    problem = make_problem(0, m=3, n=9)
    drawn = objective(problem, MemeticApsga(MemeticParams(iterations=0))(problem, 1)).value
    assert drawn > objective(problem, MemeticApsga()(problem, 1)).value


def test_a_leg_that_is_missing_everywhere_is_told(make_problem):
    """One robot, two tasks and no way from either to the other."""
    problem = replace(make_problem(0, m=1, n=2), task_to_task=np.full((2, 2), np.inf))
    with pytest.raises(ValueError, match=r"robot r0 cannot go from task t. to t"):
        MemeticApsga()(problem, 0)


@pytest.mark.parametrize(
    ("params", "told"),
    [
        ({"particles": 0}, "particles"),
        ({"iterations": -1}, "iterations"),
        ({"mutation": 1.5}, "mutation"),
        ({"gamma": math.nan}, "gamma"),
        ({"c_max": 0.0, "c_min": 0.0}, "c_max and c_min"),
    ],
)
def test_parameters_are_checked(params, told):
    """An empty swarm or a chance above 1 is an error where it is written."""
    with pytest.raises(ValueError, match=told):
        MemeticParams(**params)
