"""What each command does, prints and ends with."""

import json
import shutil

import pytest

from clearway.formats.plan_file import read_plan
from clearway.formats.ready_made import scenario_folder
from clearway.validate import validate_plan

RUN_FILES = {"plan.json", "metrics.json", "report.html", "plan.png", "scenario.toml"}
ROW_KEYS = {
    "instance",
    "robots",
    "status",
    "clean",
    "cpu_s",
    "wall_s",
    "sum_of_costs",
    "makespan",
    "expansions",
    "lower_bound",
    "seed",
}


def test_solve_writes_a_run_folder(clearway, hall, tmp_path):
    """Plan, figures, report, picture and a copy of the scenario; the report is named last."""
    told = clearway("solve", hall, "--out", "runs/first")
    assert (told.code, told.err) == (0, "")
    out = tmp_path / "runs" / "first"
    assert {path.name for path in out.iterdir()} == RUN_FILES
    assert (out / "scenario.toml").read_bytes() == hall.read_bytes()
    assert told.out.splitlines()[-1] == "runs/first/report.html"
    record = read_plan(out / "plan.json")
    assert record.status == "solved"
    assert validate_plan(record) == []


def test_what_solve_says_is_what_the_files_say(clearway, hall, tmp_path):
    """One JSON object: the figures of metrics.json, the violations, the files written."""
    told = clearway("solve", hall, "--out", "run", "--json")
    metrics = json.loads((tmp_path / "run" / "metrics.json").read_text())
    assert (told.code, told.err) == (0, "")
    assert told.json["violations"] == []
    assert metrics.pop("violations") == 0
    assert {key: told.json[key] for key in metrics} == metrics
    assert {tmp_path / name for name in told.json["files"]} == {
        tmp_path / "run" / name for name in RUN_FILES
    }


def test_quiet_is_quiet(clearway, hall):
    """Only where the result is."""
    assert clearway("solve", hall, "--out", "run", "--quiet").out == "run/report.html\n"


def test_a_run_may_be_solved_in_its_own_folder(clearway, hall, tmp_path):
    """The copy of the scenario is not copied onto itself."""
    clearway("solve", hall, "--out", "run", "--quiet")
    before = (tmp_path / "run" / "scenario.toml").read_bytes()
    assert clearway("solve", "run/scenario.toml", "--out", "run", "--quiet").code == 0
    assert (tmp_path / "run" / "scenario.toml").read_bytes() == before


def test_an_ended_budget_is_no_answer_but_is_written(clearway, hall, tmp_path):
    """Exit code 3; the plan says how it ended and why, and is right as far as it goes."""
    told = clearway("solve", hall, "--out", "run", "--expansions", 0)
    assert told.code == 3
    assert "stopped" in told.out
    plan = json.loads((tmp_path / "run" / "plan.json").read_text())
    assert plan["status"] == "stopped"
    assert plan["reason"]
    assert clearway("validate", "run").code == 0
    told = clearway("solve", hall, "--out", "run", "--expansions", 0, "--json")
    assert told.code == 3
    assert told.json["status"] == "stopped"
    assert told.json["reason"] == plan["reason"]
    assert told.json["expansions"] == 0
    assert told.json["concerned"]


def test_an_unfinished_plan_has_no_gap(clearway, hall):
    """A plan that does less than its bound asks for says nothing about how good it is."""
    told = clearway("solve", hall, "--out", "run", "--expansions", 0, "--json")
    assert told.json["gap"] is None


def test_a_budget_of_seconds_is_taken(clearway, hall):
    """More than enough changes nothing but the stop."""
    assert clearway("solve", hall, "--out", "run", "--budget", 1000, "--quiet").code == 0


def test_demo_prints_its_run_folder_last(clearway, tmp_path):
    """The first thing a newcomer runs, in the folder at hand."""
    told = clearway("demo", "--expansions", 100_000)
    assert (told.code, told.err) == (0, "")
    assert told.out.splitlines()[-1] == "demo-run"
    assert {path.name for path in (tmp_path / "demo-run").iterdir()} == RUN_FILES


def test_check_tells_clearances_and_reach(clearway, hall, tmp_path):
    """1.5 m behind the tail of a; both robots can do both tasks; the site is drawn."""
    told = clearway("check", hall, "--json", "--out", "drawn")
    assert (told.code, told.err) == (0, "")
    assert told.json["legal"]
    assert told.json["findings"] == []
    assert told.json["clearances"]["robots[0].start"] == pytest.approx(1.5)
    assert told.json["reachable"] == {"a": ["t1", "t2"], "b": ["t1", "t2"]}
    assert (tmp_path / "drawn" / "site.png").stat().st_size > 1000


def test_check_draws_what_is_wrong_too(clearway, hall, tmp_path):
    """An illegal scenario ends with 2, each finding on its own line, and is drawn."""
    hall.write_text(hall.read_text().replace("[3.0, 3.0, 0.0]", "[9.0, 6.0, 0.0]"))
    told = clearway("check", hall, "--out", "drawn")
    assert told.code == 2
    assert "1. error: robots[0].start" in told.out
    assert (tmp_path / "drawn" / "site.png").exists()
    told = clearway("check", hall, "--json")
    assert told.code == 2
    assert [finding["kind"] for finding in told.json["findings"]] == ["start_in_obstacle"]


def test_check_tells_what_a_run_through_time_lacks(clearway, tmp_path):
    """A doubt is printed with its arithmetic and fails nothing; orders of files are counted."""
    shutil.copytree(scenario_folder() / "orders", tmp_path, dirs_exist_ok=True)
    path = tmp_path / "warehouse.toml"
    path.write_text(path.read_text().replace("charging = 500.0", "charging = 50000.0"))
    told = clearway("check", path)
    assert (told.code, told.err) == (0, "")
    assert "4 robots, 11 tasks" in told.out
    assert "1. warning: site.zones: 4 robots at most drain 4 x 1/5000 s = 0.08 %/s; " in told.out
    assert "33 chargers give 33 x 1/50000 s = 0.066 %/s; add 7 chargers" in told.out


def test_validate_finds_nothing_wrong_in_a_right_plan(clearway, solved_hall):
    """A run folder or its plan file."""
    for path in (solved_hall, solved_hall / "plan.json"):
        told = clearway("validate", path)
        assert (told.code, told.err) == (0, "")
        assert "nothing wrong" in told.out
    assert clearway("validate", solved_hall, "--json").json["right"] is True


def test_validate_lists_what_is_wrong(clearway, solved_hall, tmp_path):
    """A robot that starts a metre off: exit code 1, kind and robot by name."""
    plan = json.loads((solved_hall / "plan.json").read_text())
    robot = next(robot for robot in plan["robots"] if robot["id"] in plan["trajectories"])
    robot["start"][1] += 1.0
    (tmp_path / "wrong.json").write_text(json.dumps(plan))
    told = clearway("validate", "wrong.json")
    assert told.code == 1
    assert f"start {robot['id']}" in told.out
    told = clearway("validate", "wrong.json", "--json")
    assert told.code == 1
    assert told.json["right"] is False
    (found,) = (v for v in told.json["violations"] if v["kind"] == "start")
    assert found["robots"] == [robot["id"]]
    assert found["time"] == 0.0


def test_schema_is_a_json_schema(clearway):
    """It names the tables of a scenario file."""
    told = clearway("schema")
    assert (told.code, told.err) == (0, "")
    assert {"site", "robots", "robot_types", "tasks"} <= set(told.json["properties"])
    assert clearway("schema", "--json").json == told.json


def test_bench_writes_a_row_for_each_instance(clearway, tmp_path):
    """Rows, a table and a plan per instance, each judged right."""
    told = clearway(
        "bench", "warehouse", "--robots", 2, "--tasks", 4, "--instances", 2, "--out", "bench"
    )
    assert (told.code, told.err) == (0, "")
    out = tmp_path / "bench"
    rows = [json.loads(line) for line in (out / "rows.jsonl").read_text().splitlines()]
    assert len(rows) == 2
    for seed, row in enumerate(rows):
        assert set(row) >= ROW_KEYS
        assert (row["seed"], row["robots"], row["status"], row["clean"]) == (
            seed,
            2,
            "solved",
            True,
        )
        assert row["lower_bound"] <= row["sum_of_costs"]
        assert validate_plan(read_plan(out / "plans" / f"{row['instance']}.json")) == []
    assert (out / "table.md").read_text().startswith("| set |")


def test_bench_ends_with_0_where_rows_are_unsolved(clearway):
    """Its rows tell how each ended."""
    told = clearway(
        *("bench", "warehouse", "--robots", 2, "--tasks", 2, "--instances", 1),
        *("--expansions", 0, "--out", "bench", "--json"),
    )
    assert told.code == 0
    assert (told.json["instances"], told.json["solved"], told.json["clean"]) == (1, 0, 1)


def test_help_lists_commands_and_exit_codes(clearway):
    """And so does each command for itself."""
    told = clearway("--help")
    assert told.code == 0
    unwrapped = " ".join(told.out.split())
    for word in ("solve", "check", "validate", "demo", "bench", "schema", "130 interrupted"):
        assert word in unwrapped
    for command in ("solve", "check", "validate", "demo", "bench", "schema"):
        assert clearway(command, "--help").code == 0


def test_the_version_is_told(clearway):
    """A program and a number."""
    assert clearway("--version").out.split()[0] == "clearway"
