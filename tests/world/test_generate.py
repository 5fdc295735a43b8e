"""Generated instances are legal, leave room to move, and repeat."""

import itertools
import math
import time
from random import Random

import numpy as np
import pytest
import shapely

from clearway.formats.scenario_dump import dump_scenario
from clearway.formats.scenario_file import parse_scenario
from clearway.model import Footprint, Obstacle, Pose, Scenario, Site
from clearway.validate.legality import check_scenario
from clearway.world.fleets import CAR, CARRIER, FLEETS, lanes_of
from clearway.world.generate import generate
from clearway.world.passages import Passages
from clearway.world.shapes import body_shape, obstacle_shape
from clearway.world.sites import KINDS, covered
from clearway.world.standing import Standing


def goals(scenario: Scenario) -> list[Pose]:
    return [order.task.visits[0].pose for order in scenario.orders]


def starts(scenario: Scenario) -> list[Pose]:
    return [robot.start for robot in scenario.robots]


def least_gap(scenario: Scenario, poses: list[Pose]) -> float:
    bodies = [
        body_shape(scenario.type_of(robot).footprint, pose)
        for robot, pose in zip(scenario.robots, poses, strict=True)
    ]
    return min(a.gap(b) for a, b in itertools.combinations(bodies, 2))


def free_floor(site: Site) -> shapely.Geometry:
    solid = [obstacle_shape(obstacle) for obstacle in site.obstacles]
    return shapely.Polygon(site.bounds).difference(
        shapely.union_all([shape.geometry.buffer(shape.radius) for shape in solid])
    )


@pytest.mark.parametrize(
    ("kind", "fleet"), list(itertools.product(KINDS, ("cars", "carriers", "mixed")))
)
def test_every_kind_takes_every_fleet(kind: str, fleet: str) -> None:
    """No finding; 0.1 m to what stands, 0.3 m to each other; each robot a goal far away."""
    scenario = generate(kind, robots=15, size=(70.0, 50.0), fleet=fleet, seed=3)
    legality = check_scenario(scenario)
    assert legality.findings == ()
    assert min(legality.clearances.values()) >= 0.1
    assert least_gap(scenario, starts(scenario)) >= 0.3
    assert least_gap(scenario, goals(scenario)) >= 0.3
    assert [order.task.robot for order in scenario.orders] == [r.id for r in scenario.robots]
    assert {robot.type for robot in scenario.robots} == {kind.name for kind in FLEETS[fleet]}
    sides = np.ptp(np.array(scenario.site.bounds), axis=0)
    for start, goal in zip(starts(scenario), goals(scenario), strict=True):
        assert start.distance(goal) >= sides.max() / 4.0
    assert parse_scenario(dump_scenario(scenario)) == scenario


@pytest.mark.parametrize("fleet", ["forklifts", "shuttles", "differentials", "holonomics"])
def test_a_fleet_may_be_of_one_type(fleet: str) -> None:
    """The lanes follow the type, so small robots get narrow ones."""
    scenario = generate("shelves", robots=8, size=(40.0, 30.0), fleet=fleet, seed=1)
    assert [kind.name for kind in FLEETS[fleet]] == list(scenario.robot_types)
    assert check_scenario(scenario).findings == ()


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_car_can_drive_off_from_its_start_and_up_to_its_goal(kind: str) -> None:
    """Two metres straight ahead or straight back, tried every 10 cm, keep it on the free floor."""
    scenario = generate(kind, robots=20, size=(80.0, 60.0), seed=4)
    floor = free_floor(scenario.site)
    shapely.prepare(floor)
    for pose in starts(scenario) + goals(scenario):
        ways = [
            [pose.compose(Pose(sign * k / 10.0, 0.0, 0.0)) for k in range(21)] for sign in (1, -1)
        ]
        assert any(
            all(floor.covers(body_shape(CAR.footprint, at).geometry) for at in way) for way in ways
        )


@pytest.mark.parametrize("kind", ["rooms", "corridors"])
def test_no_standing_car_closes_a_way(kind: str) -> None:
    """With all cars at their goals a disc as wide as a car still gets through every door."""
    scenario = generate(kind, robots=25, size=(80.0, 60.0), seed=5)
    bodies = [body_shape(CAR.footprint, pose).geometry for pose in goals(scenario)]
    floor = free_floor(scenario.site)
    alone = floor.buffer(-1.0)
    among = floor.difference(shapely.union_all(bodies)).buffer(-1.0)
    assert alone.geom_type == "Polygon"
    # Crumbs beside a body, too small for a passage, are no way that was closed.
    pieces = [piece for piece in shapely.get_parts(among) if piece.area > 1.0]
    assert len(pieces) == 1


def test_a_car_across_a_narrow_corridor_could_never_leave() -> None:
    """Across 4 m a body of 3 m has 1 m of way; a carrier leaves sideways, a car does not."""
    standing = Standing(Site(((0.0, 0.0), (40.0, 0.0), (40.0, 4.0), (0.0, 4.0))))
    across, along = [20.0, 1.5, math.pi / 2.0], [20.0, 2.0, 0.0]
    assert standing.allows(CAR, np.array([across, along])).tolist() == [False, True]
    middle = [20.0, 2.0, math.pi / 2.0]
    assert standing.allows(CARRIER, np.array([middle, along])).tolist() == [True, True]
    nose_at_wall, touching = [37.8, 2.0, 0.0], [37.95, 2.0, 0.0]
    assert standing.allows(CAR, np.array([nose_at_wall, touching])).tolist() == [True, False]


def test_a_body_across_a_corridor_closes_it_and_one_along_its_side_does_not() -> None:
    """In a corridor of 5 m a car along the side leaves 2.9 m, one across leaves less than 2 m."""
    site = Site(((0.0, 0.0), (40.0, 0.0), (40.0, 5.0), (0.0, 5.0)))
    passages = Passages(site, 1.0)
    assert passages.is_closed_by(CAR.footprint, Pose(20.0, 2.0, math.pi / 2.0), 5.0)
    assert not passages.is_closed_by(CAR.footprint, Pose(20.0, 1.1, 0.0), 5.0)
    passages.take(CAR.footprint, Pose(20.0, 1.1, 0.0))
    assert passages.is_closed_by(CAR.footprint, Pose(19.0, 3.9, 0.0), 5.0)
    assert not passages.is_closed_by(CAR.footprint, Pose(28.0, 3.9, 0.0), 5.0)


def test_ways_lead_to_the_larger_part_only() -> None:
    """A wall across a hall makes two; robots are put into the larger one."""
    wall = Obstacle(wall=((30.0, 0.0), (30.0, 10.0)))
    passages = Passages(Site(((0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (0.0, 10.0)), (wall,)), 1.0)
    assert passages.leads_to(15.0, 5.0)
    assert not passages.leads_to(35.0, 5.0)
    blocked = passages.beside()
    blocked.take(Footprint(radius=5.0), Pose(15.0, 5.0, 0.0))
    assert not passages.is_closed_by(Footprint(radius=2.0), Pose(15.0, 5.0, 0.0), 10.0)
    assert passages.is_closed_by(Footprint(radius=5.0), Pose(15.0, 5.0, 0.0), 10.0)


def test_lanes_are_wide_enough_for_cars() -> None:
    """A car is 3.61 m from corner to corner; its disc of 2 m still passes beside it."""
    lanes = lanes_of(FLEETS["cars"])
    assert lanes.door == pytest.approx(math.hypot(3.0, 2.0) + 1.0)
    assert lanes.aisle == pytest.approx(math.hypot(3.0, 2.0) + 3.0)
    assert lanes.door >= 4.5


def test_the_public_density() -> None:
    """25 discs of 0.8 m on 50 m x 50 m are two hundredths of the floor, 50 on 100 m x 100 m one."""
    few = generate("open", robots=25, size=(50.0, 50.0), seed=0)
    many = generate("open", robots=50, size=(100.0, 100.0), density=0.01, seed=0)
    assert (len(few.site.obstacles), len(many.site.obstacles)) == (25, 50)
    assert {obstacle.disc[2] for obstacle in few.site.obstacles if obstacle.disc} == {0.8}


@pytest.mark.parametrize(
    ("kind", "density"),
    [
        ("open", 0.05),
        ("shelves", 0.1),
        ("shelves", 0.3),
        ("rooms", 0.04),
        ("corridors", 0.4),
        ("corridors", 0.55),
        ("yards", 0.05),
        ("yards", 0.15),
    ],
)
def test_density_is_the_share_of_the_floor_under_obstacles(kind: str, density: float) -> None:
    """Got to within a tenth of it where the pattern has room to."""
    scenario = generate(kind, robots=5, size=(200.0, 200.0), density=density, seed=2)
    assert covered(scenario.site) == pytest.approx(density, rel=0.1)


@pytest.mark.parametrize("kind", list(KINDS))
@pytest.mark.parametrize("size", [(60.0, 60.0), (45.0, 160.0)])
def test_sites_are_of_simple_shapes_inside_simple_bounds(
    kind: str, size: tuple[float, float]
) -> None:
    """Whatever the seed and the density, no obstacle crosses itself, another one or the bounds."""
    for seed in range(4):
        rng = Random(seed)
        density = rng.uniform(KINDS[kind].least, KINDS[kind].most)
        site = KINDS[kind].build(size, density, lanes_of(FLEETS["mixed"]), rng)
        bounds = shapely.Polygon(site.bounds)
        solid = [obstacle_shape(obstacle).geometry for obstacle in site.obstacles]
        assert bounds.is_valid
        assert shapely.is_valid(solid).all()
        assert bounds.covers(shapely.union_all(solid))
        assert shapely.union_all(solid).area == pytest.approx(shapely.area(solid).sum())


def test_seeds_repeat_and_differ() -> None:
    """The same seed gives the same text, another one another site."""
    first, again, other = (
        generate("yards", robots=6, size=(60.0, 60.0), fleet="mixed", seed=seed)
        for seed in (1, 1, 2)
    )
    assert dump_scenario(first) == dump_scenario(again)
    assert first.site != other.site
    assert first.name == "yards-60x60-6mixed-seed1"


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"kind": "opn"}, "kind: .*take one of open"),
        ({"fleet": "car"}, "fleet: .*take one of cars"),
        ({"size": (0.0, 50.0)}, "size: .*above 0"),
        ({"size": (50.0, 1e6)}, "size: .*at most 2000"),
        ({"robots": 0}, "robots: must be 1 or more"),
        ({"robots": 10**9}, "robots: .*take fewer"),
        ({"robots": 200}, "robots: .* starts fit.*take fewer"),
        ({"density": -0.1}, "density: .*from 0 to 0.3"),
        ({"density": 0.9}, "density: .*from 0 to 0.3"),
        ({"kind": "corridors", "size": (15.0, 15.0)}, "size: .*20 m or more"),
        ({"kind": "shelves", "size": (10.0, 50.0)}, "size: .*14 m or more"),
        ({"kind": "rooms", "size": (50.0, 5.0)}, "size: .*10 m or more"),
        ({"kind": "yards", "size": (15.0, 50.0)}, "size: .*20 m or more"),
    ],
)
def test_what_cannot_be_made_is_told_with_the_mend(change: dict[str, object], told: str) -> None:
    """The message begins with the name of the parameter."""
    asked = {"kind": "open", "robots": 4, "size": (40.0, 40.0)} | change
    with pytest.raises(ValueError, match=f"^{told}"):
        generate(**asked)  # type: ignore[arg-type]


def test_a_large_fleet_is_placed_in_seconds() -> None:
    """500 robots of unlike types on 300 m x 300 m; a bound with much room, in CPU time."""
    begin = time.process_time()
    scenario = generate("open", robots=500, size=(300.0, 300.0), fleet="mixed", seed=0)
    assert time.process_time() - begin < 10.0
    assert len({*starts(scenario)}) == 500
