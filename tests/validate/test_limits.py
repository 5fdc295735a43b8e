"""Where the limits on motion begin to bind."""

import math
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from clearway.model import Limits, Pose, Robot, Track
from clearway.validate import validate_plan


def kinds(plan) -> list[str]:
    return [violation.kind for violation in validate_plan(plan)]


@pytest.mark.parametrize(("factor", "right"), [(1.019, True), (1.021, False)])
def test_two_percent_on_speed_and_yaw_rate(by_hand: ModuleType, factor: float, right: bool) -> None:
    """1.019 of the limit passes, 1.021 does not.

    Legs are long because their times are whole milliseconds: 10.19 m in 10 s.
    """
    cart = by_hand.limited(by_hand.CART, yaw_rate=0.5, reverse_speed=0.5)
    for leg, kind in (
        ((None, (10.0 * factor, 0.0, 0.0), 10.0), "speed"),
        ((None, (-4.0 * factor, 0.0, 0.0), 8.0), "reverse_speed"),
        ((None, (0.0, 0.0, 2.0 * factor), 4.0), "yaw_rate"),
    ):
        assert kinds(by_hand.alone(cart, leg)) == ([] if right else [kind])


@pytest.mark.parametrize(("factor", "right"), [(1.038, True), (1.042, False)])
def test_four_percent_on_curvature(by_hand: ModuleType, factor: float, right: bool) -> None:
    """A car with a turning radius of 2 m turns by at most 0.52 rad per metre."""
    arc = (None, (2.0, 0.0, factor), 2.0)
    assert kinds(by_hand.alone(by_hand.CAR, arc)) == ([] if right else ["turning_radius"])


@pytest.mark.parametrize(("rate", "right"), [(1.13, True), (1.2, False)])
def test_fifteen_percent_on_acceleration(by_hand: ModuleType, rate: float, right: bool) -> None:
    """Speeding up and slowing down at 1.13 m/s^2 passes where 1 m/s^2 is the limit."""
    cart = by_hand.limited(by_hand.CART, acceleration=1.0, deceleration=1.0)
    # The steps of 0.1 s have speeds that differ by 0.1 * rate.
    speeds = [0.1 * rate * (i + 0.5) for i in range(8)]
    legs = [(None, (0.1 * v, 0.0, 0.0), 0.1) for v in [*speeds, *reversed(speeds)]]
    found = set(kinds(by_hand.alone(cart, *legs)))
    assert found == (set() if right else {"acceleration", "deceleration"})


def test_a_cusp_needs_braking(by_hand: ModuleType) -> None:
    """From 0.3 m/s ahead to 0.3 m/s back at once is 0.6 / 0.2 = 3 m/s^2.

    Whole milliseconds make 1 m in 3.334 s a little slower.
    """
    cart = by_hand.limited(by_hand.CART, acceleration=2.0, deceleration=2.0)
    [found] = validate_plan(by_hand.alone(cart, by_hand.ahead(1.0, 0.3), by_hand.ahead(-1.0, 0.3)))
    assert "2.999 m/s^2" in found.text
    assert found.time == pytest.approx(1.0 / 0.3, abs=1e-3)


def test_a_robot_that_starts_moving_need_not_speed_up(by_hand: ModuleType) -> None:
    """With a start speed of 1 m/s only the braking counts."""
    cart = by_hand.limited(by_hand.CART, acceleration=1.0, deceleration=1.0)
    plan = by_hand.alone(cart, by_hand.ahead(1.0), *by_hand.ramp(1.0, 0.0))
    assert kinds(plan) == ["acceleration"]
    running = Robot("a", "cart", Pose(5.0, 5.0, 0.0), start_speed=1.0)
    assert kinds(replace(plan, robots=(running,))) == []
    standing = replace(plan, robots=(running,), tracks={}, sum_of_costs=0.0, makespan=0.0)
    assert kinds(standing) == ["deceleration"]


@pytest.mark.parametrize(("angle", "right"), [(0.048, True), (0.052, False)])
def test_five_millimetres_of_slip(by_hand: ModuleType, angle: float, right: bool) -> None:
    """A cart that drives 1 m/s, its heading off by 0.05 rad, slips 5 mm in 0.1 s."""
    rows = [
        (0.1 * i, 5.0 + 0.1 * i * math.cos(angle), 5.0 + 0.1 * i * math.sin(angle), 0.0)
        for i in range(11)
    ]
    assert kinds(by_hand.samples(by_hand.CART, rows)) == ([] if right else ["slip"])


def test_zigzag_is_slip_too(by_hand: ModuleType) -> None:
    """2 mm to the left and to the right again, each in 20 ms, makes 10 mm in 0.1 s."""
    rows = [(0.02 * i, 5.0 + 0.02 * i, 5.0 + 0.002 * (i % 2), 0.0) for i in range(11)]
    cart = by_hand.limited(by_hand.CART, speed=2.0)
    assert kinds(by_hand.samples(cart, rows)) == ["slip"]


def test_a_holonomic_robot_slips_as_it_likes(by_hand: ModuleType) -> None:
    """Holonomic robots move in any direction, and backwards up to their reverse speed."""
    aside = (None, (0.0, 1.0, 0.5), 1.0)
    assert kinds(by_hand.alone(by_hand.PUCK, aside)) == []
    shy = by_hand.limited(by_hand.PUCK, reverse_speed=0.5)
    slanting = (None, (-0.6, 0.8, 0.0), 1.0)
    assert kinds(by_hand.alone(shy, slanting)) == ["reverse_speed"]


@pytest.mark.parametrize(("last", "right"), [(0.1, True), (0.1001, False)])
def test_moving_steps_last_a_tenth_of_a_second(
    by_hand: ModuleType, last: float, right: bool
) -> None:
    """A step of 100 ms is fine, one of 100.1 ms is not."""
    rows = [(0.0, 5.0, 5.0, 0.0), (last, 5.1, 5.0, 0.0)]
    assert kinds(by_hand.samples(by_hand.CART, rows)) == ([] if right else ["step"])


def test_motion_below_five_micrometres_is_rest(by_hand: ModuleType) -> None:
    """4e-6 m in 3 s is rest; the robot arrived before it."""
    rows = [(0.0, 5.0, 5.0, 0.0), (0.1, 5.1, 5.0, 0.0), (3.1, 5.100004, 5.0, 0.0)]
    plan = by_hand.samples(by_hand.CART, rows)
    assert kinds(plan) == ["sum_of_costs", "makespan"]
    assert kinds(replace(plan, sum_of_costs=0.1, makespan=0.1)) == []


def test_the_short_way_round(by_hand: ModuleType) -> None:
    """From 3.1 to -3.1 rad is a turn of 0.083 rad, not of 6.2."""
    rows = [(0.0, 5.0, 5.0, 3.1), (0.1, 5.0, 5.0, -3.1)]
    cart = by_hand.limited(by_hand.CART, yaw_rate=0.84)
    assert kinds(by_hand.samples(cart, rows)) == []
    slower = by_hand.limited(by_hand.CART, yaw_rate=0.8)
    assert kinds(by_hand.samples(slower, rows)) == ["yaw_rate"]


def test_unreadable_time(by_hand: ModuleType) -> None:
    """Time that falls, starts late or is no number makes a track unreadable."""
    plan = by_hand.alone(by_hand.CART, by_hand.ahead(0.3))
    track = plan.tracks["a"]
    for t in ([0.0, 0.2, 0.1, 0.3], [0.1, 0.2, 0.3, 0.4], [0.0, 0.1, np.nan, 0.3]):
        broken = replace(track, t=np.array(t))
        assert kinds(replace(plan, tracks={"a": broken})) == ["clock"]


def test_a_track_of_nobody(by_hand: ModuleType) -> None:
    """A trajectory needs a robot."""
    plan = by_hand.alone(by_hand.CART, by_hand.ahead(0.3))
    one = np.zeros(1)
    assert kinds(replace(plan, tracks={"x": Track(one, one, one, one, (None,))})) == ["robot"]


def test_a_four_wheel_robot_bends_in_its_lateral_modes(by_hand: ModuleType) -> None:
    """Lateral modes may curve, to either side, up to the turning radius of 2 m."""
    for turn, right in ((0.5, True), (-0.5, True), (0.53, False)):
        leg = ("lateral-left", (0.0, 1.0, turn), 1.0)
        quick = replace(by_hand.CRAB, limits=Limits(1.0, yaw_rate=1.0, turning_radius=2.0))
        assert kinds(by_hand.alone(quick, leg)) == ([] if right else ["turning_radius"])
