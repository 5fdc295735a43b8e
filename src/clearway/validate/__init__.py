"""The judge, with geometry of its own."""

from clearway.validate.judge import gaps_over_time, separations, validate_plan
from clearway.validate.trace_judge import validate_trace
from clearway.validate.violation import Violation

__all__ = ["Violation", "gaps_over_time", "separations", "validate_plan", "validate_trace"]
