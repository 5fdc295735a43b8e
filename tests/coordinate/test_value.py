"""By which numbers plans are compared."""

import pytest
from tests.plan.rooms import CART, EAST, room

from clearway.coordinate.value import lateness, makespan, paper, sum_of_costs
from clearway.model import Piece, Plan, Pose, Robot, Scenario, Status, Stop, Trajectory, Visit


def straight(robot, metres, stops=()):
    """At 1 m/s from the start on."""
    piece = Piece(0, "forward", Pose(1.0, 1.0, EAST), (metres, 0.0, 0.0))
    ticks = int(1000 * metres)
    return Trajectory(robot, piece.start, (piece,), ((0, ticks),), stops)


ROBOTS = tuple(Robot(name, "cart", Pose(1.0, 1.0, EAST)) for name in "ab")
SCENARIO = Scenario("room", room(20.0, 10.0), {"cart": CART}, ROBOTS, ())


def plan(*paths, **tours):
    return Plan(Status.SOLVED, {path.robot: path for path in paths}, tours, {})


def test_sum_last_arrival_and_metres_of_a_plan() -> None:
    """3 m and 5 m at 1 m/s, straight ahead."""
    both = plan(straight("a", 3.0), straight("b", 5.0))
    assert sum_of_costs(SCENARIO, both) == (8.0,)
    assert makespan(SCENARIO, both) == (5.0, 8.0)
    assert paper(SCENARIO, both) == pytest.approx((8.0,))


def test_who_does_not_move_costs_nothing() -> None:
    """A plan without trajectories."""
    assert sum_of_costs(SCENARIO, plan()) == (0.0,)
    assert makespan(SCENARIO, plan()) == (0.0, 0.0)
    assert paper(SCENARIO, plan()) == (0.0,)


def test_late_is_what_ends_after_it_is_due() -> None:
    """Due at 2 s and left at 5 s is 3 s late; what is early makes up for nothing."""
    there = Pose(4.0, 1.0, EAST)
    tours = {
        "a": (Visit("t", there, 2.0, due=2.0), Visit("u", there, due=50.0), Visit("v", there)),
    }
    stops = (Stop(0, 3000, 5000), Stop(1, 5000, 5000), Stop(2, 5000, 5000))
    assert lateness(plan(straight("a", 3.0, stops), **tours)) == 3.0
