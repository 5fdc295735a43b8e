"""Scenario files that run through time: layouts, fleets, streams, and what is wrong with them."""

import re
from itertools import pairwise

import pytest

from clearway.formats.scenario_file import ScenarioError, dump_scenario, parse_scenario
from clearway.model import (
    Battery,
    Disturbances,
    Draw,
    Layout,
    Obstacle,
    OrderStream,
    Pose,
    Robot,
    Simulation,
    Surprise,
)
from clearway.world.channels import PAPER, agv_type, site_of

GOOD = """\
format = "clearway.scenario/1"
name = "warehouse"
[site]
layout = {rule = "bidirectional", blocks = [9, 9, 11], bands = 7}
[robot_types.agv]
kinematics = "differential"
footprint = [[0.35, 0.35], [-0.35, 0.35], [-0.35, -0.35], [0.35, -0.35]]
limits = {speed = 1.0, reverse_speed = 0.0}
battery = {capacity = 5000.0, charging = 500.0, full = 0.95}
[[fleets]]
name = "agv"
type = "agv"
count = 20
at = "shelf"
row = 2
energy = [0.15, 1.0]
[[robots]]
id = "spare"
type = "agv"
start = [3.5, 30.5, 0.0]
energy = 0.0
[[tasks]]
id = "t1"
fetches = "g7"
release = 5.0
[system]
name = "bidirectional"
[simulation]
until = 3600.0
disturbances = {stops_per_hour = 4.0, stop_seconds = [2.0, 8.0], slow = 0.25, slowness = 0.5}
surprises = [{at = 60.0, disc = [12.0, 3.0, 0.4], blocks = ["agv:loaded"]}]
[[simulation.streams]]
name = "shelves"
rate = 400.0
fetch = true
due_after = 300.0
[[simulation.streams]]
name = "carts"
open = 3
visits = [{kind = "shelf", load = "pick"}, {kind = "station", service = 5.0, load = "drop"}]
first = 10.0
last = 50.0
priority = 2.0
"""


def test_every_key_becomes_its_noun() -> None:
    """What happens is told by streams, disturbances and surprises."""
    scenario = parse_scenario(GOOD)
    assert scenario.site == site_of(PAPER)
    assert scenario.robot_types == {"agv": agv_type(PAPER)}
    assert scenario.robot_types["agv"].battery == Battery(5000.0, 0.2, 500.0, 0.95)
    (order,) = scenario.orders
    assert (order.task.fetches, order.task.visits, order.release) == ("g7", (), 5.0)
    draws = (Draw("shelf", 0.0, "pick"), Draw("station", 5.0, "drop"))
    assert scenario.simulation == Simulation(
        3600.0,
        (
            OrderStream("shelves", 400.0, fetch=True, due_after=300.0),
            OrderStream("carts", open=3, draws=draws, first=10.0, last=50.0, priority=2.0),
        ),
        Disturbances(4.0, (2.0, 8.0), 0.25, 0.5),
        (Surprise(60.0, Obstacle(disc=(12.0, 3.0, 0.4), blocks=("agv:loaded",))),),
    )


def test_it_is_written_and_read_again() -> None:
    """The layout stays a layout; the fleet is written robot by robot."""
    scenario = parse_scenario(GOOD)
    text = dump_scenario(scenario)
    assert parse_scenario(text) == scenario
    assert 'layout = {rule = "bidirectional"' in text
    assert "zones" not in text


def test_a_layout_that_was_changed_cannot_be_written() -> None:
    """Its file would read as the unchanged site, so it is refused."""
    scenario = parse_scenario(GOOD)
    zones = scenario.site.zones[1:]
    changed = type(scenario.site)(scenario.site.bounds, (), zones, layout=Layout("bidirectional"))
    with pytest.raises(ValueError, match="not what its layout makes"):
        dump_scenario(type(scenario)("n", changed, scenario.robot_types, scenario.robots, ()))


def test_a_fleet_spreads_evenly_over_its_row() -> None:
    """Row 2 has shelves at x = 3 to 11, 14 to 22 and 25 to 35; robots of 20 stand in 20 of them."""
    spare, *fleet = parse_scenario(GOOD).robots
    assert spare == Robot("spare", "agv", Pose(3.5, 30.5, 0.0), energy=0.0)
    assert [robot.id for robot in fleet] == [f"agv-{k}" for k in range(1, 21)]
    columns = [int(robot.start.x) for robot in fleet]
    assert columns == sorted(set(columns))
    assert all(robot.start.y == 2.5 for robot in fleet)
    # The first half of the robots stands in the first half of the 29 places.
    places = [*range(3, 12), *range(14, 23), *range(25, 36)]
    at = [places.index(column) for column in columns]
    gaps = [b - a for a, b in pairwise(at)]
    assert set(gaps) == {1, 2}
    assert at[0] + at[-1] == 28
    # Energy rises evenly from the first to the last.
    assert [fleet[0].energy, fleet[-1].energy] == [0.15, 1.0]
    assert fleet[1].energy - fleet[0].energy == pytest.approx(0.85 / 19.0)


def test_a_second_fleet_takes_what_the_first_left() -> None:
    """33 chargers hold fleets of 20 and 13, and no third one."""
    more = "\n".join(
        f'[[fleets]]\nname = "{name}"\ntype = "agv"\ncount = {count}\nat = "charger"'
        for name, count in (("a", 20), ("b", 13), ("c", 1))
    )
    text = re.sub(r"\[\[robots\]\](.|\n)*?(?=\[\[tasks)", "", GOOD)
    two = parse_scenario(text + more[: more.rindex("[[fleets]]")])
    starts = [robot.start for robot in two.robots if not robot.id.startswith("agv")]
    assert len(set(starts)) == 33
    with pytest.raises(ScenarioError, match=r"fleets\[3\].count: is more than the 0 free zones"):
        parse_scenario(text + more)


# (what stands in the good file, what replaces it, key, value or "", part of the mend)
BAD = [
    # site
    ('"bidirectional", b', '"bidirectionel", b', "site.layout.rule", "'bidirectionel'", "tional'?"),
    ("bands = 7", "bands = 0", "site.layout.bands", "0", "greater than or equal to 1"),
    ("bands = 7", "bands = 5000", "site.layout.bands", "5000", "1000"),
    ("[9, 9, 11], bands = 7", "[900, 900], bands = 900", "site.layout.bands", "900", "lower bands"),
    ("[9, 9, 11]", "[]", "site.layout.blocks", "[]", "add an entry"),
    ("bands = 7}", "bands = 7}\nzones = []", "site.zones", "[]", "drop zones"),
    ("bands = 7}", "bands = 7}\nborder = 'open'", "site.border", "'open'", "drop border"),
    (
        "bands = 7}",
        "bands = 7}\nbounds = [[0, 0], [9, 0], [9, 9]]",
        "site",
        "'layout'",
        "keep one of bounds, layout",
    ),
    # fleet
    ("count = 20", "count = 30", "fleets[0].count", "30", "lower count"),
    ("count = 20", "count = 0", "fleets[0].count", "0", "greater than or equal to 1"),
    ('at = "shelf"', 'at = "shelve"', "fleets[0].at", "'shelve'", "did you mean 'shelf'?"),
    ('at = "shelf"', 'at = "parking"', "fleets[0].count", "20", "other zones by at and row"),
    ('name = "agv"\ntype', 'name = "agv"\ntipe', "fleets[0].tipe", "'agv'", "'type'?"),
    ('type = "agv"\ncount', 'type = "agw"\ncount', "fleets[0].type", "'agw'", "'agv'?"),
    ("[0.15, 1.0]", "[0.15, 1.5]", "fleets[0].energy[1]", "1.5", "less than or equal to 1"),
    ("[0.15, 1.0]", "[0.1, 0.2, 0.3]", "fleets[0].energy", "0.3", "at most 2"),
    ('id = "spare"', 'id = "agv-4"', "fleets[0].name", "'agv'", "its own name"),
    ("energy = 0.0", "energy = -0.1", "robots[0].energy", "-0.1", "greater than or equal to 0"),
    ("full = 0.95", "full = 0.1", "robot_types.agv.battery.full", "0.1", "room between"),
    ("full = 0.95", "reserve = 0.96", "robot_types.agv.battery.reserve", "0.96", "room between"),
    ("charging = 500.0", "charging = 0", "robot_types.agv.battery.charging", "0", "greater than 0"),
    # work
    ('fetches = "g7"', 'fetches = "g77x"', "tasks[0].fetches", "'g77x'", "did you mean 'g77'?"),
    ('fetches = "g7"', 'fetches = "p7"', "tasks[0].fetches", "'p7'", "known: g1"),
    ("release = 5.0", "service = 5.0", "tasks[0].service", "5.0", "drop service"),
    ("release = 5.0", 'station = "p1"', "tasks[0]", "'fetches'", "keep one of"),
    # simulation
    ("until = 3600.0", "until = -5", "simulation.until", "-5", "greater than 0"),
    ("until = 3600.0\n", "", "simulation.streams[0]", "'shelves'", "add until"),
    ("until = 3600.0", "untill = 3600.0", "simulation.untill", "3600.0", "'until'?"),
    ("rate = 400.0", "rate = 0", "simulation.streams[0].rate", "0", "greater than 0"),
    ("rate = 400.0", "", "simulation.streams[0]", "[]", "add one of rate, open"),
    ("rate = 400.0", "rate = 4.0\nopen = 3", "simulation.streams[0]", "'open'", "keep one of rate"),
    ("rate = 400.0", "open = 407", "simulation.streams[0].open", "407", "lower open"),
    ("fetch = true", "fetch = false", "simulation.streams[0].fetch", "False", "list visits"),
    ("fetch = true", "", "simulation.streams[0]", "[]", "add one of visits, fetch"),
    ('name = "carts"', 'name = "shelves"', "simulation.streams[1].name", "'shelves'", "its own"),
    ("last = 50.0", "last = 10.0", "simulation.streams[1].last", "10.0", "later than first"),
    (
        'kind = "station"',
        'kind = "parking"',
        "simulation.streams[1].visits[1].kind",
        "'parking'",
        "charger, shelf, station",
    ),
    (
        'load = "pick"}',
        'load = "drop"}',
        "simulation.streams[1].visits[0].load",
        "'drop'",
        "'pick' before",
    ),
    (
        'load = "drop"}]',
        'load = "pick"}]',
        "simulation.streams[1].visits[1].load",
        "'pick'",
        "raise capacity",
    ),
    ("[2.0, 8.0]", "[8.0, 2.0]", "simulation.disturbances.stop_seconds", "8.0", "longest]"),
    ("slow = 0.25", "slow = 25", "simulation.disturbances.slow", "25", "less than or equal to 1"),
    ("slowness = 0.5", "slowness = 0", "simulation.disturbances.slowness", "0", "greater than 0"),
    ("at = 60.0, ", "", "simulation.surprises[0].at", "", "add at"),
    ("disc = [12.0, 3.0, 0.4], ", "", "simulation.surprises[0]", "[]", "add one of polygon"),
    ("agv:loaded", "agw", "simulation.surprises[0].blocks[0]", "'agw'", "'agv'?"),
    # order files
    ('name = "warehouse"', 'name = "w"\norders = 5', "orders[0]", "5", "in quotes"),
]


@pytest.mark.parametrize(("old", "new", "key", "value", "mend"), BAD)
def test_message_names_key_value_and_mend(
    old: str, new: str, key: str, value: str, mend: str
) -> None:
    """Whoever reads the message knows where to look and what to write instead."""
    assert GOOD.count(old) >= 1
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(GOOD.replace(old, new, 1), "w.toml")
    error, message = caught.value, str(caught.value)
    assert message.startswith(f"w.toml: {key}: ")
    assert mend in (error.mend or "")
    assert value in (f"{error.value!r}" if value else "")


def test_what_a_rule_cannot_make_is_told_by_its_key() -> None:
    """One-way channels need an odd number of bands, or the outer ones are no loop."""
    text = GOOD.replace('"bidirectional", b', '"compact", b').replace("bands = 7", "bands = 4")
    with pytest.raises(ScenarioError, match=r"site\.layout\.bands: .*odd number.*; add one"):
        parse_scenario(text)


def test_rows_belong_to_layouts() -> None:
    """Where there are no cells, there is no row of them."""
    site = (
        "bounds = [[0, 0], [9, 0], [9, 9], [0, 9]]\nzones = [{name = 'b', kind = 'parking', "
        "polygon = [[1, 1], [2, 1], [2, 2]], pose = [1.5, 1.5, 0]}]"
    )
    head = GOOD[: GOOD.index("[[robots]]")].replace('at = "shelf"', 'at = "parking"')
    head = head.replace("count = 20", "count = 1")
    text = re.sub(r"layout = .*", site, head)
    with pytest.raises(ScenarioError, match=r"fleets\[0\]\.row: is a row of no layout"):
        parse_scenario(text)
    (robot,) = parse_scenario(text.replace("row = 2\n", "")).robots
    assert robot.start == (1.5, 1.5, 0.0)
