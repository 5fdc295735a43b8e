"""The study command: what people and machines are told, and what a stop leaves."""

import json
import os
import resource
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest


def study(*arguments):
    """The command of a study that takes a while: 1160 plans."""
    return [sys.executable, "-m", "clearway", "study", "hierarchical-corridor", *arguments]


def rows_in(folder):
    """Rows that are done."""
    path = folder / "rows.jsonl"
    return path.read_text().splitlines()[1:] if path.exists() else []


def living(group):
    """Processes of a group that still run; those that wait to be reaped do not."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, _, of_group = stat.read_text().rpartition(")")[2].split()[:3]
            if int(of_group) == group and state != "Z":
                found.append(stat.parent.name)
    return found


def test_an_unknown_study_is_named_with_the_closest(clearway, tmp_path):
    """Exit code 2, nothing written."""
    told = clearway("study", "hierachical-table2", "--out", "out", "--json")
    assert told.code == 2
    assert "did you mean hierarchical-table2?" in told.json["error"]["message"]
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--jobs", "0"), "jobs: must be 1 or more"),
        (("--instances", "0"), "instances: must be 1 or more"),
        (("--jobs", "2", "--workers", "tcp://127.0.0.1:1"), "leave --jobs out"),
    ],
)
def test_bad_options_are_named(clearway, options, told):
    """One line with the mend."""
    answer = clearway("study", "hierarchical-fig7", "--out", "out", *options)
    assert answer.code == 2
    assert told in answer.err
    assert len(answer.err.splitlines()) == 1


def test_a_study_is_told_in_words_and_in_json(clearway, tmp_path):
    """The second call finds all rows made and tells the same findings as one object."""
    options = ("hierarchical-corridor", "--quick", "--instances", "1", "--out", "out")
    first = clearway("study", *options, "--expansions", "20000")
    assert first.code == 0, first.err
    assert first.out.splitlines()[-1] == os.path.join("out", "report.html")
    second = clearway("study", *options, "--expansions", "20000", "--json").json
    assert second["study"] == "hierarchical-corridor"
    assert second["rows"] == len(rows_in(tmp_path / "out"))
    assert {os.path.basename(name) for name in second["files"]} >= {"table.csv", "table.md"}
    assert all((tmp_path / name).stat().st_size for name in second["files"])
    assert "--expansions 20000" in (tmp_path / "out" / "report.html").read_text()
    other = clearway("study", *options, "--expansions", "30000")
    assert other.code == 2
    assert "give another --out" in other.err


def test_ctrl_c_keeps_the_rows_and_leaves_soon(tmp_path):
    """Exit code 130 within a second or two; no worker is left; the rows are whole."""
    process = subprocess.Popen(
        study("--out", "out", "--jobs", "2"),
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 60.0
    while len(rows_in(tmp_path / "out")) < 3 and time.monotonic() < deadline:
        time.sleep(0.05)
    begin = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of its processes
    _, err = process.communicate(timeout=30.0)
    assert time.monotonic() - begin < 5.0
    assert process.returncode == 130
    kept = rows_in(tmp_path / "out")
    assert len(kept) >= 3
    assert all("status" in json.loads(line) for line in kept)
    assert f"{len(kept)} of 1160 rows" in err
    assert "Traceback" not in err
    deadline = time.monotonic() + 5.0  # Python's own resource tracker goes a moment later
    while living(process.pid) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not living(process.pid)


def test_a_full_disk_is_named_and_leaves_rows(tmp_path):
    """A limit on file sizes stands for it: exit code 2, the file's name, whole rows."""

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

    done = subprocess.run(
        study("--out", "out", "--jobs", "1", "--json"),
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        preexec_fn=limit,
        check=False,
    )
    assert done.returncode == 2
    told = json.loads(done.stdout)["error"]
    assert told["file"].endswith("rows.jsonl")
    assert "free space" in told["message"]
    assert all("status" in json.loads(line) for line in rows_in(tmp_path / "out"))
