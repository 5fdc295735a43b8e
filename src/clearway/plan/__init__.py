"""Planners: how a team moves through its tours."""

from clearway.plan.conflict_based import ConflictBasedSearch, ConflictParams
from clearway.plan.in_turn import InTurn
from clearway.plan.lane_trips import LaneTrips
from clearway.plan.prioritised import Aim, PrioritisedPlanner, TeamParams
from clearway.plan.tail_trips import TailTrips, TailTripsParams

__all__ = [
    "Aim",
    "ConflictBasedSearch",
    "ConflictParams",
    "InTurn",
    "LaneTrips",
    "PrioritisedPlanner",
    "TailTrips",
    "TailTripsParams",
    "TeamParams",
]
