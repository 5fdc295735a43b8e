"""Budgets and their parts."""

import pytest

from clearway.protocols import Budget


def test_a_share_is_that_part_of_all_there_is():
    """Half of 3 s and of 1001 expansions, to the next whole one; half of no limit is none."""
    assert Budget(seconds=3.0, expansions=1001).share(0.5) == Budget(1.5, 500)
    assert Budget().share(0.5) == Budget()
    assert Budget(expansions=10, improve=False).share(0.5) == Budget(expansions=5, improve=False)


def test_expansions_are_known_and_seconds_are_gone():
    """Two eighths of the seconds are spent whatever was expanded; without them 30 of 120 are."""
    assert Budget(seconds=8.0).spent(0.25, 30) == 0.25
    assert Budget(seconds=8.0, expansions=120).spent(0.25, 60) == 0.25
    assert Budget(expansions=120).spent(0.125, 30) == 0.25
    assert Budget(expansions=120).spent(0.125, 500) == 1.0
    assert Budget().spent(0.25, 30) == 0.0


@pytest.mark.parametrize("budget", [Budget(seconds=2.0), Budget(expansions=0), Budget(2.0, 5)])
def test_what_has_a_limit_is_not_unlimited(budget):
    """Also none at all is a limit."""
    assert not budget.is_unlimited
    assert Budget().is_unlimited


def test_a_first_plan_may_take_as_much_effort():
    """But no more is done with what it leaves."""
    assert Budget(2.0, 5).first_plan == Budget(2.0, 5, improve=False)
