"""A disc that cannot pass is proven stuck; one that can is never called stuck."""

import math
import random

import pytest
import shapely

from clearway.model import Footprint, Obstacle, Pose, Site
from clearway.world.reach import BodyReach, Reach, inscribed_disc

ROOM = ((0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0))
LEFT, RIGHT = (4.0, 5.0), (16.0, 5.0)


def divided(door: float, **wall: tuple[str, ...]) -> tuple[Obstacle, ...]:
    """A wall across the room at x = 10 with a door in the middle."""
    low, high = 5.0 - door / 2.0, 5.0 + door / 2.0
    return (
        Obstacle(wall=((10.0, 0.0), (10.0, low)), **wall),
        Obstacle(wall=((10.0, high), (10.0, 10.0)), **wall),
    )


@pytest.mark.parametrize(
    ("door", "is_open"), [(0.5, False), (1.6, False), (2.0, True), (2.01, True), (6.0, True)]
)
def test_a_disc_of_one_metre_needs_a_door_of_two(door: float, is_open: bool) -> None:
    """With cells of 0.2 m a door 0.4 m too narrow is proven shut; an exact fit stays open."""
    reach = Reach(Site(ROOM, divided(door)), "a", False, 1.0, cell=0.2)
    assert reach.connected(LEFT, RIGHT) is is_open


def test_finer_cells_prove_more() -> None:
    """A door of 1.9 m for a disc of 2 m is shut, which cells of 0.25 m cannot tell."""
    site = Site(ROOM, divided(1.9))
    assert Reach(site, "a", False, 1.0, cell=0.25).connected(LEFT, RIGHT)
    assert not Reach(site, "a", False, 1.0, cell=0.05).connected(LEFT, RIGHT)


def test_only_those_whom_a_wall_blocks_are_shut_out() -> None:
    """A low gate stops loaded carriers; empty ones and carts drive under it."""
    site = Site(ROOM, divided(0.5, blocks=("carrier:loaded",)))
    assert not Reach(site, "carrier", True, 1.0).connected(LEFT, RIGHT)
    assert Reach(site, "carrier", False, 1.0).connected(LEFT, RIGHT)
    assert Reach(site, "cart", True, 1.0).connected(LEFT, RIGHT)


def test_an_open_border_lets_robots_go_round() -> None:
    """A wall from edge to edge divides a closed room, but not an open yard."""
    wall = (Obstacle(wall=((10.0, -1.0), (10.0, 11.0))),)
    assert not Reach(Site(ROOM, wall), "a", False, 0.5).connected(LEFT, RIGHT)
    outside = Reach(Site(ROOM, wall, border="open"), "a", False, 0.5)
    assert outside.connected(LEFT, RIGHT)
    assert outside.connected(LEFT, (500.0, -300.0))


def test_a_ring_of_blocks_is_shut_also_in_an_open_yard() -> None:
    """Four blocks with gaps of 0.2 m hold a disc of half a metre whatever the border is."""
    ring = [
        Obstacle(polygon=((-4.0, 2.0), (4.0, 2.0), (4.0, 4.0), (-4.0, 4.0))),
        Obstacle(polygon=((-4.0, -4.0), (4.0, -4.0), (4.0, -2.0), (-4.0, -2.0))),
        Obstacle(polygon=((-4.0, -1.8), (-2.0, -1.8), (-2.0, 1.8), (-4.0, 1.8))),
        Obstacle(polygon=((2.0, -1.8), (4.0, -1.8), (4.0, 1.8), (2.0, 1.8))),
    ]
    site = Site(ROOM, tuple(ring), border="open")
    assert not Reach(site, "a", False, 0.5).connected((0.0, 0.0), (10.0, 0.0))


def test_where_a_disc_cannot_be_it_is_connected_to_nothing() -> None:
    """Inside a block and outside closed bounds there is no component, not even its own."""
    block = Obstacle(polygon=((8.0, 2.0), (14.0, 2.0), (14.0, 8.0), (8.0, 8.0)))
    reach = Reach(Site(ROOM, (block,)), "a", False, 0.5)
    assert not reach.connected((11.0, 5.0), (11.0, 5.0))
    assert not reach.connected((-3.0, 5.0), (-3.0, 5.0))
    assert reach.connected(LEFT, RIGHT)


def test_large_sites_get_coarser_cells() -> None:
    """Ten kilometres square would have 1.6e9 cells of 0.25 m; a million are enough."""
    site = Site(((0.0, 0.0), (1e4, 0.0), (1e4, 1e4), (0.0, 1e4)))
    reach = Reach(site, "a", False, 1.0)
    assert reach.cell > 10.0
    assert reach.connected((50.0, 50.0), (9_950.0, 9_950.0))


def test_inscribed_disc_may_lie_off_the_reference_point() -> None:
    """A forklift 3 m x 2 m about an axle 0.4 m from its rear end holds a disc of 1 m before it."""
    (x, y), radius = inscribed_disc(Footprint.rectangle(3.0, 2.0, rear=0.4))
    assert radius == pytest.approx(1.0, abs=0.01)
    assert 0.6 - 0.01 <= x <= 1.6 + 0.01
    assert y == pytest.approx(0.0, abs=0.01)
    assert inscribed_disc(Footprint(radius=0.7)) == ((0.0, 0.0), 0.7)


def test_a_body_is_judged_by_where_its_disc_is() -> None:
    """A long tail reaching through a gate is not yet a robot beyond the gate.

    The reference point of this body lies 3 m behind the middle of its 2 m disc; with the
    heading 0 and the reference point at x = 8.5 the disc is at 11.5, right of the wall.
    """
    square = ((4.0, 1.0), (2.0, 1.0), (2.0, -1.0), (4.0, -1.0))
    rod = ((2.0, 0.1), (0.0, 0.1), (0.0, -0.1), (2.0, -0.1))
    body = BodyReach(Site(ROOM, divided(1.0)), "a", False, Footprint((square, rod)))
    assert body.radius == pytest.approx(1.0, abs=0.01)
    beyond = body.component(Pose(8.5, 5.0, 0.0))
    assert beyond == body.component(Pose(16.0, 5.0, math.pi / 2.0)) != 0
    assert beyond != body.component(Pose(4.0, 5.0, 0.0))


@pytest.mark.parametrize("seed", range(25))
def test_whatever_can_be_driven_is_connected(seed: int) -> None:
    """Along any polyline on which the disc is free, every two points are connected."""
    rng = random.Random(seed)
    radius, cell = rng.uniform(0.3, 1.5), rng.choice((0.1, 0.3, 0.9, 2.0))
    discs = [(rng.uniform(0, 20), rng.uniform(0, 10), rng.uniform(0.2, 1.0)) for _ in range(6)]
    border = rng.choice(("closed", "open"))
    site = Site(ROOM, tuple(Obstacle(disc=disc) for disc in discs), border=border)
    reach = Reach(site, "a", False, radius, cell=cell)
    inner = shapely.Polygon(ROOM).buffer(-radius)
    checked = 0
    for _ in range(300):
        p, q = ((rng.uniform(0, 20), rng.uniform(0, 10)) for _ in range(2))
        way = shapely.LineString((p, q))
        is_free = all(way.distance(shapely.Point(x, y)) > radius + r for x, y, r in discs)
        if is_free and (border == "open" or inner.covers(way)):
            checked += 1
            assert reach.connected(p, q)
    assert checked > 0
