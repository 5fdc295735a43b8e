"""`clearway bench kinodynamic`: rows, table and plans of instances with one goal per robot."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from clearway.cli import main
from clearway.formats.plan_file import read_plan
from clearway.validate import validate_plan

DATA = Path(__file__).parents[3] / "shared" / "data" / "kinodynamic"

CROSSING = """agents:
  - {name: west, start: [5, 15, 0], goal: [25, 15, 0]}
  - {name: south, start: [15, 5, -1.57], goal: [15, 25, -1.57]}
map: {dimensions: [30, 30], obstacles: [[24, 24]]}
"""
INTO_A_DISC = CROSSING.replace("[24, 24]", "[6, 15]")
INTO_EACH_OTHER = CROSSING.replace("[15, 5, -1.57]", "[5.5, 15, 0]")
OVER_THE_BORDER = CROSSING.replace("[5, 15, 0]", "[0.9, 15, 0]")
WALL = ", ".join(f"[{10 + 0.2 * k:.1f}, {20 + 0.1 * j:.1f}]" for k in range(51) for j in (0, 100))
SIDES = ", ".join(f"[{x}, {20 + 0.2 * k:.1f}]" for x in (10, 20) for k in range(51))
WALLED_IN = f"""agents:
  - {{name: west, start: [5, 15, 0], goal: [15, 25, 0]}}
map: {{dimensions: [40, 40], obstacles: [{WALL}, {SIDES}]}}
"""


@pytest.fixture
def bench(tmp_path, capsys):
    """Write instances by name, run the bench over them, return exit code, rows and stdout."""

    def run(*options, **texts):
        files = []
        for name, text in texts.items():
            files.append(tmp_path / f"{name}.yaml")
            files[-1].write_text(text)
        out = tmp_path / "out"
        code = main(["bench", "kinodynamic", *map(str, files), "--out", str(out), *options])
        rows = out / "rows.jsonl"
        lines = rows.read_text().splitlines() if rows.exists() else []
        return code, [json.loads(line) for line in lines], capsys.readouterr().out

    return run


def test_a_row_tells_what_a_plan_is_worth(bench, tmp_path):
    """Two cars cross: both arrive, the judge finds nothing, the bound holds."""
    code, rows, told = bench(crossing=CROSSING)
    assert code == 0
    (row,) = rows
    keys = "instance robots status clean cpu_s wall_s sum_of_costs makespan expansions lower_bound"
    assert not [key for key in (*keys.split(), "seed") if key not in row]
    assert (row["instance"], row["status"], row["clean"]) == ("crossing", "solved", True)
    # 20 m each at 1 m/s at least.
    assert 39.9 < row["lower_bound"] <= row["sum_of_costs"] < 60.0
    assert "CL-CBS 30x30, 2" in told
    record = read_plan(tmp_path / "out" / "plans" / "crossing.json")
    assert validate_plan(record) == []
    assert record.sum_of_costs == row["sum_of_costs"]


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (INTO_A_DISC, "agent"),
        (INTO_EACH_OTHER, "west and south overlap"),
        (OVER_THE_BORDER, "outside the bounds"),
    ],
    ids=["disc", "body", "border"],
)
def test_illegal_instances_are_named_and_counted_apart(bench, tmp_path, text, named):
    """They have a reason and no plan; the others are planned all the same."""
    code, rows, told = bench(bad=text, good=CROSSING)
    assert code == 0
    assert [row["status"] for row in rows] == ["illegal", "solved"]
    assert named in rows[0]["reason"] or "west" in rows[0]["reason"]
    assert "1 of 2" in told
    assert not (tmp_path / "out" / "plans" / "bad.json").exists()


def test_an_open_border_lets_bodies_out(bench):
    """10 cm over the border is legal there."""
    _, rows, _ = bench("--border", "open", bad=OVER_THE_BORDER)
    assert rows[0]["status"] == "solved"
    assert rows[0]["clean"]


def test_two_millimetres_over_the_border_are_legal(bench):
    """A yaw of 1.57 is not a right angle: such bodies reach over the map by 1.6 mm."""
    _, rows, _ = bench(edge=CROSSING.replace("[15, ", "[1, "))
    assert rows[0]["status"] == "solved"
    assert rows[0]["clean"]


def test_a_goal_that_is_walled_in_is_infeasible_by_proof(bench):
    """The row names the robot and the disc that has no way."""
    code, rows, _ = bench(walled=WALLED_IN)
    assert code == 0
    assert rows[0]["status"] == "infeasible"
    assert rows[0]["concerned"] == ["west"]
    assert "a disc of radius" in rows[0]["reason"]


def test_out_of_budget_the_row_says_who_is_missing(bench):
    """One expansion is not enough for two cars; what there is, is right."""
    code, rows, _ = bench("--expansions", "1", crossing=CROSSING)
    assert code == 0
    assert rows[0]["status"] == "stopped"
    assert rows[0]["clean"]
    assert rows[0]["concerned"]


def test_a_budget_makes_plans_better_and_repeats_on_any_number_of_processes(tmp_path):
    """Same seed, same expansions: the same bytes in plans, and in rows but for seconds."""
    files = []
    for k in range(3):
        files.append(str(tmp_path / f"crossing{k}.yaml"))
        Path(files[-1]).write_text(CROSSING.replace("[25, 15, 0]", f"[{25 - k}, 15, 0]"))

    def run(jobs):
        out = tmp_path / f"out{jobs}"
        options = ["--expansions", "3000", "--jobs", jobs, "--quiet"]
        assert main(["bench", "kinodynamic", *files, "--out", str(out), *options]) == 0
        rows = [json.loads(line) for line in (out / "rows.jsonl").read_text().splitlines()]
        plans = []
        for row in rows:
            plan = json.loads((out / "plans" / f"{row['instance']}.json").read_text())
            plan.pop("timings")
            plans.append(json.dumps(plan))
            for key in [key for key in row if key.endswith(("cpu_s", "wall_s", "memory_mb"))]:
                row.pop(key)
        return rows, plans

    alone, together = run("1"), run("2")
    assert alone == together
    assert all(row["sum_of_costs"] <= row["first_sum_of_costs"] for row in alone[0])


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "no files are named"),
        (["nowhere.yaml"], "nowhere.yaml"),
        (["README.md"], "README.md"),
        (["good.yaml", "bad.yaml"], "bad.yaml"),
        (["good.yaml", "good.yaml"], "stems"),
        (["good.yaml", "--jobs", "0"], "--jobs"),
        (["good.yaml", "--border", "wide"], "border"),
        (["good.yaml", "--budget", "-1"], "budget"),
        (["good.yaml", "--expansions", "many"], "expansions"),
        (["good.toml"], "good.toml"),
    ],
)
def test_bad_input_leaves_with_2_before_anything_is_written(
    tmp_path, monkeypatch, capsys, arguments, told
):
    """The message names the culprit; a bad file among good ones stops all of them."""
    monkeypatch.chdir(tmp_path)
    Path("good.yaml").write_text(CROSSING)
    Path("bad.yaml").write_text(CROSSING[:40])
    Path("README.md").write_text("# hello")
    Path("good.toml").write_text("name = 3")
    try:
        code = main(["bench", "kinodynamic", *arguments, "--out", "out"])
    except SystemExit as stopped:
        code = stopped.code
    assert code == 2
    assert told in capsys.readouterr().err
    assert not Path("out").exists()


def test_the_judge_sees_what_a_bench_plans_on_public_files(tmp_path):
    """The first legal public instance of ten cars is solved and clean."""
    archive = DATA / "clcbs_benchmark.tar.xz"
    if not archive.is_file():
        pytest.skip(f"the public instances are not there: {archive.name}")
    name = "benchmark/map50by50/agents10/obstacle/map_50by50_obst25_agents10_ex1.yaml"
    subprocess.run(["tar", "-xf", archive, "-C", tmp_path, name], check=True)
    out = tmp_path / "out"
    assert main(["bench", "kinodynamic", str(tmp_path / name), "--out", str(out), "--quiet"]) == 0
    row = json.loads((out / "rows.jsonl").read_text())
    assert row["status"] == "solved"
    assert row["clean"]


def test_an_interrupt_keeps_the_rows_there_are(tmp_path):
    """Ctrl-C ends a long bench at once with exit code 130 and whole files."""
    path = tmp_path / "crossing.yaml"
    path.write_text(CROSSING)
    command = [sys.executable, "-m", "clearway", "bench", "kinodynamic", str(path)]
    command += ["--out", str(tmp_path / "out"), "--budget", "60"]
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, env={**os.environ})
    for _ in range(300):
        time.sleep(0.05)
        if (tmp_path / "out" / "plans").exists():
            break
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    assert child.wait(timeout=10) == 130
    assert (tmp_path / "out" / "table.md").exists()
