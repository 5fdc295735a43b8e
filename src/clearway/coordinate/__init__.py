"""Decisions over time: what is to be done becomes what is done."""

from clearway.coordinate.once import Unsupported, plan_once
from clearway.coordinate.system import OwnTasks, System

__all__ = ["OwnTasks", "System", "Unsupported", "plan_once"]
