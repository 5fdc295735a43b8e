"""The nouns: frozen data, checked when built."""

from clearway.model.clock import TICKS_PER_SECOND, to_seconds, to_ticks
from clearway.model.driven import tracks_of
from clearway.model.footprint import Footprint, Point, Polygon
from clearway.model.plan import Assignment, Plan, Status
from clearway.model.pose import Pose, wrap
from clearway.model.problem import Problem, RobotState
from clearway.model.record import PlanRecord, Track
from clearway.model.robot import FOUR_WHEEL_MODES, Battery, Limits, Robot, RobotType
from clearway.model.scenario import Scenario
from clearway.model.simulation import Disturbances, Draw, OrderStream, Simulation, Surprise
from clearway.model.site import Layout, Obstacle, Site, Zone
from clearway.model.task import LOAD_CHANGE, Order, Task, Visit
from clearway.model.trace import Trace
from clearway.model.trajectory import Piece, Stop, Trajectory
from clearway.model.trip import Commitment, Trip, Wait
from clearway.model.trip_spans import TripSpan, trip_spans

__all__ = [
    "FOUR_WHEEL_MODES",
    "LOAD_CHANGE",
    "TICKS_PER_SECOND",
    "Assignment",
    "Battery",
    "Commitment",
    "Disturbances",
    "Draw",
    "Footprint",
    "Layout",
    "Limits",
    "Obstacle",
    "Order",
    "OrderStream",
    "Piece",
    "Plan",
    "PlanRecord",
    "Point",
    "Polygon",
    "Pose",
    "Problem",
    "Robot",
    "RobotState",
    "RobotType",
    "Scenario",
    "Simulation",
    "Site",
    "Status",
    "Stop",
    "Surprise",
    "Task",
    "Trace",
    "Track",
    "Trajectory",
    "Trip",
    "TripSpan",
    "Visit",
    "Wait",
    "Zone",
    "to_seconds",
    "to_ticks",
    "tracks_of",
    "trip_spans",
    "wrap",
]
