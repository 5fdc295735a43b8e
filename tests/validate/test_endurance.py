"""What a run through time needs can be told before it begins."""

from dataclasses import replace

import pytest

from clearway.coordinate.once import Unsupported, plan_once
from clearway.model import (
    Battery,
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
    Zone,
)
from clearway.protocols import Budget
from clearway.systems.choose import choose_system
from clearway.validate.finding import Finding
from clearway.validate.legality import check_scenario
from clearway.world.channels import agv_type, site_of

ROOM = ((0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (0.0, 10.0))
CART = RobotType("cart", Footprint(radius=0.4), "holonomic", Limits(1.0))
CARRY = OrderStream("s", rate=60.0, draws=(Draw("station"),))
FETCH = OrderStream("f", rate=60.0, fetch=True)
PAPER = Layout("bidirectional")


def place(name: str, kind: str, x: float, y: float = 5.0) -> Zone:
    corners = ((x - 0.5, y - 0.5), (x + 0.5, y - 0.5), (x + 0.5, y + 0.5), (x - 0.5, y + 0.5))
    return Zone(name, kind, corners, Pose(x, y, 0.0))


def room(
    *zones: Zone,
    robots: int = 1,
    kind: RobotType = CART,
    energy: float = 1.0,
    until: float = 3600.0,
    **more: object,
) -> Scenario:
    fleet = tuple(
        Robot(f"r{i + 1}", "cart", Pose(1.0 + i, 1.0, 0.0), energy=energy) for i in range(robots)
    )
    simulation = Simulation(until, (CARRY,))
    site = Site(ROOM, (), (place("dock", "station", 20.0), *zones))
    return replace(Scenario("room", site, {"cart": kind}, fleet, (), simulation=simulation), **more)


def warehouse(*starts: Pose, **more: object) -> Scenario:
    kind = agv_type(PAPER)
    robots = tuple(Robot(f"agv-{i + 1}", "agv", start) for i, start in enumerate(starts))
    simulation = Simulation(3600.0, (FETCH,))
    made = Scenario("b", site_of(PAPER), {"agv": kind}, robots, (), simulation=simulation)
    return replace(made, **more)


def told(scenario: Scenario) -> list[Finding]:
    return list(check_scenario(scenario).findings)


def bays(count: int) -> list[Zone]:
    return [place(f"b{i}", "parking", 1.0 + i, 9.0) for i in range(count)]


def test_nothing_is_said_of_a_scenario_that_is_planned_once() -> None:
    """Three robots without bays and chargers may still be asked to do their tasks."""
    drained = replace(CART, battery=Battery(100.0))
    assert told(room(robots=3, kind=drained, simulation=Simulation())) == []


def test_a_fleet_larger_than_its_parking_room() -> None:
    """Three robots, two bays: one has nowhere to rest. A third bay mends it."""
    (finding,) = told(room(*bays(2), robots=3))
    assert (finding.kind, finding.severity) == ("few_bays", "warning")
    assert "3 robots have 2 places to rest in" in finding.text
    assert "so 1 may have to stay" in finding.text
    assert told(room(*bays(3), robots=3)) == []


def test_shelves_are_room_to_rest_for_those_who_move_them() -> None:
    """In the paper's warehouse robots idle under shelves, of which there are 406."""
    assert told(warehouse(Pose(3.5, 2.5, 0.0), Pose(4.5, 2.5, 0.0))) == []


def chargers(count: int) -> list[Zone]:
    return [place(f"c{i}", "charger", 1.0 + i, 7.0) for i in range(count)]


def test_chargers_that_cannot_sustain_the_fleet_are_told_with_the_arithmetic() -> None:
    """20 robots, 5000 s a charge: 0.4 %/s. One charger of 500 s gives 0.2 %/s, two give 0.4."""
    agv = replace(CART, battery=Battery(5000.0, charging=500.0))
    run = {"robots": 20, "kind": agv, "until": 36_000.0}
    (finding,) = told(room(*bays(20), *chargers(1), **run))
    assert (finding.kind, finding.severity) == ("few_chargers", "warning")
    assert "20 robots at most drain 20 x 1/5000 s = 0.4 %/s" in finding.text
    assert "1 charger gives 1 x 1/500 s = 0.2 %/s; add 1 charger," in finding.text
    assert told(room(*bays(20), *chargers(2), **run)) == []
    (finding,) = told(room(*bays(20), **run))
    assert "0 chargers give 0 x 1/500 s = 0 %/s; add 2 chargers" in finding.text


def test_a_run_that_ends_before_batteries_do_needs_no_charger() -> None:
    """A full battery of 5000 s is at its reserve of 0.2 after 4000 s; at 0.9, after 3500 s."""
    agv = replace(CART, battery=Battery(5000.0))
    assert told(room(*bays(1), kind=agv, until=4000.0)) == []
    assert [f.kind for f in told(room(*bays(1), kind=agv, until=4001.0))] == ["few_chargers"]
    assert [f.kind for f in told(room(*bays(1), kind=agv, energy=0.9, until=3600.0))] == [
        "few_chargers"
    ]


def test_zones_that_nobody_can_come_to() -> None:
    """A wall cuts the room: the dock that orders ask for is an error, a charger a warning."""
    cut = room(*bays(1), place("c", "charger", 30.0))
    wall = Obstacle(wall=((15.0, 0.0), (15.0, 10.0)))
    cut = replace(cut, site=replace(cut.site, obstacles=(wall,)))
    dock, charger = told(cut)
    assert (dock.kind, dock.severity, dock.key) == ("unreachable", "error", "site.zones[0].pose")
    assert "no robot can come to station dock" in dock.text
    assert (charger.severity, charger.key) == ("warning", "site.zones[2].pose")


def test_a_shelf_that_nobody_can_come_to() -> None:
    """Nobody reaches the order that fetches it, and the shelf is named."""
    cut = room(*bays(1), place("g1", "shelf", 30.0), place("g2", "shelf", 10.0))
    wall = Obstacle(wall=((25.0, 0.0), (25.0, 10.0)))
    orders = tuple(Order(Task(f"o{k}", (), None, f"g{k}")) for k in (1, 2))
    cut = replace(cut, site=replace(cut.site, obstacles=(wall,)), orders=orders)
    legality = check_scenario(cut)
    assert [finding.text.split(";")[0] for finding in legality.errors] == [
        "no robot can come to shelf g1"
    ]
    assert legality.reachable == {"r1": {"o2"}}


def test_a_shelf_needs_a_robot_that_carries() -> None:
    """A type of capacity 0 fetches nothing."""
    idle = replace(CART, capacity=0)
    orders = (Order(Task("o", (), None, "g1")),)
    findings = told(room(*bays(1), place("g1", "shelf", 10.0), kind=idle, orders=orders))
    assert [(finding.kind, finding.key) for finding in findings] == [("no_robot", "tasks[0]")]


@pytest.mark.parametrize(
    ("starts", "kind", "text"),
    [
        ((Pose(1.5, 5.5, 0.0),), "start_off_place", "agv-1 starts in no place of the layout"),
        (
            (Pose(3.5, 2.5, 0.0), Pose(3.6, 2.5, 0.0)),
            "starts_overlap",
            "agv-1 and agv-2 both start in g1",
        ),
    ],
)
def test_starts_that_no_layout_has(starts: tuple[Pose, ...], kind: str, text: str) -> None:
    """A robot in a channel stands in everybody's way; two in one place stand in each other."""
    findings = [f for f in told(warehouse(*starts)) if text in f.text]
    assert [(finding.kind, finding.severity) for finding in findings] == [(kind, "error")]


def test_what_comes_after_the_end_is_told() -> None:
    """Orders, streams and surprises at or after the last second do not happen."""
    made = room(*bays(1), until=100.0)
    dock = place("g", "shelf", 10.0)
    orders = tuple(Order(Task(f"o{k}", (), None, "g"), 50.0 * k) for k in range(9))
    late = replace(
        made,
        site=replace(made.site, zones=(*made.site.zones, dock)),
        orders=orders,
        simulation=Simulation(
            100.0,
            (replace(CARRY, first=100.0),),
            surprises=(Surprise(100.0, Obstacle(disc=(30.0, 5.0, 1.0))),),
        ),
    )
    assert [(finding.kind, finding.key) for finding in told(late)] == [
        ("too_late", "simulation.until"),
        ("too_late", "simulation.streams[0].first"),
        ("too_late", "simulation.surprises[0].at"),
    ]
    assert (
        "7 orders are released after the run ends (o2, o3, o4, o5, o6, ...)" in told(late)[0].text
    )


def test_a_shelf_is_not_fetched_by_planning_once() -> None:
    """Where to bring it is chosen while it runs, so planning once says no, with the task."""
    orders = (Order(Task("o7", (), None, "g1")),)
    made = room(place("g1", "shelf", 10.0), orders=orders, simulation=Simulation())
    with pytest.raises(Unsupported, match="task o7 fetches a shelf"):
        plan_once(made, choose_system(made), Budget(), 0)


def test_a_run_without_any_orders_is_told() -> None:
    bay = place("bay", "parking", 30.0)
    idle = room(bay, simulation=Simulation(60.0))
    assert [(f.kind, f.severity) for f in check_scenario(idle).findings] == [("no_work", "warning")]
    assert check_scenario(room(bay)).findings == ()


def test_shelves_of_a_layout_are_room_to_rest_before_anything_is_fetched() -> None:
    site, kind = site_of(PAPER), agv_type(PAPER)
    start = site.zones_of("shelf")[0].pose
    assert start is not None
    simulation = Simulation(60.0)
    idle = Scenario(
        "b", site, {"agv": kind}, (Robot("r1", "agv", start),), (), simulation=simulation
    )
    assert [finding.kind for finding in check_scenario(idle).findings] == ["no_work"]


def test_zones_under_an_obstacle_that_comes_to_light() -> None:
    """Named where a body cannot stand there; beside it, or after the end, all is well."""
    bay = place("bay", "parking", 30.0)

    def found(at: float, x: float) -> list[Finding]:
        surprise = Surprise(at, Obstacle(disc=(x, 5.0, 0.5)))
        simulation = Simulation(60.0, (CARRY,), surprises=(surprise,))
        return list(check_scenario(room(bay, simulation=simulation)).findings)

    (finding,) = found(20.0, 19.2)  # 0.8 m from the middle, of a body of 0.4 m
    assert (finding.kind, finding.severity) == ("covered", "warning")
    assert finding.key == "simulation.surprises[0]"
    assert "covers dock from 20 s on" in finding.text
    assert found(20.0, 19.0) == []
    assert [finding.kind for finding in found(60.0, 20.0)] == ["too_late"]


def test_an_obstacle_that_is_there_from_the_start_is_on_nobody() -> None:
    bay = place("bay", "parking", 30.0)

    def found(at: float) -> list[Finding]:
        surprise = Surprise(at, Obstacle(disc=(1.0, 1.0, 0.5)))
        simulation = Simulation(60.0, (CARRY,), surprises=(surprise,))
        return list(check_scenario(room(bay, simulation=simulation)).findings)

    (finding,) = found(0.0)
    assert (finding.kind, finding.severity) == ("start_in_obstacle", "error")
    assert finding.robots == ("r1",)
    assert found(1.0) == []
