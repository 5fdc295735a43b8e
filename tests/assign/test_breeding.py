"""Whose children a swarm has, and which of them stay."""

import math

import numpy as np
import pytest

from clearway.assign import ELITIST, LITERAL, BreedingParams
from clearway.assign.breeding import breed
from clearway.assign.permutation import random_population

BESTS = np.tile(np.arange(8), (6, 1))
POSITIONS = BESTS[:, ::-1]


def first_number(population):
    """A price that is least where the row begins with task 0."""
    return population[:, 0].astype(float)


def all_alike(population):
    return np.ones(len(population))


def bred(params, price=first_number, positions=POSITIONS, seed=0):
    return breed(np.random.default_rng(seed), params, positions, BESTS, price)


@pytest.mark.parametrize(("parents", "first"), [("bests", 0.0), ("positions", 7.0)])
def test_children_take_after_the_parents_chosen(parents, first):
    """All bests are alike and so are all positions, so children differ by nothing but mutation."""
    params = BreedingParams(parents, "always", p_mutation=0.0)
    children, value = bred(params)
    assert (children == (BESTS if parents == "bests" else POSITIONS)).all()
    assert (value == first).all()


def test_a_child_must_be_better_to_stay():
    """Children of the bests begin with 0: better than 7 by this price, worse by its opposite."""
    params = BreedingParams("bests", "better", p_mutation=0.0)
    better, value = bred(params)
    assert (better == BESTS).all()
    assert (value == 0.0).all()
    worse, value = bred(params, lambda them: -first_number(them))
    assert (worse == POSITIONS).all()
    assert (value == -7.0).all()


def test_children_that_are_no_better_do_not_stay():
    """Where all are worth the same, nobody gives way."""
    always = BreedingParams("bests", "always", p_mutation=0.0)
    assert (bred(ELITIST, all_alike)[0] == POSITIONS).all()
    assert (bred(always, all_alike)[0] == BESTS).all()


def test_values_are_those_of_what_stays():
    """Under either reading the values returned are the prices of the rows returned."""
    positions = random_population(np.random.default_rng(1), 6, 8)
    for params in (ELITIST, LITERAL):
        rows, value = bred(params, positions=positions)
        assert (value == first_number(rows)).all()


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"parents": "all"}, "parents must be bests or positions, got 'all'"),
        ({"survival": "no"}, "survival must be better or always, got 'no'"),
        ({"p_crossover": -0.1}, "p_crossover"),
        ({"p_crossover": math.nan}, "p_crossover"),
        ({"p_mutation": 1.5}, "p_mutation"),
    ],
)
def test_wrong_choices_are_named(changes, told):
    with pytest.raises(ValueError, match=told):
        BreedingParams(**changes)
