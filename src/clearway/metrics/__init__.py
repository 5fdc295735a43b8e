"""The figures of a run, computed from the record of its plan or from its trace."""

from clearway.metrics.activities import Activity, activities
from clearway.metrics.figures import Metrics, RobotMetrics, Separation, plan_metrics, to_json
from clearway.metrics.trace_metrics import (
    DecisionFigures,
    RobotFigures,
    TraceMetrics,
    ending,
    trace_metrics,
    trace_to_json,
)
from clearway.metrics.trace_table import told
from clearway.metrics.visits import VisitTime, visit_times

__all__ = [
    "Activity",
    "DecisionFigures",
    "Metrics",
    "RobotFigures",
    "RobotMetrics",
    "Separation",
    "TraceMetrics",
    "VisitTime",
    "activities",
    "ending",
    "plan_metrics",
    "to_json",
    "told",
    "trace_metrics",
    "trace_to_json",
    "visit_times",
]
