"""Insertion with local search against proven optima."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.assign.conftest import random_problem
from tests.oracles.brute_force_assignment import optimum

from clearway.assign import InsertionLocalSearch, InsertionParams
from clearway.protocols import check_routes, objective


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_proven_optima_are_neared_and_never_beaten(proven, seed):
    """Free splits reach the proven optimum, even ones come within 2.5 % of it."""
    problem, split, answer = proven
    assign = InsertionLocalSearch(InsertionParams(even=split == "even"))
    worth = objective(problem, assign(problem, seed)).value
    assert worth >= answer["F"] - 1e-6
    assert worth <= answer["F"] * (1.0 if split == "free" else 1.025) + 1e-5


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    m=st.integers(1, 3),
    n=st.integers(0, 4),
    refused=st.sampled_from([0.0, 0.4, 1.0]),
    even=st.booleans(),
)
def test_trying_everything_finds_nothing_better_than_allowed(seed, m, n, refused, even):
    """No legal routes are worth less than the best of all; an even split exists or is refused."""
    problem = random_problem(seed, m, n, refused)
    assign = InsertionLocalSearch(InsertionParams(rounds=5, even=even))
    best = optimum(problem, even)
    assert (best == np.inf) == bool(assign.unsupported(problem))
    if best < np.inf:
        routes = assign(problem, seed)
        check_routes(problem, routes)
        assert objective(problem, routes).value >= best - 1e-6


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("even", [False, True])
def test_tiny_problems_are_solved_to_the_optimum(seed, even):
    """Four tasks of three choosy robots: what trying everything finds, the search finds."""
    problem = random_problem(seed, m=3, n=4, refused=0.3)
    assign = InsertionLocalSearch(InsertionParams(even=even))
    assert objective(problem, assign(problem, seed)).value == pytest.approx(optimum(problem, even))


def test_even_seats_are_found_where_insertion_misses_them():
    """Here cheapest insertion fills the seats of the only robot for a late task; it still sits."""
    problem = random_problem(216, m=4, n=8, refused=0.55)
    routes = InsertionLocalSearch(InsertionParams(rounds=0, even=True))(problem, 0)
    check_routes(problem, routes)
    assert {len(route) for route in routes} == {2}


def test_rounds_mend_what_insertion_leaves():
    """More rounds are never worse from the same seed, and here they are better."""
    problem = random_problem(3, m=4, n=20)
    worths = [
        objective(problem, InsertionLocalSearch(InsertionParams(rounds))(problem, 1)).value
        for rounds in (0, 5, 60)
    ]
    assert worths == sorted(worths, reverse=True)
    assert worths[-1] < worths[0]


def test_evaluations_bound_the_search():
    """Without evaluations the routes are those of plain insertion: legal, and worse."""
    problem = random_problem(4, m=4, n=20)
    plain = InsertionLocalSearch(InsertionParams(evaluations=0))(problem, 0)
    best = InsertionLocalSearch()(problem, 0)
    assert objective(problem, best).value < objective(problem, plain).value


@pytest.mark.parametrize("changes", [{"rounds": -1}, {"evaluations": -1}])
def test_effort_is_not_negative(changes):
    """Less than no effort is refused by name."""
    with pytest.raises(ValueError, match=next(iter(changes))):
        InsertionParams(**changes)
