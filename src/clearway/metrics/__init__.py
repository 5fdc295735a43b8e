"""The figures of a run, computed from the record of its plan."""

from clearway.metrics.activities import Activity, activities
from clearway.metrics.figures import Metrics, RobotMetrics, Separation, plan_metrics, to_json
from clearway.metrics.visits import VisitTime, visit_times

__all__ = [
    "Activity",
    "Metrics",
    "RobotMetrics",
    "Separation",
    "VisitTime",
    "activities",
    "plan_metrics",
    "to_json",
    "visit_times",
]
