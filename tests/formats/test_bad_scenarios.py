"""Scenario files that must be refused, each with the key, the value and the mend in the message."""

import os
from pathlib import Path

import pytest

from clearway.formats import source
from clearway.formats.scenario_file import ScenarioError, parse_scenario, read_scenario

GOOD = """\
format = "clearway.scenario/1"
name = "dock"
seed = 7

[site]
bounds = [[0, 0], [40, 0], [40, 20], [0, 20]]
border = "closed"
obstacles = [
  {polygon = [[20, 5], [22, 5], [22, 15], [20, 15]]},
  {disc = [30, 10, 1.5], blocks = ["carrier:loaded"]},
  {wall = [[10, 0], [10, 4]]},
]
zones = [
  {name = "dock-1", kind = "station", polygon = [[34, 4], [38, 4], [38, 8]], pose = [36, 5, 0]},
  {name = "slow", kind = "speed", polygon = [[0, 0], [5, 0], [5, 5]], value = 1.0},
]

[robot_types.carrier]
kinematics = "four_wheel"
footprint = [[1.5, 1], [-1.5, 1], [-1.5, -1], [1.5, -1]]
loaded_footprint = {disc = 1.8}
clearance = 0.1
limits = {speed = 2.5, yaw_rate = 0.57, turning_radius = 3.0, acceleration = 1.0}
modes = ["stop", "forward", "reverse"]
capacity = 1
capabilities = ["lift"]
battery = {capacity = 3600.0, reserve = 0.2}

[robot_types.cart]
kinematics = "differential"
footprint = {disc = 0.5}
limits = {speed = 1.5}

[[robots]]
id = "r1"
type = "carrier"
start = [5.0, 3.0, 0.0]

[[robots]]
id = "r2"
type = "cart"
start = {x = 5.0, y = 12.0, theta_deg = 90}

[[tasks]]
id = "t1"
visits = [
  {station = "dock-1", service = 5.0, load = "pick", needs = "lift", together = ["r2"]},
  {pose = [30, 3, 0], load = "drop"},
]
release = 10.0
due = 100.0

[[tasks]]
id = "t2"
pose = [15, 15, 1.5]
service = 5.0
robot = "r2"
priority = 1.0

[system]
name = "hierarchical"
weight = 1.5
"""

CARRIER = "[[1.5, 1], [-1.5, 1], [-1.5, -1], [1.5, -1]]"
TYPE = "robot_types.carrier"

# (what stands in the good file, what replaces it, key, value or "", part of the mend)
BAD = [
    # numbers
    ("[5.0, 3.0, 0.0]", "[5.0, nan, 0.0]", "robots[0].start[1]", "nan", "write a number"),
    ("[[0, 0], [40", "[[inf, 0], [40", "site.bounds[0][0]", "inf", "write a number"),
    ("weight = 1.5", "weight = -inf", "system.weight", "-inf", "write a number"),
    ("seed = 7", f"seed = {10**30}", "seed", "", "smaller number"),
    ("seed = 7", "seed = -7", "seed", "-7", "greater than or equal to 0"),
    ("seed = 7", "seed = 7.5", "seed", "7.5", "whole number"),
    ("[5.0, 3.0, 0.0]", "[5.0, 3.0]", "robots[0].start", "[5.0, 3.0]", "[x, y, theta]"),
    ("[5.0, 3.0, 0.0]", '[5.0, "3", 0.0]', "robots[0].start[1]", "'3'", "write a number"),
    ("[5.0, 3.0, 0.0]", "[true, 3.0, 0.0]", "robots[0].start[0]", "True", "write a number"),
    ("[5.0, 3.0, 0.0]", "[5e9, 3.0, 0.0]", "robots[0].start[0]", "5000000000.0", "origin near"),
    # units that show
    ("[5.0, 3.0, 0.0]", "[5.0, 3.0, 90.0]", "robots[0].start[2]", "90.0", "theta_deg"),
    ("theta_deg = 90", "theta_deg = 1570", "robots[1].start.theta_deg", "1570", "-180 and 180"),
    ("theta_deg = 90", "theta_dg = 90", "robots[1].start.theta_dg", "90", "'theta_deg'?"),
    ("theta_deg = 90", "theta_deg = 90, theta = 1", "robots[1].start", "theta", "theta_deg = .."),
    ("speed = 2.5", "speed = 90", f"{TYPE}.limits.speed", "90", "m/s"),
    ("speed = 2.5", "speed = -2.5", f"{TYPE}.limits.speed", "-2.5", "m/s"),
    ("yaw_rate = 0.57", "yaw_rate = 33", f"{TYPE}.limits.yaw_rate", "33", "rad/s, not degrees"),
    ("radius = 3.0", "radius = 3000.0", f"{TYPE}.limits.turning_radius", "3000.0", "in m"),
    ("acceleration = 1.0", "acceleration = 980", f"{TYPE}.limits.acceleration", "980", "m/s^2"),
    ("[[1.5, 1], [", "[[1500, 1], [", f"{TYPE}.footprint", "1500", "corners in m"),
    ("{disc = 0.5}", "{disc = 500}", "robot_types.cart.footprint.disc", "500", "radius in m"),
    ("[40, 0], [40, 20]", "[400000, 0], [400000, 20]", "site.bounds", "400000.0", "not mm"),
    ("value = 1.0", "value = 90.0", "site.zones[1].value", "90.0", "m/s"),
    # sizes and shapes
    ("10, 1.5]", "10, -1.5]", "site.obstacles[1].disc[2]", "-1.5", "radius in m"),
    ("clearance = 0.1", "clearance = -0.1", f"{TYPE}.clearance", "-0.1", "in m"),
    ("{disc = 0.5}", "{disc = -0.5}", "robot_types.cart.footprint.disc", "-0.5", "radius in m"),
    ("{disc = 0.5}", "{radius = 0.5}", "robot_types.cart.footprint", "radius", "{disc = radius}"),
    (
        "{disc = 0.5}",
        "[[0, 1], [1, 0]]",
        "robot_types.cart.footprint",
        "[[0, 1]",
        "list its corners",
    ),
    (
        CARRIER,
        "[[2, 1], [-2, 1], [0, 0], [-2, -1], [2, -1]]",
        f"{TYPE}.footprint",
        "[0, 0]",
        "several such polygons",
    ),
    (
        CARRIER,
        "[[[1, 0], [0, 1], [0, 0]], [[1, 0], [2, 0], [3, 0]]]",
        f"{TYPE}.footprint[1]",
        "[3, 0]",
        "corners of a convex polygon",
    ),
    ("[40, 20], [0, 20]]", "[0, 20], [40, 20]]", "site.bounds", "[0, 20]", "no two edges cross"),
    ("[22, 15], [20, 15]]", "[20, 15], [22, 15]]", "site.obstacles[0].polygon", "", "edges cross"),
    (
        "[34, 4], [38, 4], [38, 8]",
        "[1, 1], [2, 2], [3, 3]",
        "site.zones[0].polygon",
        "",
        "one line",
    ),
    ("[10, 0], [10, 4]", "[10, 0], [10, 0]", "site.obstacles[2].wall", "[10, 0]", "a length"),
    ("{wall =", "{disc = [1, 1, 1], wall =", "site.obstacles[2]", "'wall'", "keep one of"),
    ("reserve = 0.2", "reserve = 1.0", f"{TYPE}.battery.reserve", "1.0", "less than 1"),
    ("service = 5.0\nrobot", "service = -5.0\nrobot", "tasks[1].service", "-5.0", "in s"),
    # words
    ('"clearway.scenario/1"', '"clearway.scenario/9"', "format", "/9", "clearway.scenario/1"),
    ('format = "clearway.scenario/1"\n', "", "format", "", "add format ="),
    ('name = "dock"\n', "", "name", "", "add name"),
    ('name = "dock"', 'name = ""', "name", "''", "1 to 200"),
    ("clearance =", "clearence =", f"{TYPE}.clearence", "0.1", "did you mean 'clearance'?"),
    ("border =", "bordr =", "site.bordr", "'closed'", "did you mean 'border'?"),
    ('"closed"', '"close"', "site.border", "'close'", "did you mean 'closed'?"),
    ('"four_wheel"', '"4ws"', f"{TYPE}.kinematics", "'4ws'", "four_wheel, holonomic"),
    ('"stop", "forward"', '"stop", "foward"', f"{TYPE}.modes[1]", "'foward'", "'forward'?"),
    ('"four_wheel"', '"ackermann"', f"{TYPE}.modes", "'stop'", "remove modes"),
    (
        "clearance =",
        'motion = "forklfit"\nclearance =',
        f"{TYPE}.motion",
        "'forklfit'",
        "four_wheel",
    ),
    (
        "limits = {speed = 1.5}",
        'limits = {speed = 1.5}\nmotion = "car"',
        "robot_types.cart.motion",
        "'car'",
        "known: differential",
    ),
    ('kind = "station"', 'kind = "statoin"', "site.zones[0].kind", "'statoin'", "'station'?"),
    (", pose = [36, 5, 0]", "", "site.zones[0]", "'dock-1'", "add pose"),
    (", value = 1.0", "", "site.zones[1]", "'slow'", "add value (m/s)"),
    ("carrier:loaded", "carier", "site.obstacles[1].blocks[0]", "'carier'", "'carrier'?"),
    ("robot_types.cart]", 'robot_types."a:b"]', 'robot_types."a:b"', "'a:b'", "without a colon"),
    ("weight = 1.5", "weight = [1.5]", "system.weight", "[1.5]", "single value"),
    ("weight = 1.5", "weight = 1999-01-01", "system.weight", "1999", "single value"),
    # references
    ('id = "r2"', 'id = "r1"', "robots[1].id", "'r1'", "its own id"),
    ('id = "t2"', 'id = "t1"', "tasks[1].id", "'t1'", "its own id"),
    ('name = "slow"', 'name = "dock-1"', "site.zones[1].name", "'dock-1'", "its own name"),
    ('type = "cart"', 'type = "crat"', "robots[1].type", "'crat'", "did you mean 'cart'?"),
    (
        'station = "dock-1"',
        'station = "dok-1"',
        "tasks[0].visits[0].station",
        "'dok-1'",
        "'dock-1'?",
    ),
    ('robot = "r2"', 'robot = "r3"', "tasks[1].robot", "'r3'", "known: r1, r2"),
    ('["r2"]', '["r9"]', "tasks[0].visits[0].together[0]", "'r9'", "known: r1, r2"),
    ('["r2"]', '["r2", "r2"]', "tasks[0].visits[0].together[1]", "'r2'", "each other robot once"),
    ('needs = "lift"', 'needs = "lft"', "tasks[0].visits[0].needs", "'lft'", "'lift'?"),
    ("pose = [15, ", 'needs = "lift"\npose = [15, ', "tasks[1].needs", "'lift'", "capabilities"),
    ("due = 100.0", 'after = ["t22"]', "tasks[0].after[0]", "'t22'", "did you mean 't2'?"),
    ("due = 100.0", 'after = ["t1"]', "tasks[0].after[0]", "'t1'", "each other task once"),
    ("due = 100.0", 'after = ["t2", "t2"]', "tasks[0].after[1]", "'t2'", "each other task once"),
    ("due = 100.0", 'after = "t2"', "tasks[0].after", "'t2'", "brackets"),
    # work
    ('load = "pick", ', "", "tasks[0].visits[1].load", "'drop'", "load = 'pick' before"),
    ('load = "drop"', 'load = "pick"', "tasks[0].visits[1].load", "'pick'", "raise capacity"),
    ('load = "drop"', 'load = "dorp"', "tasks[0].visits[1].load", "'dorp'", "'drop'?"),
    ("due = 100.0", "due = 5.0", "tasks[0].due", "5.0", "at least release"),
    ("{pose = [30, 3, 0], load", "{load", "tasks[0].visits[1]", "", "add one of pose, station"),
    ("pose = [15, 15, 1.5]", "visits = []", "tasks[1].visits", "[]", "add {pose"),
    (
        "pose = [15, 15, 1.5]",
        "visits = [{pose = [1, 1, 0]}]",
        "tasks[1].service",
        "5.0",
        "into a visit",
    ),
    # tables of the wrong kind
    ("limits = {speed = 1.5}", "limits = 1.5", "robot_types.cart.limits", "1.5", "as a table"),
    ("limits = {speed = 1.5}", "", "robot_types.cart.limits", "", "add limits"),
    (
        'capabilities = ["lift"]',
        'capabilities = "lift"',
        f"{TYPE}.capabilities",
        "'lift'",
        "brackets",
    ),
]


@pytest.mark.parametrize(("old", "new", "key", "value", "mend"), BAD)
def test_message_names_file_key_value_and_mend(
    old: str, new: str, key: str, value: str, mend: str
) -> None:
    """Whoever reads the message knows where to look and what to write instead."""
    assert GOOD.count(old) >= 1
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(GOOD.replace(old, new, 1), "dock.toml")
    error, message = caught.value, str(caught.value)
    assert message.startswith(f"dock.toml: {key}: ")
    assert error.file == "dock.toml"
    assert error.key == key
    assert mend in (error.mend or "")
    assert mend in message
    assert value in (f"{error.value!r}" if value else "")
    assert "\n" not in message


def test_tasks_that_wait_for_each_other_are_told_in_their_circle() -> None:
    """Nobody could begin: t1 waits for t2, which waits for t1."""
    text = GOOD.replace("due = 100.0", 'after = ["t2"]')
    text = text.replace("priority = 1.0", 'after = ["t1"]')
    with pytest.raises(ScenarioError, match=r"each other: t1 after t2 after t1, got .*; drop one"):
        parse_scenario(text)


def test_the_good_file_is_good() -> None:
    """The table above changes one thing at a time in a file that is right."""
    scenario = parse_scenario(GOOD)
    assert [order.task.id for order in scenario.orders] == ["t1", "t2"]
    assert scenario.orders[0].task.visits[0].pose == (36.0, 5.0, 0.0)


@pytest.mark.parametrize(
    ("head", "key", "mend"),
    [("robots", "robots", "add a robot"), ("robot_types", "robot_types", "[robot_types.NAME]")],
)
def test_nobody_to_work(head: str, key: str, mend: str) -> None:
    """A scenario without robots or without robot types is none, absent or empty."""
    site = "bounds = [[0, 0], [4, 0], [4, 2]]"
    rest = {
        "robots": 'robots = [{id = "a", type = "b", start = [1, 1, 0]}]',
        "robot_types": 'robot_types = {b = {kinematics = "holonomic", footprint = {disc = 0.1}, '
        "limits = {speed = 1}}}",
    }
    for empty in ("", f"{head} = " + ("[]" if head == "robots" else "{}")):
        lines = ['format = "clearway.scenario/1"', 'name = "n"', f"site = {{{site}}}"]
        lines += [empty if name == head else line for name, line in rest.items()]
        with pytest.raises(ScenarioError) as caught:
            parse_scenario("\n".join(lines))
        assert caught.value.key == key
        assert mend in str(caught.value)


def test_all_problems_are_told_together() -> None:
    """Three slips in three places cost one reading, not three."""
    text = GOOD.replace("speed = 2.5", "speed = 90").replace("clearance =", "clearence =")
    text = text.replace("[5.0, 3.0, 0.0]", "[5.0, 3.0, 90.0]").replace('"closed"', '"shut"')
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(text)
    keys = {problem.key for problem in caught.value.problems}
    assert keys == {"site.border", f"{TYPE}.clearence", "robots[0].start[2]"}
    assert "(and 2 more problems)" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ('name = "x"\nseed = = 3\n', "line 2, column 8"),
        ('name = "x\n', "line 1"),
        ("a = 1\na = 2\n", "line 2"),
        ("x = " + "9" * 5000, "(file)"),
        ("x = " + "[" * 20000, "(file)"),
    ],
)
def test_broken_toml_has_a_place(text: str, place: str) -> None:
    """A file that is not TOML is refused with the line and column where it breaks."""
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(text, "broken.toml")
    assert place in str(caught.value)
    assert str(caught.value).startswith("broken.toml: ")


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    """Missing files, folders, pipes and other encodings are named, and never opened blindly."""
    latin = tmp_path / "latin.toml"
    latin.write_bytes('name = "Straße"'.encode("latin-1"))
    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    cases = {
        tmp_path / "absent.toml": "check the name",
        tmp_path: "is a directory",
        latin: "not UTF-8 at byte 12",
        pipe: "not a regular file",
        Path("a\0b"): "check the name",
    }
    for path, part in cases.items():
        with pytest.raises(ScenarioError) as caught:
            read_scenario(path)
        assert part in str(caught.value)
        assert caught.value.file == str(path)


def test_a_huge_file_is_refused_unread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file above 64 MiB is refused by its size, before its bytes reach memory."""
    path = tmp_path / "huge.toml"
    with path.open("wb") as file:
        file.truncate(source.LARGEST_FILE + 1)

    def never(_: Path) -> bytes:
        raise AssertionError("the file was read")

    monkeypatch.setattr(Path, "read_bytes", never)
    with pytest.raises(ScenarioError, match="64 MiB"):
        read_scenario(path)


def test_utf8_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    """Editors that put a byte order mark in front of UTF-8 do no harm."""
    path = tmp_path / "bom.toml"
    path.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert read_scenario(path) == parse_scenario(GOOD)
