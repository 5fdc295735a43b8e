"""How near two bodies come."""

import math
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from clearway.model import Pose
from clearway.validate import separations


def test_robots_that_pass_each_other(by_hand: ModuleType) -> None:
    """Carts 0.6 m wide on lines 2 m apart pass at 1.4 m, first when their fronts meet.

    From 10 m apart at 1 m/s each, fronts are 9 m apart and meet after 4.5 s.
    """
    a = by_hand.journey("a", Pose(5.0, 4.0, 0.0), by_hand.ahead(9.0))
    b = by_hand.journey("b", Pose(15.0, 6.0, math.pi), by_hand.ahead(9.0))
    [(one, other, gap, time)] = separations(by_hand.plan([by_hand.CART] * 2, [a, b]))
    assert (one, other) == ("a", "b")
    assert gap == pytest.approx(1.4, abs=1.001e-3)
    assert 4.4 <= time <= 5.6


def test_robots_at_rest(by_hand: ModuleType) -> None:
    """Corners (3, 4) apart make a gap of 5 m."""
    a = by_hand.journey("a", Pose(5.0, 2.0, 0.0))
    b = by_hand.journey("b", Pose(9.0, 6.6, 0.0))
    [(_, _, gap, _)] = separations(by_hand.plan([by_hand.CART] * 2, [a, b]))
    assert gap == pytest.approx(5.0)


def test_overlap_is_a_negative_gap(by_hand: ModuleType) -> None:
    """Bodies that overlap by 2 mm have the gap -2 mm."""
    [(_, _, gap, _)] = separations(by_hand.wrong_plans()["conflict"])
    assert gap == pytest.approx(-0.002, abs=1e-6)


def test_only_the_window_counts(by_hand: ModuleType) -> None:
    """After the time until which a plan is free of conflicts nothing is promised.

    In 2 s the cart comes to (7, 5), 0.9 m from the one that turns its side to it.
    """
    a = by_hand.journey("a", Pose(5.0, 5.0, 0.0), by_hand.ahead(5.0))
    b = by_hand.journey("b", Pose(8.7, 5.0, math.pi / 2))
    plan = by_hand.plan([by_hand.CART] * 2, [a, b])
    [(_, _, gap, time)] = separations(replace(plan, conflict_free_until=2.0))
    assert (gap, time) == (pytest.approx(0.9, abs=1e-3), pytest.approx(2.0, abs=1e-2))


def test_pairs_that_stay_apart_are_left_out(by_hand: ModuleType) -> None:
    """Of three carts in a row, 1 m and 2 m apart, one pair comes within 1.5 m."""
    journeys = [
        by_hand.journey(k, Pose(5.0, y, 0.0)) for k, y in zip("abc", (2.0, 3.6, 6.2), strict=True)
    ]
    plan = by_hand.plan([by_hand.CART] * 3, journeys)
    assert len(separations(plan)) == 3
    [(one, other, gap, _)] = separations(plan, within=1.5)
    assert (one, other, gap) == ("a", "b", pytest.approx(1.0))


def test_random_plans_against_dense_samples(by_hand: ModuleType, random_plans: ModuleType) -> None:
    """The gap found is at most that of any moment, and no more than 1 mm above the least."""
    record = random_plans.Case(3, by_hand).record
    times = np.arange(0.0, record.makespan, 0.05)
    bodies = {}
    for name, track in record.tracks.items():
        theta = np.unwrap(track.theta)
        rows = [np.interp(times, track.t, column) for column in (track.x, track.y, theta)]
        kind = random_plans.TYPES[name]
        bodies[name] = [random_plans.body(kind, Pose(*p)) for p in zip(*rows, strict=True)]
    for one, other, gap, _ in separations(record):
        seen = min(a.distance(b) for a, b in zip(bodies[one], bodies[other], strict=True))
        # Two robots of at most 1.5 m/s come at most 7.5 cm nearer within half a sample.
        assert seen - 0.075 <= gap <= seen + 1e-3 + 1e-9
