"""What a scenario file says is what the scenario holds, there and back."""

import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clearway.formats.scenario_file import (
    dump_scenario,
    parse_scenario,
    read_scenario,
    scenario_schema,
)
from clearway.model import (
    FOUR_WHEEL_MODES,
    Battery,
    Disturbances,
    Draw,
    Footprint,
    Layout,
    Limits,
    Obstacle,
    Order,
    OrderStream,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Simulation,
    Site,
    Surprise,
    Task,
    Visit,
    Zone,
)
from clearway.world.channels import site_of

TEXT = """\
format = "clearway.scenario/1"
name = "small"
seed = 3
[site]
bounds = [[0, 0], [0, 10], [20, 10], [20, 0]]
border = "open"
obstacles = [{disc = [3, 4, 0.5], blocks = ["lift:loaded"]}, {wall = [[1, 1], [2, 1]]}]
[[site.zones]]
name = "dock"
kind = "station"
polygon = [[15, 0], [20, 0], [20, 5]]
pose = {x = 17, y = 2, theta_deg = -90}
[robot_types.lift]
kinematics = "ackermann"
footprint = [
  [[1, 0.5], [-1, 0.5], [-1, -0.5], [1, -0.5]],
  [[1, 0.2], [2, 0.2], [2, -0.2], [1, -0.2]],
]
loaded_footprint = {disc = 2.5}
limits = {speed = 2, reverse_speed = 0}
motion = "forklift"
capabilities = ["fork"]
[[robots]]
id = "r1"
type = "lift"
start = [5, 3, 0]
[[tasks]]
id = "t1"
visits = [{station = "dock", load = "pick"}, {pose = [5, 5, 1], service = 2, load = "drop"}]
[[tasks]]
id = "t2"
station = "dock"
needs = "fork"
robot = "r1"
due = 0.0
after = ["t1"]
[system]
name = "forklift"
horizon = 30
fast = true
label = "a b"
"""


def test_every_spelling_is_understood() -> None:
    """Degrees, stations, the one-visit shorthand, unions and discs become the same nouns."""
    scenario = parse_scenario(TEXT)
    dock = Pose(17.0, 2.0, -math.pi / 2.0)
    first, second = (order.task for order in scenario.orders)
    assert first.visits == (
        Visit("t1", dock, load="pick"),
        Visit("t1", Pose(5.0, 5.0, 1.0), 2.0, "drop"),
    )
    assert second == Task("t2", (Visit("t2", dock, needs="fork"),), "r1")
    assert scenario.orders[1].due == 0.0
    assert [order.after for order in scenario.orders] == [(), ("t1",)]
    kind = scenario.robot_types["lift"]
    assert len(kind.footprint.parts) == 2
    assert kind.shape(True) == Footprint(radius=2.5)
    assert kind.limits.speed_backwards == 0.0
    # Corners given clockwise are kept counter-clockwise.
    assert scenario.site.bounds == ((20.0, 0.0), (20.0, 10.0), (0.0, 10.0), (0.0, 0.0))
    assert scenario.site.obstacles[0].blocks == ("lift:loaded",)
    assert scenario.system == "forklift"
    assert scenario.settings == {"horizon": 30, "fast": True, "label": "a b"}
    assert scenario.seed == 3


def test_system_and_tasks_may_be_left_out() -> None:
    """A site with robots is a scenario; the hierarchical system is the usual one."""
    text = TEXT[: TEXT.index("[[tasks]]")]
    scenario = parse_scenario(text)
    assert scenario.orders == ()
    assert (scenario.system, scenario.settings) == ("hierarchical", {})


def test_dump_reads_back_equal(tmp_path: Path) -> None:
    """Writing loses nothing, and what was written can be opened as a file."""
    scenario = parse_scenario(TEXT)
    path = tmp_path / "again.toml"
    path.write_text(dump_scenario(scenario, "first line\nsecond line"), encoding="utf-8")
    assert path.read_text(encoding="utf-8").startswith("# first line\n# second line\nformat")
    assert read_scenario(path) == scenario


def test_dump_lists_one_thing_a_line() -> None:
    """A robot or a task can be found, changed or struck out by its own line."""
    lines = dump_scenario(parse_scenario(TEXT)).splitlines()
    assert '  {id = "r1", type = "lift", start = [5.0, 3.0, 0.0]},' in lines
    assert sum(line.startswith('  {id = "t') for line in lines) == 2


@pytest.mark.parametrize("settings", [{"name": "x"}, {"table": {"a": 1}}, {"list": [1]}])
def test_settings_that_no_file_can_hold(settings: dict[str, Any]) -> None:
    """A setting is one plain value, so a file can carry it."""
    scenario = parse_scenario(TEXT)
    odd = Scenario("n", scenario.site, scenario.robot_types, scenario.robots, (), settings=settings)
    with pytest.raises(ValueError, match=r"system\."):
        dump_scenario(odd)


def test_schema_describes_keys_and_shows_a_working_example() -> None:
    """An editor can complete a file from the schema, and its example is itself a scenario."""
    schema = scenario_schema()
    assert schema["additionalProperties"] is False
    assert {"format", "site", "robot_types"} <= set(schema["required"])
    assert schema["anyOf"] == [{"required": ["robots"]}, {"required": ["fleets"]}]
    limits = schema["$defs"]["LimitsTable"]["properties"]
    assert limits["speed"]["exclusiveMinimum"] == 0.0
    assert "m/s" in limits["speed"]["description"]
    mode = schema["$defs"]["RobotTypeTable"]["properties"]["modes"]["items"]
    assert mode["enum"] == list(FOUR_WHEEL_MODES)
    example = schema["examples"][0]
    lines = [f"{key} = {_toml(value)}" for key, value in example.items()]
    assert parse_scenario("\n".join(lines)).name == example["name"]


def _toml(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k} = {_toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


printable = st.characters(exclude_categories=("C", "Z"), include_characters=" ")
names = st.text(printable, min_size=1, max_size=8).filter(lambda s: s.strip() != "")
metres = st.floats(-1e4, 1e4)
poses = st.builds(Pose, metres, metres, st.floats(-math.tau, math.tau))
seconds = st.floats(0.0, 1e6)
positive = st.floats(0.01, 50.0)


@st.composite
def boxes(draw: st.DrawFn) -> tuple[tuple[float, float], ...]:
    x, y = draw(st.integers(-999, 999)), draw(st.integers(-999, 999))
    w, h = draw(positive), draw(positive)
    return ((x, y), (x + w, y), (x + w, y + h), (x, y + h))


@st.composite
def footprints(draw: st.DrawFn) -> Footprint:
    if draw(st.booleans()):
        return Footprint(radius=draw(positive))
    sizes = st.tuples(st.floats(0.01, 40), st.floats(0.01, 40), st.floats(0, 40))
    parts = draw(st.lists(sizes, min_size=1, max_size=3))
    return Footprint(tuple(Footprint.rectangle(*size).parts[0] for size in parts))


batteries = st.builds(
    Battery, positive, st.floats(0, 0.9), positive, st.floats(0.9, 1.0, exclude_min=True)
)
blocks = st.lists(st.integers(1, 3), min_size=1, max_size=2).map(tuple)


@st.composite
def tasks_called(draw: st.DrawFn, name: str, ids: list[str], shelves: list[str]) -> Task:
    robot = draw(st.none() | st.sampled_from(ids))
    if shelves and draw(st.booleans()):
        return Task(name, (), robot, draw(st.sampled_from(shelves)))
    loads = draw(st.sampled_from([(None,), ("pick", "drop"), ("pick", None)]))
    return Task(name, tuple(Visit(name, draw(poses), draw(seconds), x) for x in loads), robot)


@st.composite
def simulations(draw: st.DrawFn, obstacles: st.SearchStrategy[Obstacle], site: Site) -> Simulation:
    kinds = sorted({zone.kind for zone in site.zones})
    has_shelf = bool(site.zones_of("shelf"))
    streams = []
    for name in draw(st.lists(names, max_size=2, unique=True)) if kinds else ():
        fetch = has_shelf and draw(st.booleans())
        draws = st.builds(Draw, st.sampled_from(kinds), seconds, st.sampled_from([None, "pick"]))
        often = {"open": 1} if draw(st.booleans()) else {"rate": draw(positive)}
        streams.append(
            OrderStream(
                name,
                draws=() if fetch else (draw(draws),),
                fetch=fetch,
                first=draw(seconds),
                last=draw(st.floats(1e6, 1e7, exclude_min=True)),
                due_after=draw(st.none() | seconds),
                priority=draw(metres),
                **often,
            )
        )
    share = st.floats(0.0, 1.0)
    return Simulation(
        draw(st.none() | positive),
        tuple(streams),
        draw(
            st.builds(
                Disturbances,
                seconds,
                st.just((1.0, 2.5)),
                share,
                st.floats(0.0, 1.0, exclude_min=True),
            )
        ),
        tuple(draw(st.lists(st.builds(Surprise, seconds, obstacles), max_size=2))),
    )


@st.composite
def scenarios(draw: st.DrawFn) -> Scenario:
    types = draw(
        st.lists(names.filter(lambda s: ":" not in s), min_size=1, max_size=3, unique=True)
    )
    ids = draw(st.lists(names, min_size=1, max_size=4, unique=True))
    optional = st.none() | positive
    kinds = {
        name: RobotType(
            name=name,
            footprint=draw(footprints()),
            kinematics="four_wheel",
            limits=Limits(draw(positive), draw(st.none() | st.floats(0, 50)), None, draw(optional)),
            loaded_footprint=draw(st.none() | footprints()),
            clearance=draw(st.floats(0, 1)),
            modes=tuple(draw(st.lists(st.sampled_from(FOUR_WHEEL_MODES), max_size=2))),
            mode_switch=draw(st.floats(0, 9)),
            capacity=draw(st.integers(1, 3)),
            capabilities=frozenset(draw(st.lists(names, max_size=2))),
            battery=draw(st.none() | batteries),
            motion=draw(st.sampled_from([None, "four_wheel"])),
        )
        for name in types
    }
    obstacles = st.one_of(
        st.builds(Obstacle, polygon=boxes(), blocks=st.just((f"{types[0]}:loaded",))),
        st.builds(Obstacle, disc=st.tuples(metres, metres, positive)),
        st.builds(Obstacle, wall=st.tuples(st.tuples(metres, metres), st.just((2e4, 0.0)))),
    )
    zones = tuple(
        Zone(name, kind, draw(boxes()), draw(poses), draw(st.none() | metres))
        for name, kind in zip(
            draw(st.lists(names, max_size=2, unique=True)), ("station", "shelf"), strict=False
        )
    )
    site = Site(draw(boxes()), tuple(draw(st.lists(obstacles, max_size=3))), zones, draw(borders))
    if draw(st.integers(0, 4)) == 0:
        site = site_of(Layout("bidirectional", draw(blocks), 1, draw(st.sampled_from([0.5, 1.0]))))
    shelves = [zone.name for zone in site.zones if zone.kind == "shelf"]
    tasks = draw(st.lists(names, max_size=3, unique=True))
    orders = tuple(
        Order(
            draw(tasks_called(name, ids, shelves)),
            draw(seconds),
            draw(st.none() | st.floats(1e6, 1e7)),
            draw(metres),
            tuple(tasks[:i][:2]),
        )
        for i, name in enumerate(tasks)
    )
    values = st.one_of(st.text(max_size=5), st.integers(-9, 9), metres, st.booleans())
    return Scenario(
        name=draw(names),
        site=site,
        robot_types=kinds,
        robots=tuple(
            Robot(i, draw(st.sampled_from(types)), draw(poses), energy=draw(st.floats(0, 1)))
            for i in ids
        ),
        orders=orders,
        system=draw(names),
        settings=draw(st.dictionaries(names.filter(lambda s: s != "name"), values, max_size=3)),
        seed=draw(st.integers(0, 2**63 - 1)),
        simulation=draw(simulations(obstacles, site)),
    )


borders = st.sampled_from(["closed", "open"])


@settings(max_examples=60, deadline=None)
@given(scenarios())
def test_any_scenario_survives_its_file(scenario: Scenario) -> None:
    """Numbers, odd names and absent keys come back to the last bit."""
    assert parse_scenario(dump_scenario(scenario)) == scenario
