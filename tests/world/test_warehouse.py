"""The reference sites are what the text says they are, and their scenarios can be solved."""

import itertools
import math
from pathlib import Path

import pytest
import shapely

from clearway.formats.scenario_file import dump_scenario, read_scenario
from clearway.model import Pose, Scenario
from clearway.validate.legality import check_scenario
from clearway.world.shapes import body_shape
from clearway.world.warehouse import (
    four_wheel_carrier,
    random_warehouse,
    random_yard,
    tight_room,
    warehouse_site,
)

SHELF = 35.0 * 1.5
MADE = {
    "warehouse-8x24": ("random_warehouse(8, 24, seed=0)", lambda: random_warehouse(8, 24, 0)),
    "warehouse-16x48": ("random_warehouse(16, 48, seed=0)", lambda: random_warehouse(16, 48, 0)),
    "yard-30": ("random_yard(30, seed=0)", lambda: random_yard(30, 0)),
    "tight-room": ("tight_room()", tight_room),
}


def floor(pose: Pose) -> shapely.Polygon:
    return body_shape(four_wheel_carrier().footprint, pose).geometry


def goals(scenario: Scenario) -> list[Pose]:
    return [order.task.visits[-1].pose for order in scenario.orders]


def least_gap(poses: list[Pose], others: list[Pose] | None = None) -> float:
    pairs = itertools.combinations(poses, 2) if others is None else itertools.product(poses, others)
    return min(floor(a).distance(floor(b)) for a, b in pairs)


def test_eighteen_shelves_and_their_aisles() -> None:
    """Shelves of 35 m x 1.5 m leave aisles of 4.5 m between them and of 5.25 m at the ends."""
    site = warehouse_site()
    shelves = [shapely.Polygon(obstacle.polygon) for obstacle in site.obstacles]
    assert [shelf.area for shelf in shelves] == pytest.approx([SHELF] * 18)
    assert {shelf.bounds[0] for shelf in shelves} == {10.0, 55.0}
    column = sorted(shelf.bounds[1::2] for shelf in shelves if shelf.bounds[0] == 10.0)
    gaps = [low[0] - high[1] for high, low in itertools.pairwise(column)]
    assert gaps == pytest.approx([4.5] * 8)
    assert (column[0][0], 60.0 - column[-1][1]) == pytest.approx((5.25, 5.25))


def test_bodies_in_all_bays_leave_lanes_of_four_metres() -> None:
    """With all 53 bays taken, strips 4 m wide run through every cross aisle, two in the middle."""
    site = warehouse_site(53)
    assert len(site.zones_of("parking")) == 53
    poses = [zone.pose for zone in site.zones if zone.pose is not None]
    assert least_gap(poses) >= 0.4 - 1e-9
    taken = shapely.union_all([floor(pose) for pose in poses])
    for x in (4.0, 45.0, 51.0, 92.0):
        lane = shapely.box(x, 0.0, x + 4.0, 60.0)
        assert lane.intersection(taken).area < 1e-9
    assert shapely.Polygon(site.bounds).buffer(-0.19).covers(taken)


def test_a_few_bays_are_spread_out() -> None:
    """The first five bays are those in the four corners and the one in the middle."""
    poses = [zone.pose for zone in warehouse_site(8).zones if zone.pose is not None]
    places = {(round(pose.x), round(pose.y)) for pose in poses[:5]}
    assert places == {(2, 2), (98, 2), (2, 58), (98, 58), (50, 30)}
    assert min(a.distance(b) for a, b in itertools.combinations(poses, 2)) > 12.0


def test_no_more_bays_than_there_are() -> None:
    """Bays beyond the 53rd are refused with the number that there are."""
    with pytest.raises(ValueError, match="0 to 53"):
        warehouse_site(54)


@pytest.mark.parametrize(
    ("robots", "tasks", "seed"), [(4, 16, 0), (8, 24, 1), (16, 48, 2), (60, 120, 3)]
)
def test_warehouse_scenarios_leave_the_gaps_they_promise(
    robots: int, tasks: int, seed: int
) -> None:
    """Any two tasks can be done at once, idle robots and full bays are in nobody's way."""
    scenario = random_warehouse(robots, tasks, seed)
    starts = [robot.start for robot in scenario.robots]
    bays = [zone.pose for zone in scenario.site.zones if zone.pose is not None]
    assert (len(starts), len(goals(scenario)), len(bays)) == (robots, tasks, min(robots, 53))
    assert least_gap(goals(scenario)) >= 0.3 - 1e-9
    assert least_gap(starts) >= 0.5 - 1e-9
    assert least_gap(starts, bays) >= 0.5 - 1e-9
    assert least_gap(goals(scenario), starts + bays) >= 0.3
    legality = check_scenario(scenario)
    assert legality.findings == ()
    assert min(legality.clearances.values()) >= 0.1
    assert all(len(reached) == tasks for reached in legality.reachable.values())
    for pose in goals(scenario):
        assert (pose.x % 1.0, pose.y % 1.0) == (0.5, 0.5)
        assert any(pose.theta == k * math.pi / 2.0 for k in (-1, 0, 1, 2))


def test_a_hundred_robots_in_the_same_warehouse() -> None:
    """With eight bays a hundred robots find a legal start."""
    scenario = random_warehouse(100, 100, 0, bays=8)
    assert check_scenario(scenario).findings == ()
    with pytest.raises(ValueError, match="fit into the warehouse"):
        random_warehouse(500, 4, 0)


@pytest.mark.parametrize("seed", range(3))
def test_in_the_yard_a_robot_can_go_round_everything(seed: int) -> None:
    """Obstacles are farther apart, and farther from the border, than a turning body is wide."""
    scenario = random_yard(30, seed)
    assert [order.task.robot for order in scenario.orders] == [r.id for r in scenario.robots]
    legality = check_scenario(scenario)
    assert legality.findings == ()
    assert min(legality.clearances.values()) >= 0.29
    shapes = [
        shapely.Point(o.disc[:2]).buffer(o.disc[2])
        if o.disc
        else shapely.Polygon(o.polygon)
        if o.polygon
        else shapely.LineString(o.wall)
        for o in scenario.site.obstacles
    ]
    assert len(shapes) == 27
    turning = math.hypot(3.0, 2.0)
    assert min(a.distance(b) for a, b in itertools.combinations(shapes, 2)) > turning + 0.2
    border = shapely.Polygon(scenario.site.bounds).exterior
    assert min(border.distance(shape) for shape in shapes) > turning + 0.2
    assert least_gap([robot.start for robot in scenario.robots]) > 2.2
    assert least_gap(goals(scenario)) > 2.2


def test_the_tight_room_has_a_way() -> None:
    """The way told in words keeps 0.3 m from walls and other robots at every step of 0.1 m."""
    scenario = tight_room()
    at = {robot.id: robot.start for robot in scenario.robots}
    legs = [
        ("r2", (33.8, 1.6), (33.8, -1.5)),
        ("r1", (33.8, 1.6), (33.8, 5.5)),
        ("r3", (30.0, 1.6), (1.8, 1.6)),
        ("r4", (30.0, 1.6), (5.4, 1.6)),
    ]
    rim = shapely.Polygon(scenario.site.bounds).exterior
    for robot, *corners in legs:
        for corner in corners:
            here = at[robot]
            steps = math.ceil(math.dist(here[:2], corner) / 0.1)
            for k in range(1, steps + 1):
                x = here.x + (corner[0] - here.x) * k / steps
                y = here.y + (corner[1] - here.y) * k / steps
                at[robot] = Pose(x, y, 0.0)
                body = floor(at[robot])
                others = [floor(pose) for name, pose in at.items() if name != robot]
                assert min(body.distance(shape) for shape in [rim, *others]) > 0.29
    ends = {order.task.robot: order.task.visits[0].pose for order in scenario.orders}
    for robot, pose in at.items():
        assert pose == pytest.approx(ends[robot])


def test_in_the_tight_room_nobody_overtakes() -> None:
    """The corridor is less than two bodies wide, so those inside must leave first."""
    scenario = tight_room()
    assert check_scenario(scenario).findings == ()
    rim = shapely.Polygon(scenario.site.bounds)
    assert not rim.contains(shapely.box(5.0, 0.1, 6.0, 4.1))
    inside = [robot.start for robot in scenario.robots if robot.start.x < 24.0]
    entering = [order.task.visits[0].pose for order in scenario.orders][2:]
    assert inside == entering


def test_seeds_repeat_and_differ() -> None:
    """The same seed gives the same scenario, another seed another one."""
    assert random_warehouse(4, 8, 5) == random_warehouse(4, 8, 5)
    assert random_warehouse(4, 8, 5).robots != random_warehouse(4, 8, 6).robots
    assert random_yard(5, 5) == random_yard(5, 5)


@pytest.mark.parametrize("name", sorted(MADE))
def test_ready_made_scenarios_are_what_their_first_line_says(name: str) -> None:
    """Each file in scenarios/ can be made again, byte for byte, by the call it names."""
    call, make = MADE[name]
    path = Path(__file__).parents[2] / "scenarios" / f"{name}.toml"
    comment = f"Made by clearway.world.warehouse.{call}."
    assert path.read_text(encoding="utf-8") == dump_scenario(make(), comment)
    assert read_scenario(path) == make()
