"""Cells of a site and the ways between them."""

import math

import numpy as np
import pytest

from clearway.model import Obstacle, Site
from clearway.world.grid import Grid
from clearway.world.shapes import obstacle_shape

FLOOR = ((0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0))


def box(x_min, y_min, x_max, y_max, blocks=()):
    corners = ((x_min, y_min), (x_max, y_min), (x_max, y_max), (x_min, y_max))
    return Obstacle(polygon=corners, blocks=blocks)


def post(x, y, radius):
    return obstacle_shape(Obstacle(disc=(x, y, radius)))


def way(grid, start, goal):
    return float(grid.distances([start], [goal])[0, 0])


@pytest.fixture
def shelf():
    """A shelf from the lower wall to y = 3, over the fourth column of cells."""
    return Site(FLOOR, (box(3.0, 0.0, 4.0, 3.0),))


def test_an_open_floor_is_crossed_along_its_axes():
    """From (0.5, 0.5) to (7.5, 4.5) there are 7 steps along x and 4 along y."""
    grid = Grid(Site(FLOOR), "cart", False, 0.5)
    assert way(grid, (0.5, 0.5), (7.5, 4.5)) == 11.0


def test_a_point_stands_for_its_cell():
    """Two points of one cell are 0 m apart, and both are a step from the next cell."""
    grid = Grid(Site(FLOOR), "cart", False, 0.5)
    assert way(grid, (2.1, 2.2), (2.8, 2.9)) == 0.0
    assert way(grid, (2.1, 2.2), (3.8, 2.9)) == 1.0


def test_a_shelf_is_driven_round(shelf):
    """From (2.5, 0.5) the way to (4.5, 0.5) leads up to row 3.5 and down: 3 + 2 + 3 steps."""
    assert way(Grid(shelf, "cart", False, 0.5), (2.5, 0.5), (4.5, 0.5)) == 8.0


def test_a_wider_body_needs_a_wider_passage(shelf):
    """Between shelf (y = 3) and wall (y = 5) a half width of 0.5 passes; one of 1.1 does not."""
    assert math.isinf(way(Grid(shelf, "cart", False, 1.1), (1.5, 1.5), (6.5, 1.5)))


def test_a_gap_of_exactly_the_inflation_is_free():
    """A cell centre 0.5 m from the wall is free at 0.5 m and closed at 0.51 m."""
    corner, middle = (0.5, 0.5), (1.5, 1.5)
    assert way(Grid(Site(FLOOR), "cart", False, 0.5), corner, middle) == 2.0
    # The corner's cell is closed, so the point goes straight to the next free centre.
    assert way(Grid(Site(FLOOR), "cart", False, 0.51), corner, middle) == pytest.approx(2**0.5)


def test_an_open_border_takes_no_room():
    """With an open border a body may stick out, so the outermost cells are free."""
    site = Site(FLOOR, border="open")
    assert way(Grid(site, "cart", False, 2.0), (0.5, 0.5), (7.5, 0.5)) == 7.0


def test_a_point_far_from_any_free_cell_is_nowhere():
    """A point more than two cells inside a block has no way out, not even to itself."""
    site = Site(FLOOR, (box(0.0, 0.0, 4.0, 5.0),))
    grid = Grid(site, "cart", False, 0.5)
    assert math.isinf(way(grid, (1.0, 2.5), (7.5, 2.5)))
    assert way(grid, (3.9, 2.5), (7.5, 2.5)) == pytest.approx(0.6 + 3.0)


def test_obstacles_block_whom_they_name():
    """Under a shelf that stops loaded carts, empty carts and tall trucks pass as told."""
    site = Site(FLOOR, (box(3.0, 0.0, 4.0, 5.0, ("cart:loaded", "truck")),))
    ends = (0.5, 0.5), (7.5, 0.5)
    assert way(Grid(site, "cart", False, 0.5), *ends) == 7.0
    assert math.isinf(way(Grid(site, "cart", True, 0.5), *ends))
    assert math.isinf(way(Grid(site, "truck", False, 0.5), *ends))


def test_a_disc_blocks_to_its_radius():
    """Round a disc of 0.9 m on (3.5, 2.5) the cells one step away are 0.1 m from it."""
    site = Site(FLOOR, (Obstacle(disc=(3.5, 2.5, 0.9)),))
    assert way(Grid(site, "cart", False, 0.1), (2.5, 2.5), (4.5, 2.5)) == 4.0
    assert way(Grid(site, "cart", False, 0.2), (1.5, 2.5), (5.5, 2.5)) == 8.0


def test_a_thin_wall_stops_a_slim_body():
    """A wall between two columns of cells is not slipped through, however slim the body."""
    site = Site(FLOOR, (Obstacle(wall=((4.0, 0.0), (4.0, 4.0))),))
    assert way(Grid(site, "cart", False, 0.1), (3.5, 0.5), (4.5, 0.5)) == 9.0
    whole = Site(FLOOR, (Obstacle(wall=((4.0, 0.0), (4.0, 5.0))),))
    grid = Grid(whole, "cart", False, 0.1)
    assert math.isinf(way(grid, (3.5, 0.5), (4.5, 0.5)))
    left, also_left, right = grid.components([(0.5, 0.5), (3.5, 4.5), (4.5, 4.5)])
    assert left == also_left != right


def test_bounds_need_not_be_a_rectangle():
    """In an L-shaped hall the way leads through the corner that both arms share."""
    hall = Site(((0.0, 0.0), (8.0, 0.0), (8.0, 2.0), (2.0, 2.0), (2.0, 6.0), (0.0, 6.0)))
    grid = Grid(hall, "cart", False, 0.5)
    assert way(grid, (7.5, 0.5), (0.5, 5.5)) == 12.0
    assert math.isinf(way(grid, (0.5, 0.5), (7.5, 5.5)))


def test_an_obstacle_outside_the_bounds_changes_nothing():
    """A post beyond any wall is in nobody's way."""
    posts = tuple(Obstacle(disc=(x, y, 0.5)) for x, y in ((-20, 2), (30, 2), (4, -20), (4, 30)))
    grid = Grid(Site(FLOOR, posts), "cart", False, 0.3)
    assert way(grid, (0.5, 0.5), (7.5, 4.5)) == 11.0


def test_many_searches_agree_with_single_ones(shelf):
    """All pairs of 70 points (more than one word of bits) cost what each pair costs alone."""
    rng = np.random.default_rng(1)
    points = rng.uniform((0.0, 0.0), (8.0, 5.0), (70, 2))
    grid = Grid(shelf, "cart", False, 0.4)
    together = grid.distances(points, points)
    np.testing.assert_allclose(together, together.T)
    for i, j in ((0, 1), (3, 68), (69, 64), (65, 2)):
        assert together[i, j] == way(grid, points[i], points[j])


def test_nobody_asked_nothing_answered():
    """Without points there are no distances, of the right shape."""
    grid = Grid(Site(FLOOR), "cart", False, 0.5)
    assert grid.distances([], [(1.0, 1.0)]).shape == (0, 1)
    assert grid.distances([(1.0, 1.0)], []).shape == (1, 0)


def test_the_reference_warehouse_is_measured_along_its_aisles():
    """Distances on the reference site, counted by hand.

    Shelves of 35 m x 1.5 m leave aisles of 4.5 m to bodies 2 m wide: from (95.5, 24.5) to
    (50.5, 33.5) there are 9 steps along the cross aisle and 45 along the aisle at y = 33.5.
    """
    shelves = tuple(
        box(x, y - 0.75, x + 35.0, y + 0.75) for x in (10.0, 55.0) for y in range(6, 55, 6)
    )
    site = Site(((0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)), shelves)
    grid = Grid(site, "wide", False, 1.0)
    assert way(grid, (95.5, 24.5), (50.5, 33.5)) == 54.0
    # Along one aisle, and to the next one by the cross aisle, whose first free column is x = 8.5.
    assert way(grid, (20.5, 8.5), (40.5, 8.5)) == 20.0
    assert way(grid, (20.5, 8.5), (20.5, 14.5)) == 12.0 + 6.0 + 12.0


def test_a_body_across_an_aisle_splits_it(shelf):
    """Over the shelf a post on the passage splits it; out on the floor it is driven round."""
    grid = Grid(shelf, "cart", False, 0.5)
    assert grid.is_split_by(post(3.5, 4.0, 0.4), 2.0)
    assert not grid.is_split_by(post(6.0, 2.5, 0.4), 2.0)


def test_a_long_way_round_does_not_count(shelf):
    """Both ways round a block are open, but within a step of one post there is no other way."""
    site = Site(FLOOR, (box(2.0, 2.0, 6.0, 3.0),))
    grid = Grid(site, "cart", False, 0.5)
    in_the_way = post(4.0, 1.0, 0.6)
    assert grid.is_split_by(in_the_way, 1.0)
    assert not grid.is_split_by(in_the_way, 8.0)


def test_further_obstacles_leave_the_first_grid_alone(shelf):
    """A rest tried out on a copy closes the passage there and nowhere else."""
    grid = Grid(shelf, "cart", False, 0.5)
    closed = grid.beside(post(3.5, 4.0, 0.9))
    ends = [(1.5, 1.5), (6.5, 1.5)]
    assert len(set(closed.components(ends))) == 2
    assert len(set(grid.components(ends))) == 1


@pytest.mark.parametrize(("inflate", "cell"), [(-0.1, 1.0), (math.nan, 1.0), (0.5, 0.0)])
def test_lengths_must_make_sense(inflate, cell):
    """Negative or undefined lengths are refused by name."""
    with pytest.raises(ValueError, match=r"inflate|cell"):
        Grid(Site(FLOOR), "cart", False, inflate, cell)
