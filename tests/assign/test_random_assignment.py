"""Tasks shared out by chance."""

from collections import Counter

import numpy as np
import pytest

from clearway.assign import RandomAssigner
from clearway.protocols import objective


def test_tours_are_as_even_as_can_be(make_problem):
    """Eleven tasks for four robots: the first 11 mod 4 = 3 have three, the last has two."""
    routes = RandomAssigner()(make_problem(0, m=4, n=11), 5)
    assert [len(route) for route in routes] == [3, 3, 3, 2]


def test_every_order_comes_up(make_problem):
    """Three tasks of one robot have six orders; in 600 draws each comes near 100 times."""
    problem = make_problem(0, m=1, n=3)
    drawn = Counter(RandomAssigner()(problem, seed)[0] for seed in range(600))
    assert len(drawn) == 6
    assert min(drawn.values()) > 60


def test_a_free_split_leaves_some_robots_idle(make_problem):
    """Two tasks fall to the same one of two robots about every other time."""
    problem = make_problem(0, m=2, n=2)
    idle = sum(() in RandomAssigner(even=False)(problem, seed) for seed in range(200))
    assert 70 < idle < 130


@pytest.mark.parametrize("even", [True, False])
def test_choosy_robots_get_what_they_may_do(make_problem, even):
    """However few tasks a robot may do, chance respects it."""
    for seed in range(20):
        problem = make_problem(seed, m=3, n=6, refused=0.2)
        assign = RandomAssigner(even)
        if not assign.unsupported(problem):
            routes = assign(problem, seed)
            objective(problem, routes)
            assert not even or max(map(len, routes)) == 2


def test_chance_beats_no_optimum(proven):
    """Random even routes are never worth less than the proven optimum."""
    problem, split, answer = proven
    if split == "even":
        worths = [objective(problem, RandomAssigner()(problem, s)).value for s in range(20)]
        assert min(worths) >= answer["F"] - 1e-6
        assert np.mean(worths) > answer["F"]
