"""Estimates beside scipy and sums worked by hand."""

import math

import numpy as np
import pytest
from scipy import stats

from clearway.study import statistics
from clearway.study.statistics import Estimate


def test_a_mean_has_students_interval():
    """2, 4, 6: mean 4, standard error 2 / sqrt(3), t of 2 degrees 4.303: 4 +- 4.968."""
    found = statistics.mean([2.0, 4.0, 6.0])
    assert (found.value, found.count) == (4.0, 3)
    assert found.low == pytest.approx(4.0 - 4.9683, abs=1e-3)
    assert found.high == pytest.approx(4.0 + 4.9683, abs=1e-3)


def test_a_mean_agrees_with_scipy():
    """The interval of scipy's own one-sample test."""
    values = np.random.default_rng(3).normal(5.0, 2.0, 17)
    interval = stats.ttest_1samp(values, 0.0).confidence_interval(0.95)
    found = statistics.mean(values.tolist())
    assert (found.low, found.high) == pytest.approx((interval.low, interval.high))


def test_one_value_has_no_interval():
    """And says so instead of a width of 0."""
    found = statistics.mean([3.0])
    assert (found.low, found.high) == (-math.inf, math.inf)
    assert not found.excludes_zero
    assert str(found) == "3.00 (n = 1)"


def test_a_median_lies_between_two_of_the_sample():
    """Of ten values the second and the ninth: P(fewer than 2 below) = 11 / 1024 < 2.5 %."""
    found = statistics.median([float(value) for value in range(10, 0, -1)])
    assert (found.value, found.low, found.high) == (5.5, 2.0, 9.0)


@pytest.mark.parametrize("count", [5, 6])
def test_six_values_are_the_fewest_for_a_median(count):
    """Five lie all on one side with 1/32 = 3.1 %, six with 1/64 = 1.6 %."""
    found = statistics.median([float(value) for value in range(count)])
    assert math.isfinite(found.low) is (count == 6)


def test_intervals_of_medians_hold_the_true_one():
    """In at least 95 of 100 samples of a skewed distribution, whose median is ln 2."""
    rng = np.random.default_rng(0)
    samples = [statistics.median(rng.exponential(1.0, 25).tolist()) for _ in range(2000)]
    held = sum(each.low <= math.log(2.0) <= each.high for each in samples)
    assert 0.95 <= held / 2000.0 <= 0.97


def test_pairs_see_what_means_do_not():
    """Instances differ by hundreds, methods by one: only pairs tell them apart."""
    theirs = [100.0, 400.0, 900.0, 1600.0]
    ours = [98.9, 399.0, 899.1, 1599.0]
    assert statistics.difference(ours, theirs).high < 0.0
    assert not statistics.unpaired(ours, theirs).excludes_zero


def test_a_saving_is_the_mean_of_shares():
    """10 for 20 saves 50 %, 90 for 100 saves 10 %: 30 %, not 100 for 120."""
    assert statistics.saving([10.0, 90.0], [20.0, 100.0]).value == pytest.approx(30.0)


def test_a_share_has_the_exact_interval():
    """30 of 30: the low end is 0.025 ** (1 / 30) = 88.4 %."""
    found = statistics.share(30, 30)
    assert (found.value, found.high) == (100.0, 100.0)
    assert found.low == pytest.approx(100.0 * 0.025 ** (1.0 / 30.0))


@pytest.mark.parametrize(
    "call",
    [
        lambda: statistics.mean([]),
        lambda: statistics.median([]),
        lambda: statistics.difference([1.0], [1.0, 2.0]),
        lambda: statistics.unpaired([1.0], [1.0, 2.0]),
        lambda: statistics.share(3, 2),
        lambda: statistics.share(0, 0),
    ],
)
def test_what_cannot_be_estimated_is_refused(call):
    """Nothing is made up of nothing."""
    with pytest.raises(ValueError):
        call()


def test_estimates_are_told_with_digits_that_fit():
    """Value and interval alike, by the largest of them."""
    assert str(Estimate(1234.56, 1200.4, 1268.7, 9)) == "1,235 (1,200 to 1,269)"
    assert str(Estimate(0.12345, -0.01, 0.25, 9)) == "0.123 (-0.010 to 0.250)"
