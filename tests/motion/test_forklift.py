"""The table of the forklift is what steering its rear wheels comes to."""

import math
from dataclasses import replace

import pytest
from tests.motion.tables import STARTS, check_curves, check_limits, length_of
from tests.motion.wheels import apart, integrate

from clearway.model import Footprint, Limits, Piece, RobotType
from clearway.motion import car, forklift

WHEELBASE = 1.4  # from the unsteered front axle to the rear one (m)
STACKER = RobotType(
    "stacker",
    Footprint.rectangle(3.4, 1.2, rear=1.4),
    "ackermann",
    Limits(speed=1.5, reverse_speed=1.0, yaw_rate=0.6, turning_radius=1.8),
    motion="forklift",
)
PIVOTING = replace(STACKER, limits=replace(STACKER.limits, turning_radius=None))
TYPES = {
    "stacker": STACKER,
    "pivoting": PIVOTING,
    "free to turn": replace(STACKER, limits=Limits(speed=1.5, turning_radius=1.8)),
    "free": replace(STACKER, limits=Limits(speed=1.5)),
}


@pytest.fixture(params=[16, 32])
def headings(request):
    return request.param


@pytest.fixture(params=TYPES)
def robot_type(request):
    return TYPES[request.param]


def steer(start, wheel_speed, angle, seconds):
    """Roll the rear wheel at a speed (m/s), steered by an angle to its left.

    It lies behind the axle, so that steered to the left it turns the body to the right:
    v = u cos(d), w = -u sin(d) / wheelbase. At a right angle the body pivots.
    """
    v, w = wheel_speed * math.cos(angle), -wheel_speed * math.sin(angle) / WHEELBASE
    return integrate(start, 0.0, v, w, seconds, 2000)


@pytest.mark.parametrize("start", STARTS)
def test_steering_its_rear_wheel_ends_where_the_table_says(robot_type, headings, start):
    """Each motion by the speed and the angle of the rear wheel."""
    for motion in forklift(robot_type, headings).motions:
        ahead, across, turn = motion.twist
        assert across == 0.0
        v, w = ahead / motion.duration, turn / motion.duration
        angle = math.atan2(-w * WHEELBASE, v)
        end = steer(start, math.hypot(v, w * WHEELBASE), angle, motion.duration)
        assert apart(end, Piece(0, motion.mode, start, motion.twist).end) < 1e-6


def test_limits_are_kept(robot_type, headings):
    """By motions and by curves."""
    check_limits(forklift(robot_type, headings), robot_type.limits)


def test_curves_end_at_their_goals(robot_type):
    """Anywhere, in reverse as well as ahead."""
    check_curves(forklift(robot_type))


def test_it_has_a_cars_motions_and_arcs_twice_as_wide(headings):
    """Four arcs of 3.6 m beside those of 1.8 m, each over one heading."""
    model, like_a_car = forklift(STACKER, headings), car(STACKER, headings)
    assert model.motions[: len(like_a_car.motions)] == like_a_car.motions
    wide = model.motions[len(like_a_car.motions) :]
    assert {motion.mode for motion in wide} == {
        "forward-left",
        "forward-right",
        "reverse-left",
        "reverse-right",
    }
    for motion in wide:
        assert length_of(motion) / abs(motion.twist[2]) == pytest.approx(3.6)
        assert abs(motion.turn_steps) == 1


def test_a_wide_arc_is_driven_faster(headings):
    """0.6 rad/s on 1.8 m are 1.08 m/s, on 3.6 m 2.16: so top speed, 1.5 ahead and 1 in reverse."""
    speeds = {}
    for motion in forklift(STACKER, headings).motions:
        speeds.setdefault(motion.mode, []).append(length_of(motion) / motion.duration)
    assert speeds["forward-left"] == pytest.approx([1.08, 1.5])
    assert speeds["reverse-right"] == pytest.approx([1.0, 1.0])


def test_it_pivots_only_where_no_radius_is_given(headings):
    """Its rear wheel then goes round the middle of the front axle."""
    spins = [m for m in forklift(PIVOTING, headings).motions if not length_of(m)]
    assert [m.turn_steps for m in spins] == [1, -1]
    assert all(abs(m.twist[2]) / m.duration == pytest.approx(0.6) for m in spins)
    assert all(length_of(m) for m in forklift(STACKER, headings).motions)
