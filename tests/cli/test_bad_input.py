"""Bad input ends with exit code 2 and one error that names culprit, place and mend."""

import json
import os

import pytest
from tests.cli.sites import HALL, altered

FOOTPRINT = "[[1.5, 1], [-1.5, 1], [-1.5, -1], [1.5, -1]]"
FLEET = HALL[HALL.index("robots = [") : HALL.index("tasks = [")]
CROWDED = "".join(
    f'  {{id = "r{k}", type = "carrier", start = [{3.0 + 0.3 * k:.1f}, 3.0, 0.0]}},\n'
    for k in range(45)
)
CROWD = f"robots = [\n{CROWDED}]\n"

# What the file says instead, where the error points, and a word of what it says.
BAD = {
    "start in an obstacle": (("[3.0, 3.0, 0.0]", "[9.0, 6.0, 0.0]"), "robots[0].start", "overlaps"),
    "starts in collision": (("[3.0, 9.0, 0.0]", "[3.0, 4.5, 0.0]"), "robots[0].start", "overlap"),
    "start outside": (("[3.0, 3.0, 0.0]", "[3.0, -3.0, 0.0]"), "robots[0].start", "outside"),
    "goal in an obstacle": (("[16.0, 3.0, 0.0]", "[9.0, 6.0, 0.0]"), "tasks[0].pose", "overlaps"),
    "goal outside": (("[16.0, 3.0, 0.0]", "[26.0, 3.0, 0.0]"), "tasks[0].pose", "outside"),
    "unreachable goal": (
        ("obstacles = [", "obstacles = [{wall = [[13, 0], [13, 12]]}, "),
        "tasks[0].pose",
        "no way",
    ),
    "two corners": (
        (FOOTPRINT, "[[1.5, 1], [-1.5, 1]]"),
        "robot_types.carrier.footprint",
        "3 points",
    ),
    "not convex": (
        (FOOTPRINT, "[[1.5, 1], [0, 0], [-1.5, 1], [-1.5, -1], [1.5, -1]]"),
        "robot_types.carrier.footprint",
        "not convex",
    ),
    "nan": (("[16.0, 3.0, 0.0]", "[nan, 3.0, 0.0]"), "tasks[0].pose[0]", "finite"),
    "infinity": (("speed = 2.5", "speed = inf"), "robot_types.carrier.limits.speed", "finite"),
    "negative size": (
        ("{polygon = [[8, 5], [10, 5], [10, 7], [8, 7]]}", "{disc = [9, 6, -1]}"),
        "site.obstacles[0].disc[2]",
        "above 0",
    ),
    "negative speed": (
        ("speed = 2.5", "speed = -2.5"),
        "robot_types.carrier.limits.speed",
        "greater than 0",
    ),
    "speed of 2500": (
        ("speed = 2.5", "speed = 2500"),
        "robot_types.carrier.limits.speed",
        "m/s",
    ),
    "robot twice": (('id = "b"', 'id = "a"'), "robots[1].id", "its own id"),
    "task twice": (('id = "t2"', 'id = "t1"'), "tasks[1].id", "its own id"),
    "empty fleet": ((FLEET, "robots = []\n"), "robots", "fleet is empty"),
    "more robots than room": ((FLEET, CROWD), "robots", "overlap"),
    "unknown key": (("service = 1.0", "servce = 1.0"), "tasks[0].servce", "'service'"),
    "unknown table": (("[system]", "[sistem]"), "sistem", "'system'"),
    "unknown setting": (
        ('name = "hierarchical"', 'name = "hierarchical"\nwieght = 2.0'),
        "system.wieght",
        "weight",
    ),
    "setting out of range": (
        ('name = "hierarchical"', 'name = "hierarchical"\nturning = -1.0'),
        "system.turning",
        "0 or above",
    ),
    "unknown system": (
        ('name = "hierarchical"', 'name = "hierarchic"'),
        "system.name",
        "hierarchical",
    ),
    "unknown robot type": (('type = "carrier"', 'type = "carier"'), "robots[0].type", "'carrier'"),
    "not TOML": (('name = "hall"', 'name = "hall'), "", "TOML"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_scenario_is_refused_with_one_named_error(clearway, hall, tmp_path, case):
    """File, key and what is wrong on the first line; no traceback, no result."""
    (old, new), key, word = BAD[case]
    hall.write_text(altered(old, new))
    told = clearway("solve", hall, "--out", "run")
    assert told.code == 2
    assert told.out == ""
    assert "Traceback" not in told.err
    assert told.err.startswith("clearway: ")
    assert "hall.toml" in told.err.splitlines()[0]
    assert key in told.err
    assert word in told.err
    assert not list(tmp_path.glob("run/*"))


@pytest.mark.parametrize("case", BAD)
def test_with_json_the_error_is_one_object_with_file_and_key(clearway, hall, case):
    """What a program needs to point at the place."""
    (old, new), key, word = BAD[case]
    hall.write_text(altered(old, new))
    told = clearway("solve", hall, "--out", "run", "--json")
    error = told.json["error"]
    assert (told.code, told.err) == (2, "")
    assert error["code"] == 2
    assert error["file"].endswith("hall.toml")
    assert error["key"].startswith(key) or any(key in text for text in error["more"])
    assert word in told.out
    assert "object at 0x" not in told.out


def test_a_scenario_that_is_only_doubtful_to_one_command_is_bad_to_all(clearway, hall):
    """``check`` ends with 2 on what ``solve`` refuses."""
    hall.write_text(altered("[3.0, 3.0, 0.0]", "[9.0, 6.0, 0.0]"))
    assert clearway("check", hall).code == 2
    hall.write_text(altered("speed = 2.5", "speed = 2500"))
    told = clearway("check", hall, "--json")
    assert told.code == 2
    assert told.json["error"]["key"] == "robot_types.carrier.limits.speed"


def test_a_file_of_100_megabytes_is_not_read(clearway, tmp_path):
    """Its size is told, and the most that is read."""
    with open(tmp_path / "huge.toml", "wb") as file:
        file.truncate(100 * 2**20)
    told = clearway("solve", "huge.toml", "--out", "run")
    assert told.code == 2
    assert "huge.toml" in told.err
    assert "bytes" in told.err


def test_a_truncated_plan_is_malformed_and_not_wrong(clearway, solved_hall, tmp_path):
    """Exit code 2 and not 1: nothing was judged."""
    text = (solved_hall / "plan.json").read_text()
    (tmp_path / "plan.json").write_text(text[: len(text) // 2])
    told = clearway("validate", tmp_path)
    assert told.code == 2
    assert "plan.json" in told.err
    assert "ends too early" in told.err
    told = clearway("validate", "plan.json", "--json")
    assert told.json["error"]["file"].endswith("plan.json")
    assert "object at 0x" not in told.out


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"format": "clearway.plan/9"}, "format"),
        ({"robots": []}, ""),
        ({"trajectories": {"a": {"t": [0], "x": [], "y": [0], "theta": [0]}}}, "trajectories"),
        ({"robot_types": {}}, "type"),
        ({"status": "fine"}, "status"),
        ({"sum_of_costs": "much"}, "sum_of_costs"),
        ({"site": None}, "site"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else None,
)
def test_a_plan_that_is_not_of_the_format_is_never_a_traceback(
    clearway, solved_hall, tmp_path, change, word
):
    """Malformed is 2, wrong is 1; either names what it is about."""
    plan = json.loads((solved_hall / "plan.json").read_text())
    (tmp_path / "odd.json").write_text(json.dumps({**plan, **change}))
    told = clearway("validate", "odd.json")
    assert told.code in ((1, 2) if change == {"robots": []} else (2,))
    assert "Traceback" not in told.err
    assert word in told.err


def test_an_out_that_is_a_file_is_named(clearway, hall, tmp_path):
    """Also where it is above the folder that was asked for."""
    (tmp_path / "taken").write_text("here first")
    for out in ("taken", "taken/deeper"):
        told = clearway("solve", hall, "--out", out)
        assert told.code == 2
        assert out in told.err
        assert "Traceback" not in told.err
        assert clearway("solve", hall, "--out", out, "--json").json["error"]["file"]
    assert (tmp_path / "taken").read_text() == "here first"


@pytest.mark.parametrize("command", [("solve", "--out", "run"), ("check",), ("validate",)])
def test_a_path_that_cannot_be_read_is_named(clearway, tmp_path, command):
    """A missing file, a folder, and a device are no scenario and no plan."""
    name, *options = command
    (tmp_path / "folder").mkdir()
    for path in ("missing.toml", "folder", os.devnull):
        told = clearway(name, path, *options)
        assert told.code == 2
        assert told.err.startswith("clearway: ")
        assert "Traceback" not in told.err


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read everything")
def test_a_file_without_rights_is_named(clearway, hall):
    """Not allowed is not the same as not there."""
    hall.chmod(0)
    told = clearway("solve", hall, "--out", "run")
    assert told.code == 2
    assert "denied" in told.err.lower()


def test_binary_data_is_no_scenario_and_no_plan(clearway, tmp_path):
    """Bytes that are no text."""
    (tmp_path / "noise").write_bytes(bytes(range(256)))
    for command in (("solve", "noise", "--out", "run"), ("validate", "noise")):
        told = clearway(*command)
        assert told.code == 2
        assert "UTF-8" in told.err


USAGE = [
    ((), "COMMAND"),
    (("fly",), "fly"),
    (("solve",), "SCENARIO.toml"),
    (("solve", "x.toml"), "--out"),
    (("solve", "x.toml", "--out", "run", "--seed", "abc"), "--seed"),
    (("solve", "x.toml", "--out", "run", "--seed", "-1"), "--seed"),
    (("solve", "x.toml", "--out", "run", "--expansions", "1.5"), "--expansions"),
    (("solve", "x.toml", "--out", "run", "--budget", "nan"), "--budget"),
    (("solve", "x.toml", "--out", "run", "--budget", "0"), "--budget"),
    (("validate", "run", "--colour"), "--colour"),
]


@pytest.mark.parametrize(("arguments", "word"), USAGE)
def test_wrong_usage_ends_with_2_and_how_to_use_it(clearway, arguments, word):
    """The argument is named; no inner name shows."""
    told = clearway(*arguments)
    assert (told.code, told.out) == (2, "")
    assert word in told.err
    assert "usage:" in told.err
    assert "_count" not in told.err
    assert "_positive" not in told.err


@pytest.mark.parametrize(("arguments", "word"), USAGE)
def test_wrong_usage_is_one_object_with_json(clearway, arguments, word):
    """Wherever --json stands."""
    told = clearway(*arguments, "--json")
    error = told.json["error"]
    assert (told.code, told.err) == (2, "")
    assert (error["code"], error["kind"]) == (2, "usage")
    assert word in error["message"]
