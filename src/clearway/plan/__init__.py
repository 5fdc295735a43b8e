"""Planners: how a team moves through its tours."""

from clearway.plan.prioritised import Aim, PrioritisedPlanner, TeamParams

__all__ = ["Aim", "PrioritisedPlanner", "TeamParams"]
