"""The table of the differential drive is what turning its two wheels comes to."""

from dataclasses import replace

import pytest
from tests.motion.tables import STARTS, check_curves, check_limits, length_of
from tests.motion.wheels import apart, integrate

from clearway.model import Footprint, Limits, Piece, RobotType
from clearway.motion import car, differential

TRACK = 0.6  # between its wheels (m)
TUG = RobotType(
    "tug", Footprint.rectangle(1.2, 0.8), "differential", Limits(speed=1.2, yaw_rate=1.0)
)
TYPES = {
    "tug": TUG,
    "slow back": replace(TUG, limits=Limits(speed=1.5, reverse_speed=0.4, yaw_rate=0.8)),
    "free to turn": replace(TUG, limits=Limits(speed=0.9)),
    "nimble disc": replace(TUG, footprint=Footprint(radius=0.4), limits=Limits(1.0, yaw_rate=3.0)),
}
FORWARD_ONLY = replace(TUG, limits=replace(TUG.limits, reverse_speed=0.0))


@pytest.fixture(params=[16, 32])
def headings(request):
    return request.param


@pytest.fixture(params=TYPES)
def robot_type(request):
    return TYPES[request.param]


def roll(start, left, right, seconds):
    """Roll the wheels at two speeds (m/s): v = (l + r) / 2, w = (r - l) / track."""
    return integrate(start, 0.0, (left + right) / 2.0, (right - left) / TRACK, seconds, 2000)


@pytest.mark.parametrize("start", STARTS)
def test_turning_two_wheels_ends_where_the_table_says(robot_type, headings, start):
    """Each motion by the speeds of its wheels: alike, unlike, or against each other."""
    for motion in differential(robot_type, headings).motions:
        ahead, across, turn = motion.twist
        assert across == 0.0
        v, w = ahead / motion.duration, turn / motion.duration
        end = roll(start, v - w * TRACK / 2.0, v + w * TRACK / 2.0, motion.duration)
        assert apart(end, Piece(0, motion.mode, start, motion.twist).end) < 1e-6


def test_limits_are_kept(robot_type, headings):
    """By motions and by curves."""
    check_limits(differential(robot_type, headings), robot_type.limits)


def test_curves_end_at_their_goals(robot_type):
    """Both families together reach any pose."""
    check_curves(differential(robot_type))


def test_it_goes_straight_round_and_on_the_spot_both_ways(headings):
    """Six ways of a car and two turns on the spot, each by one heading at most."""
    motions = differential(TUG, headings).motions
    assert sorted((m.twist[0] > 0.0, m.twist[0] < 0.0, m.turn_steps) for m in motions) == sorted(
        [(True, False, k) for k in (-1, 0, 1)]
        + [(False, True, k) for k in (-1, 0, 1)]
        + [(False, False, k) for k in (-1, 1)]
    )


def test_its_arc_is_the_tightest_at_top_speed(headings):
    """1.2 m/s at 1 rad/s is an arc of 1.2 m; with 0.1 rad/s it would be 12 m, longer than wanted.

    Then it is the body's length, 1.2 m, at 0.12 m/s.
    """
    for yaw_rate, speed in ((1.0, 1.2), (0.1, 0.12)):
        limits = replace(TUG.limits, yaw_rate=yaw_rate)
        model = differential(replace(TUG, limits=limits), headings)
        (arc,) = (m for m in model.motions if m.mode == "forward-left")
        assert length_of(arc) / arc.twist[2] == pytest.approx(1.2)
        assert length_of(arc) / arc.duration == pytest.approx(speed)


def test_without_a_yaw_rate_the_ends_of_its_body_turn_at_top_speed(headings):
    """0.9 m/s at 0.6 m from the middle: 1.5 rad/s."""
    model = differential(TYPES["free to turn"], headings)
    assert model.mode("rotate-left").speed == pytest.approx(1.5)


def test_with_a_turning_radius_it_is_a_car(headings):
    """What may not turn on the spot has the table of a car."""
    bound = replace(TUG, limits=replace(TUG.limits, turning_radius=2.0))
    assert differential(bound, headings) == car(bound, headings)


def test_what_may_not_reverse_turns_on_the_spot_all_the_same(headings):
    """There is no way back, and every pose is reached."""
    model = differential(FORWARD_ONLY, headings)
    assert all(motion.twist[0] >= 0.0 for motion in model.motions)
    check_limits(model, FORWARD_ONLY.limits)
    check_curves(model)
