"""``clearway explain`` for people and for machines."""

import pytest
from tests.plot.made_run import made_run

from clearway.formats.trace_file import dump_trace


@pytest.fixture
def run(tmp_path):
    """The folder of a run of 3 robots for 200 s."""
    folder = tmp_path / "run"
    folder.mkdir()
    (folder / "trace.jsonl").write_text(dump_trace(made_run(robots=3, seconds=200.0)))
    return folder


def test_the_chain_is_printed(clearway, run):
    """Of the folder and of its trace file alike: the robot, what it does, its trip and way."""
    told = clearway("explain", run, "--robot", "agv-1", "--at", 100)
    assert told.code == 0
    assert told.out.startswith("agv-1 at 100.0 s: ")
    assert " order o" in told.out and "Its way as planned" in told.out
    assert clearway("explain", run / "trace.jsonl", "--robot", "agv-1", "--at", 100) == told


def test_the_chain_is_one_object(clearway, run):
    """With --json: each link has its state, its sentences and the decisions behind its trip."""
    told = clearway("explain", run, "--robot", "agv-2", "--at", 100, "--json").json
    assert (told["robot"], told["at"]) == ("agv-2", 100.0)
    first = told["chain"][0]
    assert first["robot"] == "agv-2" and first["sentences"]
    assert all(each["alternatives"] for each in first["decisions"])


def test_a_trace_that_was_cut_short_is_said_to_be(clearway, run):
    """Motions are written once they are over, so why a robot stands at its end may be missing."""
    assert "cut short" not in clearway("explain", run, "--robot", "agv-1", "--at", 100).out
    trace = run / "trace.jsonl"
    lines = trace.read_text().splitlines(keepends=True)
    trace.write_text("".join(lines[:-1]))
    question = ("explain", run, "--robot", "agv-1", "--at", 100)
    assert "The trace is cut short at " in clearway(*question).out.splitlines()[-1]
    assert clearway(*question, "--json").json["whole"] is False


@pytest.mark.parametrize(
    ("robot", "at", "mend"),
    [("agv-11", 100, "did you mean agv-1?"), ("agv-1", 9000, "give a time from 0 to")],
)
def test_bad_questions_name_the_mend(clearway, run, robot, at, mend):
    """An unknown robot and a time outside the run leave by exit code 2."""
    told = clearway("explain", run, "--robot", robot, "--at", at)
    assert (told.code, told.out) == (2, "")
    assert mend in told.err and "trace.jsonl" in told.err
    told = clearway("explain", run, "--robot", robot, "--at", at, "--json")
    assert mend in told.json["error"]["message"]


def test_a_folder_without_a_trace_says_so(clearway, tmp_path):
    """A plan's folder has no trace, and a folder that is not there cannot be read."""
    told = clearway("explain", tmp_path, "--robot", "r", "--at", 1)
    assert told.code == 2 and "trace.jsonl" in told.err and "clearway simulate" in told.err
    told = clearway("explain", tmp_path / "nowhere", "--robot", "r", "--at", 1)
    assert told.code == 2 and "nowhere" in told.err


def test_the_time_must_be_a_number(clearway, run):
    """Not a number, and infinity, are errors of usage."""
    for text in ("noon", "inf"):
        assert clearway("explain", run, "--robot", "agv-1", "--at", text).code == 2
