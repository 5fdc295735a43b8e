"""The joints: what the algorithms are asked and what they answer."""

from clearway.protocols.assignment import (
    EQUAL_WEIGHTS,
    Assigner,
    AssignmentProblem,
    Objective,
    Routes,
    Weights,
    check_routes,
    find_circle,
    finish_times,
    objective,
)
from clearway.protocols.planning import Budget, Planner, Progress

__all__ = [
    "EQUAL_WEIGHTS",
    "Assigner",
    "AssignmentProblem",
    "Budget",
    "Objective",
    "Planner",
    "Progress",
    "Routes",
    "Weights",
    "check_routes",
    "find_circle",
    "finish_times",
    "objective",
]
