"""Judging traces from the command line, alone and beside a plan."""

import json

import pytest
from tests.data.bad_traces.make import dump_trace, errand


@pytest.fixture
def run(tmp_path, solved_hall):
    """A run folder with a right trace and a right plan."""
    folder = tmp_path / "run"
    folder.mkdir()
    (folder / "trace.jsonl").write_text(dump_trace(errand()))
    (folder / "plan.json").write_bytes((solved_hall / "plan.json").read_bytes())
    return folder


def test_a_run_folder_has_its_trace_and_its_plan_judged(clearway, run):
    """Each file has a line of its own; either alone will do."""
    told = clearway("validate", run)
    assert (told.code, told.err) == (0, "")
    trace, plan = told.out.splitlines()
    assert trace.endswith("trace.jsonl: nothing wrong")
    assert plan.endswith("plan.json: nothing wrong")
    (run / "plan.json").unlink()
    told = clearway("validate", run, "--json")
    assert told.code == 0
    assert told.json["files"] == [str(run / "trace.jsonl")]
    assert told.json["right"] is told.json["whole"] is True


@pytest.mark.parametrize("name", ["trace.jsonl", "kept.json"])
def test_what_is_wrong_in_a_trace_is_listed(clearway, tmp_path, name):
    """A trace that states other figures than its own: exit code 1, whatever it is called."""
    (tmp_path / name).write_text(dump_trace(errand(distance=9.0)))
    told = clearway("validate", name)
    assert told.code == 1
    assert "end at 2.000 s" in told.out
    assert f"{name}: 1 wrong" in told.out
    (found,) = clearway("validate", name, "--json").json["violations"]
    assert (found["kind"], found["file"]) == ("end", name)


def test_a_wrong_plan_beside_a_right_trace_is_wrong(clearway, run):
    """Exit code 1 as soon as one of the two is."""
    plan = json.loads((run / "plan.json").read_text())
    (run / "plan.json").write_text(json.dumps({**plan, "makespan": 1.0}))
    told = clearway("validate", run)
    assert told.code == 1
    assert "trace.jsonl: nothing wrong" in told.out
    assert "plan.json: 1 wrong" in told.out


def test_a_trace_that_was_cut_short_is_judged_as_far_as_it_goes(clearway, run):
    """A right but unfinished trace is right, and said to be unfinished."""
    text = dump_trace(errand())
    (run / "trace.jsonl").write_text(text[:-20])
    told = clearway("validate", run)
    assert told.code == 0
    assert "trace.jsonl: nothing wrong, up to where it was cut short" in told.out
    assert clearway("validate", run, "--json").json["whole"] is False


def test_a_line_broken_in_the_middle_is_bad_input(clearway, run):
    """Exit code 2, with file, line and mend."""
    lines = dump_trace(errand()).splitlines()
    lines[2] = lines[2][:30]
    (run / "trace.jsonl").write_text("\n".join(lines))
    told = clearway("validate", run)
    assert told.code == 2
    assert "trace.jsonl, line 3" in told.err
    assert "restore the file" in told.err
    assert "Traceback" not in told.err
