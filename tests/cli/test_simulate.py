"""``clearway simulate``: its files, what it tells, exit codes, and Ctrl-C."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tests.cli.sites import HALL, altered

from clearway.cli import main
from clearway.formats.trace_file import without_timings
from clearway.simulation import events

FILES = {"metrics.json", "plan.json", "plan.png", "report.html", "scenario.toml", "trace.jsonl"}
SOON = 30.0
STREAMED = """\

[simulation]
until = {until}
streams = [{{name = "day", open = 3, visits = [{{kind = "station", service = 1.0}}]}}]
"""
ZONES = """\
zones = [
  {name = "p1", kind = "parking", pose = [3, 3, 0], polygon = [[1, 1], [5, 1], [5, 5], [1, 5]]},
  {name = "p2", kind = "parking", pose = [3, 9, 0], polygon = [[1, 7], [5, 7], [5, 11], [1, 11]]},
  {name = "s1", kind = "station", pose = [16, 3, 0], polygon = [[14, 1], [18, 1], [16, 5]]},
  {name = "s2", kind = "station", pose = [16, 9, 0], polygon = [[14, 7], [18, 7], [16, 11]]},
]
"""


def endless(until: float = 1e6) -> str:
    """The hall with bays, stations, and three orders more that are open at all times."""
    return altered("obstacles =", f"{ZONES}obstacles =") + STREAMED.format(until=until)


def run_here(folder: Path, text: str, *options: str) -> int:
    (folder / "hall.toml").write_text(text)
    return main(["simulate", str(folder / "hall.toml"), "--out", str(folder / "run"), *options])


def trace_of(folder: Path) -> list[dict[str, object]]:
    return [json.loads(line) for line in (folder / "run" / "trace.jsonl").read_text().splitlines()]


def test_a_run_folder_holds_what_was_promised(clearway, hall, tmp_path) -> None:
    """All of the files that CONTRACT names; both that a judge can read are right."""
    told = clearway("simulate", hall, "--out", "run")
    assert told.code == 0
    assert {path.name for path in (tmp_path / "run").iterdir()} == FILES
    assert "2 of 2 done" in told.out
    assert told.out.splitlines()[-1] == "run/report.html"
    assert (tmp_path / "run" / "scenario.toml").read_text() == HALL
    assert json.loads((tmp_path / "run" / "plan.json").read_text())["status"] == "solved"
    assert clearway("validate", "run").code == 0


def test_with_json_it_tells_one_object(clearway, hall) -> None:
    told = clearway("simulate", hall, "--out", "run", "--json")
    assert (told.code, told.err) == (0, "")
    summary = told.json
    assert (summary["status"], summary["orders_done"], summary["violations"]) == ("done", 2, [])
    assert {Path(name).name for name in summary["files"]} == FILES


def test_all_but_timings_is_the_same_byte_for_byte(tmp_path) -> None:
    """CPU times differ from run to run, and so must be nowhere else."""
    found = []
    for name in ("one", "other"):
        folder = tmp_path / name
        folder.mkdir()
        assert run_here(folder, endless(60.0), "--quiet") == 0
        run = folder / "run"
        metrics = json.loads((run / "metrics.json").read_text())
        assert set(metrics.pop("timings")) == {"cpu_total", "cpu_median", "cpu_p99"}
        trace = without_timings((run / "trace.jsonl").read_text().splitlines())
        files = [(run / file).read_bytes() for file in ("plan.json", "plan.png", "report.html")]
        found.append((metrics, trace, files))
    assert found[0] == found[1]


def test_a_run_whose_time_is_up_is_done(tmp_path) -> None:
    assert run_here(tmp_path, endless(40.0), "--quiet") == 0
    assert trace_of(tmp_path)[-1]["status"] == "ended"
    plan = json.loads((tmp_path / "run" / "plan.json").read_text())
    assert (plan["status"], "over" in plan["reason"]) == ("stopped", True)


def test_what_the_judge_finds_wrong_leaves_by_code_1(tmp_path, monkeypatch, capsys) -> None:
    """A judge who lets nobody move faster than half of what the robots are allowed to."""
    from clearway.formats import trace_parse

    read = trace_parse.read_trace

    def slower(path):
        from dataclasses import replace

        trace = read(path)
        types = {
            name: replace(kind, limits=replace(kind.limits, speed=1.0))
            for name, kind in trace.robot_types.items()
        }
        return replace(trace, robot_types=types)

    monkeypatch.setattr("clearway.cli.simulate_command.read_trace", slower)
    assert run_here(tmp_path, HALL, "--json") == 1
    assert json.loads(capsys.readouterr().out)["violations"]


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ('format = "clearway.scenario/1"\nnonsense = 3\n', "nonsense"),
        (altered('name = "hierarchical"', 'name = "heirarchical"'), "heirarchical"),
        (HALL + '[[simulation.streams]]\nname = "s"\nopen = 2\nfetch = true\n', "until"),
        (
            altered('id = "t1", pose = [16.0, 3.0, 0.0], service = 1.0', 'id="t1", fetches="g1"'),
            "g1",
        ),
        (altered('name = "hierarchical"', 'name = "bidirectional"'), "layout"),
    ],
)
def test_bad_input_leaves_by_code_2_and_keeps_an_older_run(tmp_path, capsys, text, named) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "trace.jsonl").write_text("an older run")
    assert run_here(tmp_path, text, "--json") == 2
    assert named in capsys.readouterr().out
    assert (tmp_path / "run" / "trace.jsonl").read_text() == "an older run"


@pytest.mark.parametrize("option", [("--expansions", "0"), ("--budget", "1e-9")])
def test_a_spent_budget_leaves_by_code_3_with_what_there_is(tmp_path, option) -> None:
    assert run_here(tmp_path, endless(), "--quiet", *option) == 3
    assert trace_of(tmp_path)[-1]["status"] == "stopped"
    plan = json.loads((tmp_path / "run" / "plan.json").read_text())
    assert (plan["status"], "budget" in plan["reason"]) == ("stopped", True)
    assert {path.name for path in (tmp_path / "run").iterdir()} == FILES
    assert main(["validate", str(tmp_path / "run"), "--quiet"]) == 0


def test_an_interrupt_from_outside_leaves_a_right_trace(tmp_path, clearway) -> None:
    """Code 130; the trace is marked, readable to its end, and right as far as it goes."""
    (tmp_path / "hall.toml").write_text(endless())
    process = subprocess.Popen(
        [sys.executable, "-m", "clearway", "simulate", "hall.toml", "--out", "run", "--json"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    file, patience = tmp_path / "run" / "trace.jsonl", time.monotonic() + SOON
    while not (file.exists() and file.stat().st_size > 100_000):
        assert time.monotonic() < patience
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=SOON)
    assert process.returncode == 130
    error = json.loads(out)["error"]
    assert (error["kind"], "run/trace.jsonl" in error["message"]) == ("interrupted", True)
    assert trace_of(tmp_path)[-1]["status"] == "interrupted"
    assert clearway("validate", "run/trace.jsonl").code == 0


def test_an_interrupt_while_motion_is_written_loses_none_of_it(tmp_path, monkeypatch) -> None:
    """Between taking what was driven and writing it, Ctrl-C has to wait."""
    made, calls = events.motion, []

    def motion(driven, modes):
        calls.extend([driven] * bool(driven.pieces))
        if len(calls) == 20:
            os.kill(os.getpid(), signal.SIGINT)
        return made(driven, modes)

    monkeypatch.setattr(events, "motion", motion)
    assert run_here(tmp_path, endless(), "--quiet") == 130
    assert trace_of(tmp_path)[-1]["status"] == "interrupted"
    assert sum(event["event"] == "motion" for event in trace_of(tmp_path)) == len(calls)
    assert main(["validate", str(tmp_path / "run" / "trace.jsonl"), "--quiet"]) == 0


def interrupt(*_):
    """Ctrl-C at the moment of a call."""
    raise KeyboardInterrupt


def test_an_interrupt_while_it_is_judged_tells_where_the_trace_is(
    tmp_path, monkeypatch, capsys
) -> None:
    monkeypatch.setattr("clearway.cli.simulate_command.validate_trace", interrupt)
    assert run_here(tmp_path, HALL, "--json") == 130
    assert "trace.jsonl" in json.loads(capsys.readouterr().out)["error"]["message"]
    assert trace_of(tmp_path)[-1]["status"] == "done"


def test_an_interrupt_before_anything_happens_writes_nothing(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setattr("clearway.plan.TailTrips._park", interrupt)
    assert run_here(tmp_path, HALL, "--json") == 130
    assert "nothing is written" in json.loads(capsys.readouterr().out)["error"]["message"]
    assert not list((tmp_path / "run").iterdir())


def test_afterwards_ctrl_c_is_what_it_was(tmp_path) -> None:
    before = signal.getsignal(signal.SIGINT)
    run_here(tmp_path, HALL, "--quiet")
    assert signal.getsignal(signal.SIGINT) is before
