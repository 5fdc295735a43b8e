"""Public car-like instances: what is read, and how files that are none are refused."""

import math

import pytest

from clearway.formats.atomic import FormatError
from clearway.formats.kinodynamic import MOST_BYTES, read_instance

GOOD = """agents:
  - start: [10.0, 12, 0]
    name: agent0
    goal: [30, 12.5, 1.57]
  - start: [40, 40, -1.57]
    name: agent1
    goal: [20, 30, 3.14]
map:
  dimensions: [50, 60]
  obstacles:
    - [25, 25.5]
    - [5, 45]
"""


@pytest.fixture
def read(tmp_path):
    def read_text(text, border="closed"):
        path = tmp_path / "map_ex0.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_instance(path, border)

    return read_text


def test_a_car_starts_where_the_file_says_and_turns_the_other_way(read):
    """Positions are those of the rear axle, angles are clockwise; discs have 0.8 m."""
    scenario = read(GOOD)
    assert scenario.name == "map_ex0"
    first, second = scenario.robots
    assert (first.id, second.id) == ("agent0", "agent1")
    assert tuple(second.start) == (40.0, 40.0, 1.57)
    goal = scenario.orders[0].task
    assert goal.robot == "agent0"
    assert tuple(goal.visits[0].pose) == (30.0, 12.5, -1.57)
    assert [obstacle.disc for obstacle in scenario.site.obstacles] == [
        (25.0, 25.5, 0.8),
        (5.0, 45.0, 0.8),
    ]
    assert scenario.site.bounds[2] == (50.0, 60.0)
    car = scenario.type_of(first)
    assert car.footprint.parts[0] == ((2.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (2.0, -1.0))
    assert (car.limits.speed, car.limits.turning_radius) == (1.0, 3.0)


def test_a_border_may_be_open_and_a_list_of_obstacles_empty(read):
    """The key must be there: a file that was cut short lacks it."""
    text = GOOD[: GOOD.index("  obstacles")]
    empty = read(text + "  obstacles: []", "open")
    assert empty.site.border == "open"
    assert empty.site.obstacles == ()
    with pytest.raises(FormatError, match="missing"):
        read(text)


REPLACED = {
    "no agents": ("agents:\n  - start", "cars:\n  - start"),
    "no map": ("map:", "plan:"),
    "no goal": ("    goal: [30, 12.5, 1.57]\n", ""),
    "no name": ("    name: agent0\n", ""),
    "a name twice": ("agent1", "agent0"),
    "a number for a name": ("name: agent0", "name: 7"),
    "an empty name": ("name: agent0", "name: ''"),
    "a word for a number": ("[10.0, 12, 0]", "[ten, 12, 0]"),
    "a number in quotes": ("[10.0, 12, 0]", "['10.0', 12, 0]"),
    "not a number": ("[10.0, 12, 0]", "[.nan, 12, 0]"),
    "infinity": ("[10.0, 12, 0]", "[.inf, 12, 0]"),
    "a truth value": ("[10.0, 12, 0]", "[true, 12, 0]"),
    "nothing": ("[10.0, 12, 0]", "[~, 12, 0]"),
    "two numbers for a pose": ("[10.0, 12, 0]", "[10.0, 12]"),
    "four numbers for a pose": ("[10.0, 12, 0]", "[10.0, 12, 0, 1]"),
    "one side": ("[50, 60]", "[50]"),
    "a side of 0": ("[50, 60]", "[50, 0]"),
    "a negative side": ("[50, 60]", "[-50, 60]"),
    "a huge side": ("[50, 60]", "[50, 1.0e+9]"),
    "an obstacle of one number": ("- [25, 25.5]", "- [25]"),
    "an obstacle that is a word": ("- [25, 25.5]", "- rock"),
    "obstacles that are a number": ("obstacles:\n    - [25, 25.5]\n    - [5, 45]", "obstacles: 3"),
    "agents that are a word": ("agents:\n", "agents: none\nothers:\n"),
    "an unclosed bracket": ("[50, 60]", "[50, 60"),
    "a tab": ("  - start: [40", "\t- start: [40"),
    "a python object": ("agent1", "!!python/object/apply:os.getcwd []"),
    "a very large whole number": ("[10.0, 12, 0]", f"[{10**400}, 12, 0]"),
}


@pytest.mark.parametrize("what", REPLACED)
def test_what_is_wrong_is_named_with_its_place_and_mend(read, what):
    """The message is one line with the file and a mend; most know the key too."""
    old, new = REPLACED[what]
    assert GOOD.count(old) == 1
    with pytest.raises(FormatError) as caught:
        read(GOOD.replace(old, new))
    error = caught.value
    assert error.file.endswith("map_ex0.yaml")
    assert "\n" not in str(error)
    assert error.mend
    assert error.key or what == "nothing"


@pytest.mark.parametrize("length", range(0, len(GOOD) - 12, 7))
def test_a_file_cut_short_is_refused_or_still_an_instance(read, length):
    """Where the cut falls between obstacles what is left is whole; else the file is refused."""
    try:
        scenario = read(GOOD[:length])
    except FormatError as error:
        assert error.file.endswith("map_ex0.yaml")
    else:
        assert length > GOOD.index("25.5]")
        assert len(scenario.robots) == 2


@pytest.mark.parametrize(
    "content",
    [b"", b"\x00\x01\x02", b"\xff\xfe", b"[]", b"7", b"agents: []\nmap: {dimensions: [5, 5]}"],
    ids=["empty", "zero bytes", "not utf-8", "a list", "a number", "no robots"],
)
def test_what_is_no_instance_at_all_is_refused(read, content):
    """Whatever the bytes are, the answer is an error about the file."""
    with pytest.raises(FormatError):
        read(content)


def test_nesting_without_end_is_refused(read):
    """Ten thousand brackets exhaust no stack."""
    with pytest.raises(FormatError):
        read("agents: " + "[" * 10_000)


def test_too_many_obstacles_are_refused_before_they_are_read(read):
    """A million of them are no site; the file's size tells."""
    rows = "\n    - [25, 25]" * 1_000_000
    with pytest.raises(FormatError, match="bytes"):
        read(GOOD.rstrip() + rows)
    assert len(rows) > MOST_BYTES


def test_more_obstacles_than_are_taken_are_counted(read):
    """Below the limit of bytes their number is told."""
    with pytest.raises(FormatError, match="obstacles"):
        read(GOOD.rstrip() + "\n    - [2, 2]" * 30_000)


def test_headings_are_wrapped(read):
    """A yaw of 7 is one of 7 less a full turn, the other way."""
    pose = read(GOOD.replace("[10.0, 12, 0]", "[10.0, 12, 7]")).robots[0].start
    assert pose.theta == pytest.approx(2.0 * math.pi - 7.0)
