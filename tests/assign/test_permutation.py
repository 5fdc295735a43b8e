"""Permutations that encode even splits: decoded, rounded, mended and bred."""

import json
from collections import Counter

import numpy as np
import pytest
from tests.assign.conftest import ORACLES

from clearway.assign.permutation import (
    crossover,
    decode,
    exchange,
    fragments,
    mutate,
    random_population,
    repair,
    round_randomly,
)

MICRO = json.loads(ORACLES.read_text())["micro"]
DRAWS = 4000


def rows(array):
    return [tuple(int(number) for number in row) for row in array]


def are_permutations(population):
    return (np.sort(population, axis=1) == np.arange(population.shape[1])).all()


@pytest.mark.parametrize("case", MICRO["decode"])
def test_a_permutation_is_cut_into_equal_routes(case):
    permutation = np.array(case["permutation"])
    routes = decode(permutation, case["robots"], len(permutation))
    assert [list(route) for route in routes] == case["routes"]


def test_padding_is_done_by_nobody():
    """Seven tasks of three robots: numbers 7 and 8 make up the nine seats."""
    permutation = np.array([7, 0, 1, 2, 8, 3, 4, 5, 6])
    assert decode(permutation, 3, 7) == ((0, 1), (2, 3), (4, 5, 6))


def test_every_permutation_is_drawn_alike():
    """Each of six orders comes near a sixth of all draws, within five standard deviations."""
    drawn = Counter(rows(random_population(np.random.default_rng(1), DRAWS, 3)))
    assert len(drawn) == 6
    assert all(abs(count - DRAWS / 6) < 5 * (DRAWS * 5 / 36) ** 0.5 for count in drawn.values())


@pytest.mark.parametrize("case", MICRO["rounding"])
def test_fractions_are_rounded_up_as_often_as_they_say(case):
    """Whole numbers stay; the others go up in the share of draws that is their fraction."""
    x = case["x"]
    rounded = round_randomly(np.random.default_rng(2), np.full((DRAWS, 1), x))
    assert set(np.unique(rounded)) <= {np.floor(x), np.ceil(x)}
    if case["p_up"] > 0.0:
        assert np.mean(rounded > x) == pytest.approx(case["p_up"], abs=0.04)
    else:
        assert (rounded == x).all()


def test_fragments_change_sides():
    """The published pair and fragments give the published children, two numbers held twice."""
    case = MICRO["crossover"]
    mask = np.zeros(6, dtype=bool)
    for first, last in case["fragments"]:
        mask[first : last + 1] = True
    first, second = exchange(np.array(case["parent_a"]), np.array(case["parent_b"]), mask)
    assert first.tolist() == case["raw_child_a"]
    assert second.tolist() == case["raw_child_b"]


@pytest.mark.parametrize(
    ("raw", "mended"),
    [
        ("raw_child_a", {(0, 4, 2, 3, 1, 5), (5, 4, 2, 3, 1, 0)}),
        ("raw_child_b", {(5, 1, 3, 2, 4, 0), (0, 1, 3, 2, 4, 5)}),
    ],
)
def test_either_holder_of_a_number_may_keep_it(raw, mended):
    """Both ways to mend a child come up, and about as often."""
    values = np.tile(MICRO["crossover"][raw], (DRAWS, 1))
    drawn = Counter(rows(repair(np.random.default_rng(3), values)))
    assert set(drawn) == mended
    assert min(drawn.values()) > 0.46 * DRAWS


def test_missing_numbers_come_in_any_order():
    """Three holders of 1: each keeps it in a third of cases, 0 and 2 take both orders."""
    drawn = Counter(rows(repair(np.random.default_rng(4), np.ones((DRAWS, 3), dtype=np.int64))))
    assert set(drawn) == {(1, 0, 2), (1, 2, 0), (0, 1, 2), (2, 1, 0), (0, 2, 1), (2, 0, 1)}
    assert all(abs(count - DRAWS / 6) < 5 * (DRAWS * 5 / 36) ** 0.5 for count in drawn.values())


def test_a_permutation_needs_no_repair():
    rng = np.random.default_rng(5)
    population = random_population(rng, 50, 9)
    assert (repair(rng, population) == population).all()


def test_repair_changes_no_more_than_it_must():
    """As many coordinates change as numbers are missing, and what was held once stays."""
    rng = np.random.default_rng(6)
    values = rng.integers(12, size=(200, 12))
    mended = repair(rng, values)
    assert are_permutations(mended)
    changed = (mended != values).sum(axis=1)
    assert (changed == [12 - len(set(row)) for row in values.tolist()]).all()


def test_what_two_ranges_both_cover_is_back_where_it_was():
    """Three positions have six ranges: three of one position, which sorted ends hit with 1/9 each,
    three of several with 2/9 each. Both ranges are the same, and nothing is exchanged, with
    3 (1/9)^2 + 3 (2/9)^2 = 15/81; [0, 1] and [1, 2] exchange the outer two.
    """
    drawn = Counter(rows(fragments(np.random.default_rng(7), DRAWS, 3)))
    assert drawn[0, 0, 0] / DRAWS == pytest.approx(15 / 81, abs=0.03)
    # [0, 1] with [1, 2], [0, 0] with [2, 2], [0, 2] with [1, 1], each in two orders.
    assert drawn[1, 0, 1] / DRAWS == pytest.approx(2 * (4 + 1 + 2) / 81, abs=0.03)


def test_children_mix_both_parents():
    """Parents that agree nowhere: a child holds numbers of each where its parent had them."""
    parents = np.array([[0, 1, 2, 3, 4, 5], [5, 4, 3, 2, 1, 0]])
    rng = np.random.default_rng(8)
    children = np.concatenate([crossover(rng, parents, 1.0) for _ in range(200)])
    assert are_permutations(children)
    assert (children[::2] == parents[1]).mean() > 0.2
    assert (children[::2] == parents[0]).mean() > 0.2


def test_crossover_leaves_some_pairs_alone():
    """Nobody is crossed at probability 0; at a half about half as many as at 1."""
    rng = np.random.default_rng(9)
    parents = random_population(rng, 1000, 8)
    crossed = [(crossover(rng, parents, p) != parents).any(axis=1).mean() for p in (0, 0.5, 1)]
    assert crossed[0] == 0.0
    assert crossed[1] == pytest.approx(crossed[2] / 2.0, abs=0.08)
    assert crossed[2] > 0.8


def test_one_of_an_odd_number_is_left_over():
    """Of three parents at most two change; a parent alone never does."""
    rng = np.random.default_rng(10)
    parents = random_population(rng, 3, 8)
    changed = [(crossover(rng, parents, 1.0) != parents).any(axis=1).sum() for _ in range(50)]
    assert max(changed) == 2
    assert (crossover(rng, parents[:1], 1.0) == parents[:1]).all()


def test_mutation_swaps_two_tasks():
    """Every mutant differs in exactly two places, and all pairs of places come up."""
    population = np.tile(np.arange(4), (DRAWS, 1))
    mutants = mutate(np.random.default_rng(11), population, 1.0)
    assert are_permutations(mutants)
    drawn = Counter(rows(mutants != population))
    assert len(drawn) == 6
    assert all(sum(places) == 2 for places in drawn)


def test_mutation_comes_as_often_as_it_should():
    population = np.tile(np.arange(6), (DRAWS, 1))
    mutants = mutate(np.random.default_rng(12), population, 0.1)
    assert (mutants != population).any(axis=1).mean() == pytest.approx(0.1, abs=0.025)


@pytest.mark.parametrize("length", [0, 1])
def test_nothing_to_breed_is_left_as_it_is(length):
    """With no task or one there is one permutation."""
    rng = np.random.default_rng(13)
    population = random_population(rng, 4, length)
    for change in (lambda p: crossover(rng, p, 1.0), lambda p: mutate(rng, p, 1.0)):
        assert (change(population) == population).all()
    assert (repair(rng, population) == population).all()
