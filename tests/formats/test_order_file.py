"""Order files say what is to be done, and where they are wrong, line by line."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clearway.formats.order_file import OrderFileError, parse_order, read_orders, write_orders
from clearway.formats.scenario_file import parse_scenario, read_scenario
from clearway.model import Order, Pose, Task, Visit

SITE = """\
format = "clearway.scenario/1"
name = "yard"
[site]
bounds = [[0, 0], [40, 0], [40, 20], [0, 20]]
zones = [
  {name = "g1", kind = "shelf", polygon = [[1, 1], [2, 1], [2, 2]], pose = [1.5, 1.5, 0]},
  {name = "g2", kind = "shelf", polygon = [[3, 1], [4, 1], [4, 2]], pose = [3.5, 1.5, 0]},
  {name = "dock", kind = "station", polygon = [[9, 1], [10, 1], [10, 2]], pose = [9.5, 1.5, 1]},
]
[robot_types.lift]
kinematics = "holonomic"
footprint = {disc = 0.4}
limits = {speed = 1.0}
capabilities = ["fork"]
[[robots]]
id = "r1"
type = "lift"
start = [20, 10, 0]
"""
YARD = parse_scenario(SITE)

TABLE = """\
id,fetches,station,x,y,theta,service,load,needs,release,due,priority,robot
a,g1,,,,,,,,10,90.5,2,
b,,g2,,,,5,pick,fork,,,,r1
b,,,5,6,1.5,,drop,,,,,
"""
LINES = """\
{"id": "a", "fetches": "g1", "release": 10, "due": 90.5, "priority": 2}

{"id": "b", "robot": "r1", "visits": [{"station": "g2", "service": 5, "load": "pick",
 "needs": "fork"}, {"pose": [5, 6, 1.5], "load": "drop"}]}
""".replace(",\n", ",")
ORDERS = (
    Order(Task("a", (), None, "g1"), 10.0, 90.5, 2.0),
    Order(
        Task(
            "b",
            (
                Visit("b", Pose(3.5, 1.5, 0.0), 5.0, "pick", "fork"),
                Visit("b", Pose(5.0, 6.0, 1.5), load="drop"),
            ),
            "r1",
        )
    ),
)


def orders_in(folder: Path, name: str, text: str | bytes) -> tuple[Order, ...]:
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return read_orders(path, YARD)


def problems_in(folder: Path, name: str, text: str | bytes) -> dict[str, str]:
    with pytest.raises(OrderFileError) as caught:
        orders_in(folder, name, text)
    assert caught.value.file == str(folder / name)
    return {problem.key: str(problem) for problem in caught.value.problems}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("o.csv", TABLE),
        ("o.csv", TABLE.replace(",", ";")),
        ("o.CSV", TABLE.replace("\n", "\r\n")),
        ("o.csv", "\ufeff" + TABLE.replace("\n", "\n\n")),
        ("o.csv", TABLE.replace("fork", '"fork"').replace(",", ", ").replace(', "', ',"')),
        ("o.jsonl", LINES),
        ("o.jsonl", "\ufeff" + LINES.replace("\n", "\r\n")),
    ],
)
def test_every_spelling_is_understood(tmp_path: Path, name: str, text: str) -> None:
    """Commas, semicolons, line ends, marks, blanks and quotes make no difference."""
    assert orders_in(tmp_path, name, text) == ORDERS


def test_degrees_are_turned_into_radians(tmp_path: Path) -> None:
    """A pose may have theta_deg for theta, as in a scenario file."""
    (order,) = orders_in(tmp_path, "o.csv", "id,x,y,theta_deg\na,1,2,180\n")
    assert order.task.visits[0].pose == pytest.approx((1.0, 2.0, 3.141592653589793))


HEAD, ROW = "id,fetches,station,x,y,theta,service,release,due,robot\n", "o,g1,,,,,,,,\n"

# (the row that is wrong, the column, what its message holds)
BAD_ROWS = [
    ("a,g22,,,,,,,,", "fetches", ["no shelf has this name", "'g22'", "did you mean 'g2'?"]),
    ("a,dock,,,,,,,,", "fetches", ["'dock'", "known: g1, g2"]),
    ("a,,dok,,,,,,,", "station", ["'dok'", "did you mean 'dock'?"]),
    ("a,g1,,,,,,,,r11", "robot", ["unknown robot", "'r11'", "did you mean 'r1'?"]),
    ("a,g1,,,,,,-1,,", "release", ["greater than or equal to 0", "-1.0"]),
    ("a,g1,,,,,,9,8,", "due", ["before its release at 9 s", "8.0", "at least release"]),
    ("a,g1,,,,,,soon,,", "release", ["no finite number", "'soon'"]),
    ("a,g1,,,,,,nan,,", "release", ["no finite number", "'nan'"]),
    ("a,g1,,,,,,1e999,,", "release", ["no finite number", "'1e999'"]),
    ('a,g1,,,,,,"1,5",,', "release", ["'1,5'", "with a point"]),
    ("a,,,1,2,90,,,,", "theta", ["full turn", "90.0"]),
    ("a,,,1e9,2,1,,,,", "x", ["1000000000.0", "origin near"]),
    ("a,,dock,,,,-3,,,", "service", ["greater than or equal to 0", "-3.0"]),
    ("a,g1,,,,,5,,,", "service", ["beside fetches", "drop service"]),
    (",g1,,,,,,,,", "id", ["is empty"]),
    ("o,g1,,,,,,,,", "id", ["the order in line 2", "'o'", "its own"]),
    ("a,,,1,2,,,,,", "", ["x, y and one of theta", "all three"]),
    ("a,g1,dock,,,,,,,", "", ["in two ways", "fill in fetches, or"]),
    ("a,,,,,,,7,,", "", ["does not say where to go"]),
    ("a,g1,,", "", ["has 4 fields where the header has 10"]),
    ("a,g1,,,,,,,,,", "", ["has 11 fields where the header has 10"]),
    ('a,"g1,,,,,,,,', "", ["is broken", "unexpected end", 'a,"g1']),
]


@pytest.mark.parametrize(("row", "column", "parts"), BAD_ROWS)
def test_a_bad_row_is_named_and_the_rest_is_read(
    tmp_path: Path, row: str, column: str, parts: list[str]
) -> None:
    """The message has line, column, value and mend; a slip in a later line is told as well."""
    text = f"{HEAD}{ROW}{row}\nlast,g9,,,,,,,,\n"
    told = problems_in(tmp_path, "o.csv", text)
    key = f"line 3, column {column}" if column else "line 3"
    assert list(told) == [key, "line 4, column fetches"]
    for part in parts:
        assert part in told[key]


# (the line that is wrong, the key, what its message holds)
BAD_LINES = [
    ('{"id": "a", "fetches": "g9"}', "fetches", ["no shelf has this name", "'g9'"]),
    ('{"id": "a", "fetches": "g1", "relese": 1}', "relese", ["unknown key", "'release'?"]),
    ('{"id": "a", "fetches": "g1", "release": NaN}', "release", ["finite", "nan"]),
    ('{"id": "a", "fetches": "g1", "release": "1"}', "release", ["a number", "'1'"]),
    ('{"id": "a", "visits": []}', "visits", ["at least one visit"]),
    ('{"id": "a", "station": "dok"}', "station", ["'dok'", "'dock'?"]),
    ('{"id": "o", "fetches": "g1"}', "id", ["the order in line 1", "'o'"]),
    ('{"id": 7, "fetches": "g1"}', "id", ["must be a string", "7"]),
    ('{"fetches": "g1"}', "id", ["missing", "add id"]),
    ('{"id": "a", "visits": [{"station": "dock", "load": "drop"}]}', "visits[0].load", ["drops"]),
    ('{"id": "a", "fetches": "g1", "after": ["o"]}', "after", ["unknown key"]),
    ('{"id": "a"}', "", ["exactly one of", "fetches"]),
    ('{"id": "a", "fetches": "g1"', "", ["is broken at column 28"]),
    ('{"id": "a", "id": "b", "fetches": "g1"}', "", ["the key id is there twice"]),
    ('["a", "g1"]', "", ["is no object"]),
    ("[" * 100_000, "", ["nested too deeply"]),
    ("9" * 5000, "", ["is broken"]),
]


@pytest.mark.parametrize(("line", "key", "parts"), BAD_LINES)
def test_a_bad_line_is_named_and_the_rest_is_read(
    tmp_path: Path, line: str, key: str, parts: list[str]
) -> None:
    """So it is with JSON lines: line, key, value and mend, and no line is passed over."""
    text = f'{{"id": "o", "fetches": "g1"}}\n{line}\n{{"id": "z", "station": "g9"}}\n'
    told = problems_in(tmp_path, "o.jsonl", text)
    where = f"line 2, key {key}" if key else "line 2"
    assert list(told) == [where, "line 3, key station"]
    for part in parts:
        assert part in told[where]


BAD_HEADS = [
    ("id,fetchs", {"line 1, column 2": "did you mean 'fetches'?", "line 1": "fetches or station"}),
    ("id,fetches,fetches", {"line 1, column 3": "already column 2"}),
    ("fetches,release", {"line 1": "no column id"}),
    ("id,release", {"line 1": "no column fetches or station"}),
    ("a,g1", {"line 1, column 1": "unknown column, got 'a'", "line 1, column 2": "unknown"}),
]


@pytest.mark.parametrize(("head", "parts"), BAD_HEADS)
def test_a_wrong_column_is_named(tmp_path: Path, head: str, parts: dict[str, str]) -> None:
    """The closest column is offered; rows are not judged by a header that is wrong."""
    told = problems_in(tmp_path, "o.csv", f"{head}\n")
    for key, part in parts.items():
        assert part in told[key]
    told = problems_in(tmp_path, "o.csv", f'{head}\nx,"y\n')
    assert "is broken" in told["line 2"]


def test_all_problems_of_all_lines_are_told_in_their_order(tmp_path: Path) -> None:
    """One reading is enough to mend a file, whatever is wrong with which line."""
    text = f"{HEAD}{ROW}a,g8,,,,,,9,8,\nb,g1\no,g1,,,,,,,,r7\nc,,dock,,,,x,y,,\n"
    told = problems_in(tmp_path, "o.csv", text)
    assert list(told) == [
        "line 3, column due",
        "line 3, column fetches",
        "line 4",
        "line 5, column robot",
        "line 5, column id",
        "line 6, column service",
        "line 6, column release",
    ]


def test_rows_of_an_order_agree_and_stand_together(tmp_path: Path) -> None:
    """What a later row says of the order differs from the first, or comes after another order."""
    text = "id,station,release,robot\na,g1,5,\na,g2,6,r1\nb,dock,,\na,g2,,\n"
    told = problems_in(tmp_path, "o.csv", text)
    assert "differs from line 2" in told["line 3, column release"]
    assert "differs from line 2" in told["line 3, column robot"]
    assert "already the id of the order in line 2" in told["line 5, column id"]
    assert len(told) == 3


def test_a_problem_in_a_later_visit_names_its_own_line(tmp_path: Path) -> None:
    """The second row of the order has the station that there is not."""
    told = problems_in(tmp_path, "o.csv", "id,station\na,dock\na,dok\n")
    assert list(told) == ["line 3, column station"]


def test_lines_that_are_not_utf8_are_named(tmp_path: Path) -> None:
    """The other lines are looked at all the same."""
    text = "id,fetches\nä,g1\nb,g1\nc,g9\n".encode("latin-1")
    told = problems_in(tmp_path, "o.csv", text)
    assert "is not UTF-8 at its byte 1" in told["line 2"]
    assert list(told) == ["line 2", "line 4, column fetches"]


@pytest.mark.parametrize(
    ("name", "text", "part"),
    [
        ("o.csv", "", "is empty; write a header"),
        ("o.csv", " \n\n", "is empty; write a header"),
        ("o.jsonl", "\ufeff", "is empty; write one JSON object"),
        ("o.txt", TABLE, "neither .csv nor .jsonl"),
    ],
)
def test_files_that_hold_nothing(tmp_path: Path, name: str, text: str, part: str) -> None:
    """A file without a line, or of a kind that nobody can tell, is refused as a whole."""
    assert part in problems_in(tmp_path, name, text)["(file)"]


def test_a_header_alone_is_no_order(tmp_path: Path) -> None:
    """A day without orders is a day."""
    assert orders_in(tmp_path, "o.csv", HEAD) == ()


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    """Missing files and folders are named."""
    for path, part in ((tmp_path / "absent.csv", "check the name"), (tmp_path, "is a directory")):
        with pytest.raises(OrderFileError, match=part):
            read_orders(path, YARD)


def test_one_order_is_checked_as_those_of_files_are() -> None:
    """Its release is now where it does not say, and never before."""
    order = parse_order({"id": "x", "fetches": "g1"}, YARD, {}, now=12.5)
    assert order == Order(Task("x", (), None, "g1"), 12.5)
    cases: list[tuple[dict[str, Any], str]] = [
        ({"id": "x", "fetches": "g1", "release": 12}, "release: is before now, which is 12.5 s"),
        ({"id": "a", "fetches": "g1"}, "id: is already the id of the order in tasks"),
        ({"id": "x", "fetches": "g7"}, "fetches: no shelf has this name, got 'g7'"),
        ({}, "id: is missing; add id"),
    ]
    for keys, part in cases:
        with pytest.raises(OrderFileError, match=part):
            parse_order(keys, YARD, {"a": "tasks[0]"}, now=12.5)


def test_scenarios_take_orders_from_files_beside_them(tmp_path: Path) -> None:
    """Listed tasks come first; an id in two places is refused, and both places are named."""
    (tmp_path / "a.csv").write_text(TABLE)
    (tmp_path / "b.jsonl").write_text('{"id": "c", "station": "dock"}\n')
    path = tmp_path / "yard.toml"
    task = '[[tasks]]\nid = "t"\nstation = "dock"\n'
    path.write_text(f'orders = ["a.csv", "b.jsonl"]\n{SITE}{task}')
    assert [order.task.id for order in read_scenario(path).orders] == ["t", "a", "b", "c"]
    same = task.replace('"t"', '"b"')
    path.write_text(f'orders = "a.csv"\n{SITE}{same}')
    with pytest.raises(OrderFileError, match=r"a\.csv: line 3, column id: .*in tasks\[0\] of"):
        read_scenario(path)
    path.write_text(f'orders = ["a.csv", "a.csv"]\n{SITE}')
    with pytest.raises(OrderFileError, match=r"line 2, column id: .*the order in a\.csv"):
        read_scenario(path)
    path.write_text(f'orders = "c.csv"\n{SITE}')
    with pytest.raises(OrderFileError, match=r"c\.csv: \(file\): cannot be read"):
        read_scenario(path)


printable = st.characters(exclude_categories=("C", "Z"), include_characters=" ")
names = st.text(printable, min_size=1, max_size=6).filter(lambda s: s == s.strip())
poses = st.builds(Pose, st.floats(-1e4, 1e4), st.floats(-1e4, 1e4), st.floats(-6, 6))
times = st.floats(0.0, 1e6)


@st.composite
def written(draw: st.DrawFn) -> Order:
    name, robot = draw(names), draw(st.sampled_from([None, "r1"]))
    visits = st.builds(Visit, st.just(name), poses, times, st.just(None), st.just("fork"))
    if draw(st.booleans()):
        task = Task(name, (), robot, draw(st.sampled_from(["g1", "g2"])))
    else:
        task = Task(name, tuple(draw(st.lists(visits, min_size=1, max_size=3))), robot)
    release = draw(times)
    due = draw(st.none() | st.just(release) | st.floats(1e6, 1e7))
    return Order(task, release, due, draw(st.floats(-9, 9)))


@settings(max_examples=60, deadline=None)
@given(
    st.lists(written(), min_size=1, max_size=4, unique_by=lambda order: order.task.id),
    st.sampled_from(["o.csv", "o.jsonl"]),
)
def test_orders_survive_their_file(
    tmp_path_factory: pytest.TempPathFactory, orders: list[Order], name: str
) -> None:
    """Numbers and odd names come back to the last bit."""
    path = tmp_path_factory.mktemp("orders") / name
    write_orders(path, orders)
    assert read_orders(path, YARD) == tuple(orders)


def test_what_no_order_file_can_hold(tmp_path: Path) -> None:
    """Times of single visits, other tasks to wait for, blanks around names: said, not lost."""
    pose = Pose(1.0, 1.0, 0.0)
    late = Order(Task("a", (Visit("a", pose, not_before=3.0),)))
    after = Order(Task("a", (Visit("a", pose),)), after=("b",))
    together = Order(Task("a", (Visit("a", pose, together=("r1",)),)))
    blank = Order(Task(" a", (), None, "g1"))
    for order, name, part in (
        (late, "o.jsonl", "times of their own"),
        (after, "o.csv", "waits for others"),
        (together, "o.csv", "together"),
        (blank, "o.csv", "blanks"),
        (blank, "o.txt", "ends in .csv or .jsonl"),
    ):
        with pytest.raises(ValueError, match=part):
            write_orders(tmp_path / name, [order])
    with pytest.raises(ValueError, match="no orders"):
        write_orders(tmp_path / "o.jsonl", [])
    assert list(tmp_path.iterdir()) == []
