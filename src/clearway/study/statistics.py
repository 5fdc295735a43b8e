"""Estimates with the interval that holds the true value in 95 of 100 studies."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

LEVEL = 0.95


@dataclass(frozen=True)
class Estimate:
    """A value with its 95 % interval; infinite ends where too few values allow none."""

    value: float
    low: float
    high: float
    count: int

    @property
    def excludes_zero(self) -> bool:
        """Whether the whole interval lies on one side of 0."""
        return self.low > 0.0 or self.high < 0.0

    def __str__(self) -> str:
        """Return value and interval with as many digits as its size asks for."""
        if not math.isfinite(self.low) or not math.isfinite(self.high):
            return f"{figure(self.value)} (n = {self.count})"
        size = max(abs(self.value), abs(self.low), abs(self.high))
        return f"{figure(self.value, size)} ({figure(self.low, size)} to {figure(self.high, size)})"


def figure(value: float, like: float | None = None) -> str:
    """Return a number with digits fit for its size, or for the size of ``like``."""
    size = abs(value if like is None else like)
    return f"{value:,.{0 if size >= 1000 else 1 if size >= 10 else 2 if size >= 1 else 3}f}"


def mean(values: Sequence[float]) -> Estimate:
    """Return the mean with Student's interval.

    Raises
    ------
    ValueError
        If there are no values.
    """
    from scipy import stats

    count = _count(values)
    middle = math.fsum(values) / count
    if count == 1:
        return Estimate(middle, -math.inf, math.inf, 1)
    error = float(np.std(values, ddof=1)) / math.sqrt(count)
    reach = float(stats.t.ppf(0.5 + LEVEL / 2.0, count - 1)) * error
    return Estimate(middle, middle - reach, middle + reach, count)


def median(values: Sequence[float]) -> Estimate:
    """Return the median with the interval between two values of the ordered sample.

    These are the narrowest pair, equally far from both ends, between which the true median
    lies with at least 95 % (binomial); fewer than six values allow no such pair.
    """
    from scipy import stats

    count = _count(values)
    ordered = sorted(values)
    middle = 0.5 * (ordered[(count - 1) // 2] + ordered[count // 2])
    # So many of the values may lie below the low end with at most 2.5 %.
    rank = int(stats.binom.ppf(0.5 - LEVEL / 2.0, count, 0.5))
    if stats.binom.cdf(rank, count, 0.5) > 0.5 - LEVEL / 2.0:
        rank -= 1
    if rank < 0:
        return Estimate(middle, -math.inf, math.inf, count)
    return Estimate(middle, ordered[rank], ordered[count - 1 - rank], count)


def difference(ours: Sequence[float], theirs: Sequence[float]) -> Estimate:
    """Return the mean of ``ours - theirs``, pair by pair.

    Raises
    ------
    ValueError
        If the two are not equally long, or empty.
    """
    return mean([a - b for a, b in zip(ours, theirs, strict=True)])


def saving(ours: Sequence[float], theirs: Sequence[float]) -> Estimate:
    """Return by how many per cent ``ours`` lie below ``theirs``: the mean over pairs.

    Raises
    ------
    ValueError
        If the two are not equally long, or empty.
    """
    return mean([100.0 * (1.0 - a / b) for a, b in zip(ours, theirs, strict=True)])


def unpaired(ours: Sequence[float], theirs: Sequence[float]) -> Estimate:
    """Return the difference of two means of independent samples, with Welch's interval.

    Raises
    ------
    ValueError
        If one of the two has fewer than two values.
    """
    from scipy import stats

    if min(len(ours), len(theirs)) < 2:
        raise ValueError("each side needs two values or more")
    interval = stats.ttest_ind(ours, theirs, equal_var=False).confidence_interval(LEVEL)
    middle = math.fsum(ours) / len(ours) - math.fsum(theirs) / len(theirs)
    return Estimate(middle, float(interval.low), float(interval.high), len(ours) + len(theirs))


def share(successes: int, count: int) -> Estimate:
    """Return the share of successes (per cent) with the interval of Clopper and Pearson."""
    from scipy import stats

    if not 0 <= successes <= count or count == 0:
        raise ValueError(f"a share needs 0 to n successes of n above 0, got {successes} of {count}")
    interval = stats.binomtest(successes, count).proportion_ci(LEVEL, method="exact")
    return Estimate(
        100.0 * successes / count, 100.0 * float(interval.low), 100.0 * float(interval.high), count
    )


def _count(values: Sequence[float]) -> int:
    if not values:
        raise ValueError("there are no values to estimate from")
    return len(values)
