"""Routing libraries as assigners, where they are installed."""

import importlib
from dataclasses import replace

import numpy as np
import pytest
from tests.oracles.brute_force_assignment import optimum

from clearway.assign.ortools_routing import OrToolsRouting
from clearway.assign.partner import NotInstalled
from clearway.assign.pyvrp_routing import PyVrpRouting
from clearway.protocols import Weights, objective

PARTNERS = {"ortools": OrToolsRouting, "pyvrp": PyVrpRouting}


class Ticking:
    """A clock that is a millisecond later each time it is read."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += 0.001
        return self.now


@pytest.fixture(params=PARTNERS)
def partner(request):
    pytest.importorskip(request.param)
    return PARTNERS[request.param]


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("seed", range(4))
def test_small_problems_are_solved(make_problem, partner, seed, even):
    """Unlike robots, some pairs forbidden: never below the optimum, and near it."""
    problem = make_problem(seed, m=2, n=5, refused=0.2, weights=Weights(0.0, 1.0, 1.0))
    assign = partner(even, seconds=3.0, clock=Ticking())
    if assign.unsupported(problem):
        pytest.skip("no even split")
    least = optimum(problem, even)
    found = objective(problem, assign(problem, seed)).value
    assert least - 1e-9 <= found <= 1.02 * least


def test_the_longest_route_counts_with_ortools(make_problem):
    """The span is in its objective: with that alone in the weights it finds the optimum."""
    pytest.importorskip("ortools")
    problem = make_problem(3, m=2, n=5, weights=Weights(1.0, 0.0, 0.0))
    found = objective(problem, OrToolsRouting(seconds=0.5, clock=Ticking())(problem, 0)).value
    assert found == pytest.approx(optimum(problem), abs=0.01)


def test_limits_shorten_the_longest_route_with_pyvrp(make_problem):
    """It knows no longest route; runs under ever tighter limits spare it."""
    pytest.importorskip("pyvrp")
    problem = make_problem(0, m=3, n=9, weights=Weights(5.0, 1.0, 0.0))
    one, many = (
        objective(problem, PyVrpRouting(seconds=0.2 * n, runs=n, clock=Ticking())(problem, 0))
        for n in (1, 6)
    )
    assert many.max_distance < one.max_distance
    assert many.value < one.value


def test_nothing_to_do(make_problem, partner):
    """Without tasks everybody stays."""
    assert partner()(make_problem(0, m=2, n=0), 0) == ((), ())


def test_timed_problems_are_refused(make_problem, partner):
    """They are not put to the library, and that is said."""
    timed = make_problem(0, timed=0)
    assert "due times" in partner().unsupported(timed)[0]
    with pytest.raises(ValueError, match="due times"):
        partner()(timed, 0)


def test_no_even_split_is_told(make_problem, partner):
    """Three tasks kept for one of two robots do not take its two seats."""
    problem = make_problem(0, m=2, n=3)
    kept = replace(problem, allowed=np.array([[True] * 3, [False] * 3]))
    assert "split" in partner(even=True).unsupported(kept)[0]
    assert partner(even=False).unsupported(kept) == ()


@pytest.mark.parametrize("name", PARTNERS)
def test_a_library_that_is_missing_is_named(make_problem, monkeypatch, name):
    """The message says what to install."""

    def missing(module):
        raise ModuleNotFoundError(f"No module named {module}")

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(NotInstalled, match=rf"{name} is not installed: .*clearway\[baselines\]"):
        PARTNERS[name]()(make_problem(0), 0)


@pytest.mark.parametrize("kind", PARTNERS.values())
def test_no_time_is_an_error(kind):
    """A limit of nothing would find nothing."""
    with pytest.raises(ValueError, match="seconds must be above 0"):
        kind(seconds=0.0)
