"""Checks of parameters, which refuse what is out of range by name."""

import math


def check_effort(name: str, value: int, least: int) -> None:
    """Raise ``ValueError`` unless a number of things is whole and not too small."""
    if not (value >= least and math.isfinite(value) and value == int(value)):
        raise ValueError(f"{name} must be a whole number of {least} or above, got {value}")


def check_amount(name: str, value: float) -> None:
    """Raise ``ValueError`` unless a value is finite and 0 or above."""
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"{name} must be 0 or above and finite, got {value}")


def check_share(name: str, value: float) -> None:
    """Raise ``ValueError`` unless a value is in [0, 1]."""
    if not 0.0 <= value <= 1.0:
        raise ValueError(f"{name} must be in [0, 1], got {value}")
