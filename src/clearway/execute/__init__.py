"""Letting committed motions happen, under delay."""

from clearway.execute.body_conflicts import BodyConflicts
from clearway.execute.cell_conflicts import CellConflicts
from clearway.execute.right_of_way import RightOfWay
from clearway.execute.track_plan import TrackPlan

__all__ = ["BodyConflicts", "CellConflicts", "RightOfWay", "TrackPlan"]
