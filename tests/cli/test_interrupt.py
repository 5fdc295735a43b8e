"""Ctrl-C ends a command soon, with what there is."""

import json
import os
import pty
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from tests.cli.sites import HALL, endless_corridor

from clearway.cli import main

SOON = 30.0


def interrupted_while_planning(folder, *options):
    """Start a search without an end, wait until it tells that it plans, and interrupt it."""
    (folder / "corridor.toml").write_text(endless_corridor())
    reader, writer = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "clearway", "solve", "corridor.toml", "--out", "run", *options],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=writer,
        text=True,
    )
    os.close(writer)
    shown = b""
    while b"planning" not in shown:
        shown += os.read(reader, 4096)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=SOON)
    os.close(reader)
    return process.returncode, out


def test_an_interrupted_solve_writes_its_plan(tmp_path, clearway):
    """Exit code 130, a plan that says that it was stopped by hand and is right so far."""
    code, _ = interrupted_while_planning(tmp_path)
    assert code == 130
    plan = json.loads((tmp_path / "run" / "plan.json").read_text())
    assert plan["status"] == "stopped"
    assert "interrupted" in plan["reason"]
    assert clearway("validate", "run").code == 0


def test_with_json_an_interrupted_solve_tells_one_object(tmp_path):
    """What there is, and where it was written."""
    code, out = interrupted_while_planning(tmp_path, "--json")
    told = json.loads(out)
    assert code == 130
    assert told["status"] == "stopped"
    assert any(Path(name).name == "plan.json" for name in told["files"])


def interrupt(*_):
    """Ctrl-C at the moment of a call."""
    raise KeyboardInterrupt


def test_an_interrupt_before_there_is_a_plan_leaves_nothing(tmp_path, monkeypatch, capsys):
    """While work is shared out there is nothing to write yet."""
    (tmp_path / "hall.toml").write_text(HALL)
    monkeypatch.setattr("clearway.coordinate.once.build", interrupt)
    code = main(["solve", str(tmp_path / "hall.toml"), "--out", str(tmp_path / "run"), "--json"])
    assert code == 130
    assert json.loads(capsys.readouterr().out)["error"]["kind"] == "interrupted"
    assert not list(tmp_path.glob("run/*"))


@pytest.mark.parametrize(
    ("module", "name"),
    [("clearway.systems.solve", "validate_plan"), ("clearway.plot.report", "write_report")],
)
def test_an_interrupt_after_planning_keeps_the_plan(tmp_path, monkeypatch, module, name):
    """While it is judged or drawn, the plan is there already, and so it is written."""
    (tmp_path / "hall.toml").write_text(HALL)
    monkeypatch.setattr(import_module(module), name, interrupt)
    code = main(["solve", str(tmp_path / "hall.toml"), "--out", str(tmp_path / "run"), "--quiet"])
    assert code == 130
    assert json.loads((tmp_path / "run" / "plan.json").read_text())["status"] == "solved"
