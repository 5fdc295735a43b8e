"""Planners: how a team moves through its tours."""

from clearway.plan.prioritised import PrioritisedPlanner, TeamParams

__all__ = ["PrioritisedPlanner", "TeamParams"]
