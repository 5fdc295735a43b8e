"""Running through time refuses what cannot be, warns of what is doubtful, and loses nothing."""

import signal

import pytest
from tests.cli.conftest import Told

from clearway.cli import main, simulate_command
from clearway.formats.trace_parse import read_trace

SHOP = """\
format = "clearway.scenario/1"
name = "shop"
seed = 1

[site]
layout = {rule = "bidirectional"}

[robot_types.agv]
kinematics = "differential"
footprint = [[0.35, 0.35], [-0.35, 0.35], [-0.35, -0.35], [0.35, -0.35]]
limits = {speed = 1.0, reverse_speed = 0.0}
battery = {capacity = 5000.0, charging = 500.0}

[[fleets]]
name = "agv"
type = "agv"
count = 4
at = "shelf"
row = 2

[simulation]
until = 60.0

[[simulation.streams]]
name = "order"
rate = 600.0
fetch = true

[system]
name = "bidirectional"
"""

FLOOR = """\
format = "clearway.scenario/1"
name = "floor"
robots = [{id = "a", type = "carrier", start = [3.0, 3.0, 0.0]}]

[site]
bounds = [[0, 0], [20, 0], [20, 12], [0, 12]]

[[site.zones]]
name = "bay"
kind = "parking"
polygon = [[1, 2], [5, 2], [5, 4], [1, 4]]
pose = [3.0, 3.0, 0.0]

[[site.zones]]
name = "dock"
kind = "station"
polygon = [[14, 8], [18, 8], [18, 10], [14, 10]]
pose = [16.0, 9.0, 0.0]

[robot_types.carrier]
kinematics = "four_wheel"
footprint = [[1.5, 1], [-1.5, 1], [-1.5, -1], [1.5, -1]]
clearance = 0.1
limits = {speed = 2.5, yaw_rate = 0.57, turning_radius = 3.0}

[simulation]
until = 60.0
streams = [{name = "s", open = 1, visits = [{kind = "station", service = 5.0}]}]

[system]
name = "hierarchical"
"""

STOPS = "until = 60.0\ndisturbances = {stops_per_hour = 30.0, stop_seconds = [2.0, 9.0]}"
ON_DOCK = "polygon = [[15, 8], [17, 8], [17, 10], [15, 10]]"
ON_START = "polygon = [[2, 2], [4, 2], [4, 4], [2, 4]]"


@pytest.fixture
def clearway(tmp_path, monkeypatch, capsys):
    """Run ``clearway`` in an empty folder, in this process: starting one takes the longest."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        code = main(arguments)
        told = capsys.readouterr()
        return Told(code, told.out, told.err)

    return run


def altered(site: str, *changes: tuple[str, str]) -> str:
    for old, new in changes:
        if old not in site:
            raise ValueError(f"the site has no {old!r}")
        site = site.replace(old, new, 1)
    return site


LIMITS = ("limits = {", "limits = {acceleration = 1.0, ")
DELAY = ("until = 60.0", STOPS)

REFUSED = {
    "acceleration in system B": ((SHOP, LIMITS), "robot type agv", "remove them"),
    "acceleration under delay": ((FLOOR, LIMITS, DELAY), "robot type carrier", "remove them"),
    "no clearance under delay": (
        (FLOOR, ("clearance = 0.1", "clearance = 0.0"), DELAY),
        "robot type carrier",
        "give it 0.02 m",
    ),
    "no layout": (
        (FLOOR, ('name = "hierarchical"', 'name = "bidirectional"')),
        "site",
        "give it a layout",
    ),
    "unknown setting": (
        (SHOP, ('name = "bidirectional"', 'name = "bidirectional"\ndispatcher = "ahead"')),
        "system.dispatcher",
        "did you mean 'dispatch'?",
    ),
    "a surprise on a start": (
        (FLOOR, ("until = 60.0", f"until = 60.0\nsurprises = [{{at = 0.0, {ON_START}}}]")),
        "simulation.surprises[0]",
        "move one of them",
    ),
    "a stream without an end": ((SHOP, ("until = 60.0", "")), "simulation.streams[0]", "add until"),
}

DOUBTFUL = {
    "few chargers": (
        (SHOP, ("charging = 500.0", "charging = 500000.0"), ("until = 60.0", "until = 5000.0")),
        "4 x 1/5000 s = 0.08 %/s; 33 chargers give 33 x 1/500000 s = 0.0066 %/s",
    ),
    "no orders": (
        (FLOOR, ("streams = [", "# ")),
        "there are no orders",
    ),
    "a surprise on a station": (
        (FLOOR, ("until = 60.0", f"until = 60.0\nsurprises = [{{at = 55.0, {ON_DOCK}}}]")),
        "the obstacle covers dock from 55 s on",
    ),
}


def earlier(folder):
    """A run folder with what an earlier run wrote."""
    run = folder / "run"
    run.mkdir()
    for name in ("trace.jsonl", "report.html", "scenario.toml"):
        (run / name).write_text("earlier")
    return run


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_run_is_refused_before_anything_is_written(clearway, tmp_path, case):
    """Exit code 2 with file, place and mend; the run folder stays as it was. `check` knows it."""
    (site, *changes), key, mend = REFUSED[case]
    (tmp_path / "site.toml").write_text(altered(site, *changes))
    run = earlier(tmp_path)
    told = clearway("simulate", "site.toml", "--out", "run")
    assert (told.code, told.out) == (2, "")
    first = told.err.splitlines()[0]
    assert first.startswith("clearway: bad input: site.toml: ")
    assert key in first
    assert mend in first
    assert {file.name: file.read_text() for file in run.iterdir()} == dict.fromkeys(
        ("trace.jsonl", "report.html", "scenario.toml"), "earlier"
    )
    checked = clearway("check", "site.toml")
    assert checked.code == 2
    assert mend in checked.out + checked.err


@pytest.mark.parametrize("case", DOUBTFUL)
def test_what_is_doubtful_is_told_before_the_run(clearway, tmp_path, case):
    """On stderr, with file and place; with --json in the object instead."""
    (site, *changes), text = DOUBTFUL[case]
    (tmp_path / "site.toml").write_text(altered(site, *changes))
    begin = ("simulate", "site.toml", "--out", "run", "--expansions", "0")
    told = clearway(*begin)
    assert told.code in (0, 3)
    assert told.err.startswith("clearway: warning: site.toml: ")
    assert text in told.err
    told = clearway(*begin, "--json")
    assert told.err == ""
    assert any(text in warning for warning in told.json["warnings"])


def test_a_sound_scenario_is_run_without_a_word_on_stderr(clearway, tmp_path):
    """No warning is given for nothing."""
    (tmp_path / "shop.toml").write_text(SHOP)
    told = clearway("simulate", "shop.toml", "--out", "run", "--json")
    assert (told.code, told.err, told.json["warnings"]) == (0, "", [])


def test_a_spent_budget_leaves_a_trace_that_says_so(clearway, tmp_path):
    """Exit code 3, and everything is written and can be judged."""
    (tmp_path / "shop.toml").write_text(SHOP)
    told = clearway("simulate", "shop.toml", "--out", "run", "--expansions", "0")
    assert told.code == 3
    assert "shop: stopped" in told.out
    assert read_trace(tmp_path / "run" / "trace.jsonl").events[-1]["status"] == "stopped"
    assert "Budget spent" in (tmp_path / "run" / "report.html").read_text()
    assert clearway("validate", "run").code == 0


def test_a_full_disk_is_told_with_the_file(clearway, tmp_path):
    """The name of the trace, as writing fails and not opening."""
    (tmp_path / "shop.toml").write_text(SHOP)
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "trace.jsonl").symlink_to("/dev/full")
    told = clearway("simulate", "shop.toml", "--out", "run")
    assert (told.code, told.out) == (2, "")
    assert told.err.startswith("clearway: file: run/trace.jsonl: No space left on device; ")


def test_an_interrupt_after_the_run_keeps_its_whole_trace(clearway, tmp_path, monkeypatch):
    """While the report is made there is a trace already, and that is said."""
    (tmp_path / "shop.toml").write_text(SHOP)
    monkeypatch.setattr(
        simulate_command, "_write", lambda *given: signal.raise_signal(signal.SIGINT)
    )
    told = clearway("simulate", "shop.toml", "--out", "run", "--json")
    assert (told.code, told.json["error"]["code"]) == (130, 130)
    assert "the trace is in run/trace.jsonl" in told.json["error"]["message"]
    assert read_trace(tmp_path / "run" / "trace.jsonl").is_whole
