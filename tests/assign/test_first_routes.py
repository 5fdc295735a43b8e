"""Legal routes to begin with."""

from dataclasses import replace

import numpy as np
import pytest

from clearway.assign.first_routes import first_routes
from clearway.protocols import finish_times


@pytest.mark.parametrize("seed", range(10))
def test_nobody_waits_in_vain(make_problem, seed):
    """However many pairs must wait, all tasks get finished."""
    problem = make_problem(seed, m=3, n=9, timed=8)
    assert np.isfinite(finish_times(problem, first_routes(problem, 9))).all()


def test_tasks_are_dealt_out_in_turn(make_problem):
    """Five tasks of two robots, none of which waits: every other one to each."""
    assert first_routes(make_problem(0, m=2, n=5), 3) == ((0, 2, 4), (1, 3))


def test_too_few_seats_are_told(make_problem):
    """Three tasks that only robot 0 may do cannot take its two seats."""
    problem = make_problem(0, m=2, n=3)
    only = replace(problem, allowed=np.array([[True] * 3, [False] * 3]))
    with pytest.raises(ValueError, match=r"at most 2 tasks.*only for r0"):
        first_routes(only, 2)
