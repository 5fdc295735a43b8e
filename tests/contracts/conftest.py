"""Planners under examination, and what it takes to pass."""

import re

import pytest
from tests.plan.rooms import judged

from clearway.model import Status
from clearway.plan import ConflictBasedSearch, ConflictParams, InTurn, PrioritisedPlanner
from clearway.protocols import Budget

PLANNERS = {
    "prioritised": PrioritisedPlanner,
    "conflicts, adaptive": lambda: ConflictBasedSearch(ConflictParams(paper_cost=False)),
    "in turn": lambda: InTurn(
        (ConflictBasedSearch(ConflictParams(paper_cost=False)), PrioritisedPlanner()), 5_000
    ),
    "conflicts, bounded": lambda: ConflictBasedSearch(ConflictParams("bounded", paper_cost=False)),
}


@pytest.fixture(params=PLANNERS)
def planner(request):
    return PLANNERS[request.param]()


@pytest.fixture
def made_anew(request):
    """Another planner just like the one under examination."""
    return PLANNERS[request.node.callspec.params["planner"]]()


def skip_refused(planner, problem):
    """Skip a problem that the planner refuses by name; the prioritised one takes all of them."""
    reasons = planner.unsupported(problem)
    if reasons and isinstance(planner, ConflictBasedSearch):
        with pytest.raises(ValueError, match=re.escape(reasons[0])):
            planner(problem, Budget(expansions=10), 0)
        pytest.skip(f"refused by name: {'; '.join(reasons)}")
    assert reasons == ()


@pytest.fixture
def solve(planner):
    """Plan a problem that has a plan, and return it when the judge finds nothing wrong."""

    def solved(problem, seed=0):
        skip_refused(planner, problem)
        plan = planner(problem, Budget(expansions=60_000), seed)
        assert plan.status is Status.SOLVED, plan.reason
        assert plan.reason is None
        assert plan.concerned == ()
        assert [str(violation) for violation in judged(problem, plan)] == []
        return plan

    return solved
