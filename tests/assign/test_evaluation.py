"""Worth of populations in one call."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.assign.conftest import random_problem

from clearway.assign import build
from clearway.assign.evaluation import Evaluation
from clearway.assign.permutation import decode, random_population
from clearway.protocols import AssignmentProblem, objective
from clearway.world.warehouse import random_warehouse


def population_for(problem, count=20, seed=0):
    m, n = len(problem.robots), len(problem.tasks)
    return random_population(np.random.default_rng(seed), count, -(-n // m) * m)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), m=st.integers(1, 5), n=st.integers(0, 12))
def test_all_terms_are_those_of_the_objective(seed, m, n):
    """Unlike robots, inner ways, any weights, padding wherever it falls: the same worth."""
    problem = random_problem(seed, m, n)
    evaluation = Evaluation(problem)
    population = population_for(problem, 7, seed)
    worths = evaluation(population)
    assert evaluation.count == 7
    for row, permutation in enumerate(population):
        worth = objective(problem, decode(permutation, m, n))
        for term in ("value", "max_distance", "total_distance", "turning"):
            found = getattr(worths, term)[row]
            assert found == pytest.approx(getattr(worth, term), rel=1e-12, abs=1e-12)


def test_padding_costs_nothing_wherever_it_stands():
    """West does task 0 alone, 3 m away, whether the empty seat is before or after it."""
    problem = AssignmentProblem(
        ("west", "east"), ("a", "b", "c"), [[3.0, 9.0, 9.0], [9.0, 1.0, 9.0]], 4.0, 0.5, 0.25
    )
    worths = Evaluation(problem)(np.array([[3, 0, 1, 2], [0, 3, 1, 2]]))
    assert worths.max_distance.tolist() == [5.0, 5.0]
    assert worths.total_distance.tolist() == [8.0, 8.0]
    assert worths.turning.tolist() == [1.25, 1.25]
    assert worths.value.tolist() == [14.25, 14.25]


def test_proven_optima_are_worth_what_they_are(proven):
    """The published even routes, laid end to end, have the published value."""
    problem, split, answer = proven
    if split == "even":
        permutation = np.concatenate(answer["routes"])[None]
        worth = Evaluation(problem)(permutation).value[0]
        assert worth == pytest.approx(answer["F"], abs=1e-5)


def test_turning_everybody_changes_nothing():
    """All headings 0.7 rad further: every difference of headings is what it was."""
    site = random_warehouse(4, 12, 0)

    def turned(pose):
        return pose._replace(theta=pose.theta + 0.7)

    orders = tuple(
        replace(
            order,
            task=replace(
                order.task,
                visits=tuple(replace(v, pose=turned(v.pose)) for v in order.task.visits),
            ),
        )
        for order in site.orders
    )
    robots = tuple(replace(robot, start=turned(robot.start)) for robot in site.robots)
    problem = build(site)
    other = build(replace(site, robots=robots, orders=orders))
    population = population_for(problem)
    assert Evaluation(other)(population).value == pytest.approx(
        Evaluation(problem)(population).value, rel=1e-12
    )
