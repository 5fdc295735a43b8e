"""Lower bounds never exceed what a robot can do."""

import math
from dataclasses import replace

import pytest
from tests.plan.rooms import CART, EAST, NORTH, WEST, room, team, to

from clearway.model import Limits, Pose, RobotState
from clearway.plan.bounds import leg_bound, lower_bounds


def bound(*visits, start=(1.0, 1.0, EAST)):
    return lower_bounds(team(room(20.0, 10.0), (CART, start, *visits)))


def test_a_straight_line_takes_its_length_over_the_speed():
    """7 m at 1 m/s."""
    assert bound(to(8.0, 1.0)).seconds == pytest.approx(7.0)
    assert bound(to(8.0, 1.0)).metres == pytest.approx(7.0)


def test_turning_takes_its_angle_over_the_yaw_rate():
    """Half a turn at 0.8 rad/s takes longer than 1 m at 1 m/s."""
    assert bound(to(2.0, 1.0, WEST)).seconds == pytest.approx(math.pi / 0.8)


def test_service_counts_but_for_the_last():
    """Cost ends with the last arrival: 4 m, 3 s of service, 4 m."""
    visits = to(5.0, 1.0, EAST, 3.0), to(9.0, 1.0, EAST, 60.0)
    assert bound(*visits).seconds == pytest.approx(11.0)


def test_waiting_for_a_visit_counts_but_for_the_last():
    """4 m, until 10 s at the first visit, its 3 s, and 4 m; nobody waits for what is past."""
    first, last = to(5.0, 1.0, EAST, 3.0), replace(to(9.0, 1.0, EAST), not_before=60.0)
    assert bound(replace(first, not_before=10.0), last).seconds == pytest.approx(17.0)
    assert bound(replace(first, not_before=4.0), last).seconds == pytest.approx(11.0)


def test_a_final_rest_begins_with_the_last_motion():
    """4 m; what is served there, once and again, keeps no wheel turning."""
    visit = to(5.0, 1.0, EAST, 3.0)
    assert bound(visit, visit).seconds == pytest.approx(4.0)


def test_who_drives_faster_backwards_is_bound_by_that():
    """A bound that took the speed ahead would be above what reversing costs."""
    limits = Limits(speed=1.0, reverse_speed=2.0)
    quick = replace(CART, limits=limits)
    start, goal = Pose(0.0, 0.0, 0.0), Pose(-8.0, 0.0, 0.0)
    assert leg_bound(quick, start, goal, 8.0) == pytest.approx(4.0)


def test_robots_without_tours_cost_nothing():
    """Nobody has to go anywhere."""
    assert bound().seconds == 0.0


def test_the_bound_counts_from_where_a_robot_is():
    """A robot on its way is bound by what is left."""
    problem = team(room(20.0, 10.0), (CART, (1.0, 1.0, NORTH), to(11.0, 1.0, EAST)))
    nearer = replace(problem, states={"a": RobotState(Pose(9.0, 1.0, EAST))})
    assert lower_bounds(nearer).seconds <= lower_bounds(problem).seconds
    assert lower_bounds(nearer).metres == pytest.approx(2.0)
