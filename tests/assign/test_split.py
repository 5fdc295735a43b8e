"""Seats of robots, and who may sit there."""

import numpy as np
import pytest

from clearway.assign.split import even_seats, reseat, unseated


@pytest.fixture
def choosy(make_problem):
    """Four tasks; robot 0 may do all, robot 1 only tasks 0 and 1."""
    problem = make_problem(0, m=2, n=4)
    allowed = np.array([[True] * 4, [True, True, False, False]])
    object.__setattr__(problem, "allowed", allowed)
    return problem


@pytest.mark.parametrize(("m", "n", "seats"), [(4, 12, 3), (4, 13, 4), (5, 3, 1), (2, 0, 0)])
def test_even_seats_round_up(make_problem, m, n, seats):
    """Where tasks do not divide by robots, tasks of no cost make up the number."""
    assert even_seats(make_problem(0, m=m, n=n)) == seats


def test_a_misplaced_task_makes_another_give_way(choosy):
    """Task 2 must go to robot 0, which is full: 0 gives up its place and moves to robot 1."""
    assert reseat(choosy, [(0, 3), (2, 1)], 2) == ((2, 3), (1, 0))


def test_good_routes_stay_as_they_are(choosy):
    """Nothing moves where everybody may do what he has."""
    assert reseat(choosy, [(3, 2), (1, 0)], 2) == ((3, 2), (1, 0))


def test_too_few_seats_are_explained(choosy):
    """Three tasks that only robot 0 may do cannot take two seats."""
    allowed = np.array([[True] * 4, [True, False, False, False]])
    object.__setattr__(choosy, "allowed", allowed)
    assert reseat(choosy, [(0, 1), (2, 3)], 2) is None
    (reason,) = unseated(choosy, 2)
    assert "task t3" in reason
    assert "r0" in reason
    assert unseated(choosy, 3) == ()
