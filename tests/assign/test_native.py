"""Values of many sets of routes, from the core."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from clearway.assign import native_costs, values
from clearway.protocols import objective


def sets_of(seed, m, n, number):
    """Orders of tasks and cuts between robots, some of whom have none."""
    rng = np.random.default_rng(seed)
    orders = np.array([rng.permutation(n) for _ in range(number)])
    inner = np.sort(rng.integers(0, n + 1, (number, m - 1)), axis=1)
    ends = np.zeros((number, 1), dtype=np.int64)
    return orders, np.hstack([ends, inner, ends + n])


def worth(problem, order, cuts):
    routes = [order[a:b] for a, b in pairwise(cuts)]
    try:
        return objective(problem, routes).value
    except ValueError:
        return math.inf


@pytest.mark.parametrize("timed", [None, 0, 3])
@pytest.mark.parametrize("seed", range(5))
def test_values_in_bulk_are_the_objective(make_problem, seed, timed):
    """Uneven routes of unlike robots, with due times and order or without, one by one."""
    problem = make_problem(seed, m=3, n=7, timed=timed)
    orders, cuts = sets_of(seed, 3, 7, 40)
    found = values(native_costs(problem), orders, cuts)
    wanted = [worth(problem, order, cut) for order, cut in zip(orders, cuts, strict=True)]
    assert np.isfinite(wanted).any()
    assert found == pytest.approx(wanted, rel=1e-12)


def test_what_is_not_legal_is_infinite(make_problem):
    """A forbidden pair, and a leg without a way, each make a set worthless, and no other."""
    problem = make_problem(1, m=2, n=3)
    between = problem.task_to_task.copy()
    between[0, 1, 0] = math.inf
    allowed = np.array([[True, True, True], [True, True, False]])
    costs = native_costs(replace(problem, task_to_task=between, allowed=allowed))
    found = values(
        costs, [[0, 1, 2], [1, 0, 2], [0, 1, 2], [1, 0, 2]], [[0, 3, 3]] * 2 + [[0, 2, 3]] * 2
    )
    assert np.isinf(found).tolist() == [False, True, True, True]


def test_one_cut_serves_all(make_problem):
    """An even split has the same cuts for all sets."""
    problem = make_problem(2, m=2, n=4)
    orders = [[0, 1, 2, 3], [3, 1, 2, 0]]
    found = values(native_costs(problem), orders, [0, 2, 4])
    assert found == pytest.approx([worth(problem, order, [0, 2, 4]) for order in orders])


@pytest.mark.parametrize(
    ("orders", "cuts", "told"),
    [
        ([[0, 1, 1]], [0, 2, 3], r"orders\[0\] must name each task once, but not 1"),
        ([[0, 1, 2], [0, 1, 3]], [0, 2, 3], r"orders\[1\].*not 3"),
        ([[0, 1, -1]], [0, 2, 3], "not -1"),
        ([[0, 1]], [0, 2, 3], "column per task"),
        ([[0, 1, 2]], [0, 3], "column more than there are robots"),
        ([[0, 1, 2]], [0, 4, 3], "rise from 0 to 3"),
        ([[0, 1, 2]], [0, -1, 3], "rise from 0 to 3"),
    ],
)
def test_nonsense_is_refused(make_problem, orders, cuts, told):
    """Tasks twice or unknown, and cuts that are none."""
    with pytest.raises(ValueError, match=told):
        values(native_costs(make_problem(0, m=2, n=3)), orders, cuts)


def test_robots_that_drive_alike_need_not_start_alike(make_problem):
    """A shared matrix and unlike starts: each robot keeps its own first leg."""
    unlike = make_problem(3, m=3, n=4)
    problem = replace(unlike, task_to_task=unlike.task_to_task[0], inner=unlike.inner[0])
    orders, cuts = sets_of(3, 3, 4, 20)
    wanted = [worth(problem, order, cut) for order, cut in zip(orders, cuts, strict=True)]
    assert values(native_costs(problem), orders, cuts) == pytest.approx(wanted)
