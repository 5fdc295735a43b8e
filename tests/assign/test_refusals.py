"""What some assigners cannot take, and whom they name instead."""

from dataclasses import replace

import numpy as np
import pytest
from tests.assign.conftest import random_problem

from clearway.assign import InsertionLocalSearch, InsertionParams, RandomAssigner
from clearway.assign.refusals import choosy, timed

TIMELESS = {
    "random, even": RandomAssigner(),
    "random, free": RandomAssigner(even=False),
    "insertion, even": InsertionLocalSearch(InsertionParams(even=True)),
    "insertion, free": InsertionLocalSearch(),
}


@pytest.mark.parametrize("name", TIMELESS)
@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"due": np.array([np.inf, 3.0, 4.0])}, "^task t1 has a due time, but .* RuinRecreate$"),
        ({"before": ((2, 0),)}, "^task t0 waits for task t2, but .* RuinRecreate$"),
    ],
)
def test_who_knows_no_time_says_so(name, changes, told):
    """Neither chance nor insertion heeds due times or precedence, so both refuse them."""
    problem = replace(random_problem(0, m=2, n=3), **changes)
    with pytest.raises(ValueError, match=told):
        TIMELESS[name](problem, 0)


def test_service_alone_is_no_matter_of_time():
    """Tasks that take long, with no due time and in any order, change no route's worth."""
    problem = replace(random_problem(0, m=2, n=3), service=np.full(3, 60.0), speed=2.0)
    assert timed(problem) == ()
    for assign in TIMELESS.values():
        assert assign.unsupported(problem) == ()


def test_robots_that_do_anything_in_any_order_are_not_choosy():
    assert choosy(random_problem(0, m=2, n=3)) == ()
