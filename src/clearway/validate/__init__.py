"""The judge, with geometry of its own."""

from clearway.validate.judge import gaps_over_time, separations, validate_plan
from clearway.validate.violation import Violation

__all__ = ["Violation", "gaps_over_time", "separations", "validate_plan"]
