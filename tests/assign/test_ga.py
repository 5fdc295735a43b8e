"""The genetic algorithm."""

import math

import numpy as np
import pytest
from tests.assign.conftest import random_problem

from clearway.assign import Ga, GaParams, ga
from clearway.assign.ga import roulette


def test_parents_are_drawn_by_merit():
    """Values 1, 2 and 5: merits 4, 3 and 0, so shares 4/7, 3/7 and none."""
    rng = np.random.default_rng(0)
    drawn = np.concatenate([roulette(rng, np.array([1.0, 2.0, 5.0])) for _ in range(2000)])
    shares = np.bincount(drawn, minlength=3) / len(drawn)
    assert shares == pytest.approx([4 / 7, 3 / 7, 0.0], abs=0.03)


def test_equals_are_drawn_alike():
    """Nobody is better than the worst: all have the same chance."""
    rng = np.random.default_rng(1)
    drawn = np.concatenate([roulette(rng, np.full(4, 3.0)) for _ in range(1000)])
    assert np.bincount(drawn) / len(drawn) == pytest.approx([0.25] * 4, abs=0.04)


def test_the_best_of_all_generations_is_returned():
    """Generations may get worse, for no elite survives; the answer does not."""
    trace = Ga().trace(random_problem(2, 4, 16), 0)
    assert trace.history == tuple(sorted(trace.history, reverse=True))
    assert trace.objective.value == pytest.approx(trace.history[-1], rel=1e-12)
    assert trace.evaluations == 30 * 201


def test_without_crossover_and_mutation_nothing_new_is_found():
    """Selection alone keeps to the first population, so the first best stays the best."""
    trace = Ga(GaParams(p_crossover=0.0, p_mutation=0.0)).trace(random_problem(2, 4, 16), 0)
    assert len(set(trace.history)) == 1


def test_selection_pays(monkeypatch):
    """Parents drawn evenly instead of by merit lead to values that are a tenth worse."""
    problem = random_problem(3, 4, 16)

    def mean():
        return np.mean([Ga().trace(problem, seed).objective.value for seed in range(3)])

    by_merit = mean()
    monkeypatch.setattr(ga, "roulette", lambda rng, value: rng.integers(len(value), size=30))
    assert by_merit < 0.9 * mean()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("individuals", 0),
        ("individuals", math.nan),
        ("individuals", 2.5),
        ("generations", -1),
        ("generations", math.inf),
        ("p_crossover", 1.1),
        ("p_mutation", math.nan),
    ],
)
def test_wrong_parameters_are_named(name, value):
    with pytest.raises(ValueError, match=name):
        GaParams(**{name: value})
