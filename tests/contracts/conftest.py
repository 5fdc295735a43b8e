"""Planners under examination, and what it takes to pass."""

import pytest
from tests.plan.rooms import judged

from clearway.model import Status
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Budget

PLANNERS = {"prioritised": PrioritisedPlanner}


@pytest.fixture(params=PLANNERS)
def planner(request):
    return PLANNERS[request.param]()


@pytest.fixture
def solve(planner):
    """Plan a problem that has a plan, and return it when the judge finds nothing wrong."""

    def solved(problem, seed=0):
        assert planner.unsupported(problem) == ()
        plan = planner(problem, Budget(expansions=60_000), seed)
        assert plan.status is Status.SOLVED, plan.reason
        assert plan.reason is None
        assert plan.concerned == ()
        assert [str(violation) for violation in judged(problem, plan)] == []
        return plan

    return solved
