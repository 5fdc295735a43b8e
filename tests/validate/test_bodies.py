"""What the judge says about bodies, obstacles and bounds."""

import math
from dataclasses import replace
from types import ModuleType

import pytest

from clearway.model import Footprint, Obstacle, Pose, Zone
from clearway.validate import validate_plan
from clearway.validate.shapes import footprint_parts, outside_parts, polygon_parts


def test_a_conflict_is_told_once_at_its_worst(by_hand: ModuleType) -> None:
    """Two discs of radius 0.5 pass with centres 0.8 m apart: 0.2 m deep, at 3 s.

    One stands at (8, 5.8), the other drives along y = 5 from x = 5 at 1 m/s.
    """
    a = by_hand.journey("a", Pose(5.0, 5.0, 0.0), by_hand.ahead(6.0))
    b = by_hand.journey("b", Pose(8.0, 5.8, 0.0))
    [found] = validate_plan(by_hand.plan([by_hand.PUCK] * 2, [a, b]))
    assert (found.kind, found.robots) == ("conflict", ("a", "b"))
    assert found.depth == pytest.approx(0.2, abs=1e-4)
    assert found.time == pytest.approx(3.0, abs=0.02)
    assert found.place == pytest.approx((8.0, 5.4), abs=0.02)


def test_two_contacts_are_two_violations(by_hand: ModuleType) -> None:
    """A cart that goes through a wall and comes back meets it twice."""
    wall = Obstacle(wall=((7.0, 4.0), (7.0, 6.0)))
    plan = by_hand.alone(
        by_hand.CART, by_hand.ahead(4.0), by_hand.ahead(-4.0), site=by_hand.around(wall)
    )
    found = validate_plan(plan)
    # Its front, 0.5 m ahead of (5, 5), is at the wall from 1.5 s on and its tail until
    # 2.5 s: deepest with half of its width or length on either side. Back from 4 s on.
    assert [violation.kind for violation in found] == ["obstacle", "obstacle"]
    assert 1.5 < found[0].time < 2.5
    assert 5.5 < found[1].time < 6.5


@pytest.mark.parametrize(("depth", "right"), [(0.0009, True), (0.0011, False)])
def test_one_millimetre_is_let_pass(by_hand: ModuleType, depth: float, right: bool) -> None:
    """A body may be up to 1 mm in a box, a disc or a wall."""
    for thing in (
        by_hand.box(6.0, 3.0, 9.0, 4.7 + depth),
        Obstacle(disc=(7.0, 4.0, 0.7 + depth)),
        Obstacle(wall=((7.0, 3.0), (7.0, 4.7 + depth))),
    ):
        plan = by_hand.alone(by_hand.CART, by_hand.ahead(3.0), site=by_hand.around(thing))
        assert (validate_plan(plan) == []) == right


@pytest.mark.parametrize(("beyond", "right"), [(0.0019, True), (0.0021, False)])
def test_two_millimetres_out_of_bounds_are_let_pass(
    by_hand: ModuleType, beyond: float, right: bool
) -> None:
    """A body may leave the bounds by up to 2 mm."""
    trip = by_hand.journey("a", Pose(5.0, 0.3 - beyond, 0.0), by_hand.ahead(3.0))
    assert (validate_plan(by_hand.plan([by_hand.CART], [trip])) == []) == right


def test_far_out_of_bounds(by_hand: ModuleType) -> None:
    """A robot that drives away for 200 m is out of bounds, once."""
    [found] = validate_plan(by_hand.alone(by_hand.CART, by_hand.ahead(200.0)))
    assert found.kind == "bounds"


def test_obstacles_bind_whom_they_block(by_hand: ModuleType) -> None:
    """A table stops cars and loaded lifters; carts pass under it."""
    for kind, right in ((by_hand.CART, True), (by_hand.CAR, False), (by_hand.LIFTER, True)):
        site = by_hand.around(by_hand.box(7, 3, 8, 6, "car", "lifter:loaded"))
        assert (validate_plan(by_hand.alone(kind, by_hand.ahead(3.0), site=site)) == []) == right


def test_a_closed_zone_stays_closed_to_those_who_left(by_hand: ModuleType) -> None:
    """A cart that starts in a closed zone may leave it, but not come back."""
    zone = Zone("dock", "closed", ((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)))
    site = by_hand.around(zones=(zone,))
    leaving = by_hand.alone(by_hand.CART, by_hand.ahead(3.0), site=site)
    assert validate_plan(leaving) == []
    back = by_hand.alone(by_hand.CART, by_hand.ahead(3.0), by_hand.ahead(-3.0), site=site)
    assert [violation.kind for violation in validate_plan(back)] == ["zone"]
    lane = replace(site, zones=(replace(zone, kind="lane"),))
    assert validate_plan(replace(back, site=lane)) == []


def test_the_load_is_judged_from_the_end_of_picking_to_the_end_of_dropping(
    by_hand: ModuleType,
) -> None:
    """The lifter is 1.6 m wide from 2 s to 8 s, while its front is between x = 5.5 and 10.5.

    A box beside its way, 0.5 m from its middle line, is met in between only.
    """
    for x, right in ((2.0, True), (6.0, False), (9.0, False), (11.6, True)):
        site = by_hand.around(by_hand.box(x, 4.0, x + 0.5, 4.5))
        assert (validate_plan(by_hand.delivery(site=site)) == []) == right


def test_robots_pass_through_each_other_between_samples(by_hand: ModuleType) -> None:
    """Two carts that swap places in one step of 0.1 s are never seen to overlap, but do."""
    fast = by_hand.limited(by_hand.CART, speed=100.0)
    a = by_hand.journey("a", Pose(5.0, 5.0, 0.0), by_hand.ahead(4.0, 40.0))
    b = by_hand.journey("b", Pose(9.0, 5.0, math.pi), by_hand.ahead(4.0, 40.0))
    [found] = validate_plan(by_hand.plan([fast, fast], [a, b]))
    assert found.kind == "conflict"
    assert found.time == pytest.approx(0.05, abs=0.02)


def test_a_notched_polygon_has_room_in_its_notch() -> None:
    """An L is cut into convex parts that cover its 3 square metres and no more."""
    ell = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
    assert sum(part.outline.area for part in polygon_parts(ell)) == pytest.approx(3.0)


def test_parts_of_a_footprint_that_make_a_convex_one_are_joined() -> None:
    """Two halves of a rectangle are one part, so that no corner slips into their seam."""
    halves = Footprint(
        parts=(
            ((1.0, 0.5), (0.0, 0.5), (0.0, -0.5), (1.0, -0.5)),
            ((0.0, 0.5), (-1.0, 0.5), (-1.0, -0.5), (0.0, -0.5)),
        )
    )
    [part] = footprint_parts(halves)
    assert part.outline.area == pytest.approx(2.0)
    assert len(part.points) == 4


def test_what_lies_outside_of_bounds_is_covered() -> None:
    """Around 4 m x 2 m, 1 m wide, lie 6 * 4 - 4 * 2 = 16 square metres."""
    parts = outside_parts(((0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)), 1.0)
    assert sum(part.outline.area for part in parts) == pytest.approx(16.0)
