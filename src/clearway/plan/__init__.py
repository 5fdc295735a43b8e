"""Planners: how a team moves through its tours."""

from clearway.plan.conflict_based import ConflictBasedSearch, ConflictParams
from clearway.plan.prioritised import Aim, PrioritisedPlanner, TeamParams

__all__ = ["Aim", "ConflictBasedSearch", "ConflictParams", "PrioritisedPlanner", "TeamParams"]
