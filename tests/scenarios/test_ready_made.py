"""The scenarios that come with Clearway are solved, and what files hold is what was planned."""

from pathlib import Path

import pytest

from clearway.formats.plan_file import read_plan, write_plan
from clearway.formats.scenario_file import read_scenario
from clearway.model import Status
from clearway.protocols import Budget
from clearway.systems import solve
from clearway.systems.simulate import simulate
from clearway.validate import validate_plan
from clearway.validate.legality import check_scenario
from clearway.validate.trace_judge import validate_trace

FOLDER = Path(__file__).parents[2] / "scenarios"
# Robots, tasks, and an effort that is a few times what each takes.
READY = {
    "mixed-64": (64, 64, 400_000),
    "port": (3, 6, 400_000),
    "tight-room": (4, 4, 200_000),
    "warehouse-8x24": (8, 24, 100_000),
    "warehouse-16x48": (16, 48, 200_000),
    "yard-30": (30, 30, 200_000),
}
# Scenarios that run through time, and how many orders are done at least.
RUNNING = {
    "bidirectional": 340,
    "warehouse-delays": 40,
    "warehouse-lifelong": 100,
    "warehouse-surprise": 55,
}


@pytest.fixture(scope="module", params=READY)
def solved(request):
    """A scenario's name, the scenario and its run."""
    scenario = read_scenario(FOLDER / f"{request.param}.toml")
    run = solve(scenario, budget=Budget(expansions=READY[request.param][2]))
    return request.param, scenario, run


def test_every_file_in_the_folder_is_examined_here():
    """A scenario that is added is added here too."""
    assert {path.stem for path in FOLDER.glob("*.toml")} == {*READY, *RUNNING}


@pytest.mark.parametrize("name", RUNNING)
def test_it_runs_through_time_and_is_judged_right(name):
    """Orders are done to the end, and the judge finds nothing wrong in the whole trace."""
    scenario = read_scenario(FOLDER / f"{name}.toml")
    assert check_scenario(scenario).findings == ()
    run = simulate(scenario)
    assert run.status == "ended"
    assert run.trace.events[-1]["orders_done"] >= RUNNING[name]
    assert [str(violation) for violation in validate_trace(run.trace)] == []


def test_it_is_legal(solved):
    """All starts and goals can be, and every task can be reached."""
    _, scenario, _ = solved
    assert check_scenario(scenario).findings == ()


def test_it_is_as_large_as_its_name_says(solved):
    """So many robots, so many tasks."""
    name, scenario, _ = solved
    assert (len(scenario.robots), len(scenario.orders)) == READY[name][:2]


def test_it_is_solved_and_judged_right(solved):
    """Every task is done, and the judge finds nothing wrong."""
    _, scenario, run = solved
    assert run.plan.status is Status.SOLVED, run.plan.reason
    assert [str(violation) for violation in run.violations] == []
    done = sorted(task for tasks in run.record.assignment.values() for task in tasks)
    assert done == sorted(order.task.id for order in scenario.orders)


def test_its_bounds_hold(solved):
    """No plan is below them."""
    record = solved[2].record
    assert 0.0 < record.lower_bound <= record.sum_of_costs + 1e-6
    assert 0.0 < record.cost_lower_bound <= record.cost + 1e-6
    assert record.makespan <= record.sum_of_costs


def test_its_plan_file_holds_the_plan(solved, tmp_path):
    """Read back it is equal in every part, is judged the same, and gives the same bytes again."""
    record = solved[2].record
    write_plan(record, tmp_path / "plan.json")
    read = read_plan(tmp_path / "plan.json")
    assert read.tracks == record.tracks
    assert read.paths == record.paths
    assert read.tours == record.tours
    assert read.site == record.site
    assert dict(read.robot_types) == dict(record.robot_types)
    assert read.robots == record.robots
    assert read.sum_of_costs == record.sum_of_costs
    assert read.status is record.status
    assert validate_plan(read) == []
    write_plan(read, tmp_path / "again.json")
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "plan.json").read_bytes()


@pytest.mark.parametrize("expansions", [50, 2000])
def test_cut_short_it_is_right_as_far_as_it_goes(expansions):
    """A part of the fleet is planned; the rest stands where it started, out of the way."""
    scenario = read_scenario(FOLDER / "warehouse-16x48.toml")
    run = solve(scenario, budget=Budget(expansions=expansions))
    assert run.plan.status is Status.STOPPED
    assert run.violations == ()
    assert set(run.plan.concerned) <= {robot.id for robot in scenario.robots}
