"""Who may rest where, and who must park."""

import math

import pytest

from clearway.assign import park
from clearway.model import Footprint, Limits, Obstacle, Pose, Robot, RobotType, Site, Visit, Zone
from clearway.world.shapes import body_shape

CART = RobotType("cart", Footprint.rectangle(3.0, 2.0), "differential", Limits(speed=1.0))
WAGON = RobotType("wagon", Footprint.rectangle(6.0, 3.0), "differential", Limits(speed=1.0))
TYPES = {"cart": CART, "wagon": WAGON}
# A hall of 40 m x 20 m. A block leaves an aisle of 4 m below it, open at both ends.
HALL = ((0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (0.0, 20.0))
BLOCK = Obstacle(polygon=((10.0, 4.0), (30.0, 4.0), (30.0, 10.0), (10.0, 10.0)))
IN_AISLE = Pose(20.0, 2.0, 0.0)
IN_OPEN = Pose(20.0, 15.0, 0.0)


def bay(name, x, y):
    outline = ((x - 2.0, y - 2.0), (x + 2.0, y - 2.0), (x + 2.0, y + 2.0), (x - 2.0, y + 2.0))
    return Zone(name, "parking", outline, Pose(x, y, math.pi / 2.0))


NEAR, FAR = bay("near", 34.0, 17.0), bay("far", 38.0, 17.0)


def hall(*bays, obstacles=(BLOCK,)):
    return Site(HALL, obstacles, bays)


def robot(name, x, y, kind="cart"):
    return Robot(name, kind, Pose(x, y, 0.0))


def to(*poses):
    return tuple(Visit(f"t{i}", pose) for i, pose in enumerate(poses))


A, B = robot("a", 3.0, 3.0), robot("b", 3.0, 7.0)


def ends(site, robots, tours, when="blocking"):
    """Where each robot ends, and that nothing but a bay was added."""
    parked = park(site, TYPES, robots, tours, when)
    for each in robots:
        tour = tours.get(each.id, ())
        assert parked[each.id][: len(tour)] == tour
        assert all(visit.task is None for visit in parked[each.id][len(tour) :])
    return {each.id: parked[each.id][-1].pose if parked[each.id] else each.start for each in robots}


def test_a_rest_across_an_aisle_ends_in_a_bay():
    """A cart in an aisle of 4 m leaves no way past it; one on the open floor does."""
    found = ends(hall(NEAR, FAR), (A, B), {"a": to(IN_AISLE), "b": to(IN_OPEN)})
    assert found == {"a": NEAR.pose, "b": IN_OPEN}


def test_an_aisle_is_closed_even_if_nobody_is_shut_in():
    """The aisle has two ends, so all places stay joined by the long way; still it is closed."""
    assert ends(hall(NEAR), (A, B), {"a": to(IN_AISLE)})["a"] == NEAR.pose
    wide = Obstacle(polygon=((10.0, 8.0), (30.0, 8.0), (30.0, 10.0), (10.0, 10.0)))
    assert ends(hall(NEAR, obstacles=(wide,)), (A, B), {"a": to(IN_AISLE)})["a"] == IN_AISLE


def test_a_rest_must_not_shut_a_dead_end():
    """Whoever ends at the mouth of a dead end shuts in the one who works there."""
    walls = (
        Obstacle(polygon=((10.0, 4.0), (40.0, 4.0), (40.0, 5.0), (10.0, 5.0))),
        Obstacle(polygon=((24.0, 0.0), (25.0, 0.0), (25.0, 4.0), (24.0, 4.0))),
    )
    site = hall(NEAR, obstacles=walls)
    inner, mouth = Pose(21.0, 2.0, 0.0), Pose(13.0, 2.0, 0.0)
    assert ends(site, (A, B), {"a": to(mouth), "b": to(inner)}) == {"a": NEAR.pose, "b": inner}
    assert ends(site, (A, B), {"a": to(inner), "b": to(IN_OPEN)})["a"] == inner


def test_a_rest_on_somebodys_place_ends_in_a_bay():
    """A cart that ends where another works or starts is in its way, on however open a floor."""
    beside = Pose(21.0, 15.5, 0.0)
    assert ends(hall(NEAR), (A, B), {"a": to(IN_OPEN), "b": to(beside, Pose(5.0, 15.0, 0.0))})[
        "a"
    ] == (NEAR.pose)
    assert ends(hall(NEAR), (A, B), {"a": to(B.start), "b": to(IN_OPEN)})["a"] == NEAR.pose


def test_a_rest_that_clips_a_place_ends_in_a_bay():
    """Bodies of 3 m in line, 2.9 m apart, overlap by 0.1 m though the gap seems wide enough."""
    ahead = Pose(IN_OPEN.x + 2.9, IN_OPEN.y, 0.0)
    work = {"a": to(IN_OPEN), "b": to(ahead, Pose(5.0, 15.0, 0.0))}
    assert ends(hall(NEAR), (A, B), work)["a"] == NEAR.pose


def test_a_rest_must_not_wedge_another_in():
    """Side by side at the end of a lane, the inner cart has no free cell left to leave by."""
    lane = Obstacle(polygon=((12.0, 4.0), (40.0, 4.0), (40.0, 5.0), (12.0, 5.0)))
    end = Pose(39.0, 2.0, math.pi / 2.0)
    beside = Pose(36.9, 2.0, math.pi / 2.0)
    assert body_shape(CART.footprint, beside).overlap(body_shape(CART.footprint, end)) == 0.0
    work = {"a": to(beside), "b": to(end, Pose(5.0, 15.0, 0.0))}
    assert ends(hall(NEAR, obstacles=(lane,)), (A, B), work)["a"] == NEAR.pose


def test_touching_is_no_overlap():
    """Two carts side by side without a gap rest where they are."""
    there = Pose(20.0, 17.0, 0.0)
    found = ends(hall(NEAR, FAR), (A, B), {"a": to(IN_OPEN), "b": to(there)})
    assert found == {"a": IN_OPEN, "b": there}


def test_rests_count_together():
    """Each of two carts leaves a way past it; both together do not, so the second one parks."""
    site = Site(((0.0, 0.0), (40.0, 0.0), (40.0, 7.5), (0.0, 7.5)), (), (bay("side", 37.0, 2.0),))
    low, high = Pose(20.0, 1.5, 0.0), Pose(20.0, 5.0, 0.0)
    a, b, c = robot("a", 3.0, 1.5), robot("b", 3.0, 5.0), robot("c", 7.0, 4.0)
    work = {"a": to(low), "b": to(high)}
    assert ends(site, (a, b, c), work)["a"] == low
    assert ends(site, (a, b, c), work)["b"] == site.zones[0].pose
    assert ends(site, (a, c), {"a": to(high)})["a"] == high


def test_a_broad_robot_needs_more_room():
    """A gap of 2.5 m past a resting cart serves carts, not wagons of 3 m."""
    lane = Site(((0.0, 0.0), (40.0, 0.0), (40.0, 5.0), (0.0, 5.0)), (), (bay("end", 37.0, 2.5),))
    rest = Pose(20.0, 1.5, 0.0)
    for kind, end in (("cart", rest), ("wagon", lane.zones[0].pose)):
        other = robot("b", 5.0, 3.0, kind)
        assert ends(lane, (robot("a", 12.0, 3.0), other), {"a": to(rest)})["a"] == end


def test_bays_are_shared_out_for_the_least_way():
    """One from the left and one from the right: each takes the bay on its side."""
    left, right = bay("left", 3.0, 14.0), bay("right", 37.0, 14.0)
    work = {"a": to(Pose(28.0, 2.0, 0.0)), "b": to(Pose(12.0, 2.0, 0.0))}
    assert ends(hall(left, right), (A, B), work) == {"a": right.pose, "b": left.pose}


def test_too_few_bays_leave_the_rest_where_they_are():
    """Of two that should park, one does: the one that is nearer to the only bay."""
    work = {"a": to(Pose(14.0, 2.0, 0.0)), "b": to(Pose(27.0, 2.0, 0.0))}
    found = ends(hall(NEAR), (A, B), work)
    assert found == {"a": Pose(14.0, 2.0, 0.0), "b": NEAR.pose}


def test_a_bay_in_use_is_not_offered():
    """Where another starts in the near bay, the far one is taken; its own bay is open to it."""
    c = robot("c", *NEAR.pose[:2])
    assert ends(hall(NEAR, FAR), (A, c), {"a": to(IN_AISLE)})["a"] == FAR.pose
    assert ends(hall(NEAR, FAR), (A, c), {"c": to(IN_AISLE)})["c"] == NEAR.pose


def test_an_idle_robot_in_the_way_parks():
    """A robot without tasks rests at its start, unless that closes an aisle."""
    idle = robot("idle", 20.0, 2.0)
    assert ends(hall(NEAR), (idle, A), {"a": to(IN_OPEN)}) == {"idle": NEAR.pose, "a": IN_OPEN}
    assert ends(hall(NEAR), (B, A), {"a": to(IN_OPEN)})["b"] == B.start


def test_bays_too_close_for_two_hold_one():
    """Two wagons of 6 m x 3 m do not fit bays that lie 2.5 m apart."""
    bays = bay("one", 33.0, 15.0), bay("two", 35.5, 15.0)
    pair = robot("a", 4.0, 3.0, "wagon"), robot("b", 4.0, 8.0, "wagon")
    found = ends(hall(*bays), pair, {}, "always")
    parked = [body_shape(WAGON.footprint, pose) for pose in found.values()]
    assert parked[0].overlap(parked[1]) == 0.0
    assert sum(pose in {zone.pose for zone in bays} for pose in found.values()) == 1


@pytest.mark.parametrize(
    ("when", "a", "b"),
    [("never", IN_AISLE, IN_OPEN), ("always", NEAR.pose, FAR.pose)],
)
def test_parking_may_be_forced_or_forbidden(when, a, b):
    """Never leaves everybody at work; always sends everybody to a bay."""
    found = ends(hall(NEAR, FAR), (A, B), {"a": to(IN_AISLE), "b": to(IN_OPEN)}, when)
    if when == "never":
        assert found == {"a": a, "b": b}
    else:
        assert set(found.values()) == {a, b}


def test_without_bays_all_tours_stay():
    """On a site without parking everybody ends at its last visit."""
    work = {"a": to(IN_AISLE), "b": to(IN_OPEN)}
    assert park(hall(), TYPES, (A, B), work, "blocking") == work


def test_a_robot_already_in_its_bay_stays():
    """A last visit at a bay's pose needs no second visit there."""
    parked = park(hall(NEAR), TYPES, (A, B), {"a": to(NEAR.pose), "b": ()}, "always")
    assert parked["a"] == to(NEAR.pose)
