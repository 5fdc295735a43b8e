"""The page on adding a planner."""

import pytest
from tests.docs.run_page import DOCS, run_page
from tests.plan.rooms import CART, EAST, judged, room, swapping_corridor, team, to

from clearway.model import Status
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Budget

NAME = "how-to/add-a-planner.md"


@pytest.fixture(scope="module")
def planner():
    """The planner of the page."""
    return run_page(NAME)["OneAtATime"](PrioritisedPlanner())


def test_the_page_runs():
    """Its plan is solved and judged right, and the second robot waits for the first."""
    page = run_page(NAME)
    assert page["run"].plan.status is Status.SOLVED
    assert page["run"].violations == ()


def test_its_planner_moves_one_robot_at_a_time(planner):
    """Three robots in a room: no two of them drive at once, and the judge agrees."""
    problem = team(
        room(12.0, 8.0),
        (CART, (2.0, 2.0, EAST), to(10.0, 2.5, service=1.0)),
        (CART, (2.0, 4.0, EAST)),
        (CART, (2.0, 6.0, EAST), to(10.0, 5.0), to(6.0, 7.0)),
    )
    plan = planner(problem, Budget(expansions=60_000), 0)
    assert plan.status is Status.SOLVED
    assert judged(problem, plan) == []
    first, last = plan.trajectories["a"], plan.trajectories["c"]
    assert last.timing[0][0] >= first.stops[-1].leave


def test_its_planner_says_who_could_not_move(planner):
    """Two robots cannot swap in a lane: the first to go finds no way, and both are named."""
    problem = swapping_corridor()
    plan = planner(problem, Budget(expansions=3_000), 0)
    assert plan.status is Status.STOPPED
    assert plan.concerned == ("a", "b")
    assert "a" in plan.reason
    assert judged(problem, plan) == []


def test_the_page_names_files_that_exist():
    """The list of planners under examination is where the page says."""
    text = (DOCS / NAME).read_text(encoding="utf-8")
    assert "tests/contracts/conftest.py" in text
    assert "PLANNERS" in (DOCS.parent / "tests/contracts/conftest.py").read_text(encoding="utf-8")
