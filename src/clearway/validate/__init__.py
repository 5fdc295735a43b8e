"""The judge, with geometry of its own."""

from clearway.validate.judge import separations, validate_plan
from clearway.validate.violation import Violation

__all__ = ["Violation", "separations", "validate_plan"]
