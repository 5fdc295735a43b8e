"""Decisions over time: what is to be done becomes what is done."""

from clearway.coordinate.coordinator import Coordinator, CoordinatorParams
from clearway.coordinate.lifelong import Lifelong
from clearway.coordinate.once import Unsupported, plan_once
from clearway.coordinate.system import OwnTasks, System
from clearway.coordinate.travel import ByDuration, Searched, Travel, bounded_seconds, by_grid

__all__ = [
    "ByDuration",
    "Coordinator",
    "CoordinatorParams",
    "Lifelong",
    "OwnTasks",
    "Searched",
    "System",
    "Travel",
    "Unsupported",
    "bounded_seconds",
    "by_grid",
    "plan_once",
]
