"""The one clock: integer ticks that belong to no robot."""

import math

TICKS_PER_SECOND = 1000


def to_ticks(seconds: float) -> int:
    """Round a duration (s) up to whole ticks, so that no speed limit is exceeded by rounding."""
    return math.ceil(seconds * TICKS_PER_SECOND - 1e-6)


def to_seconds(ticks: int) -> float:
    """Convert ticks to seconds."""
    return ticks / TICKS_PER_SECOND
