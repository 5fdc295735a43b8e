"""Plans: everybody's trajectories, who does what, and what is known about them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from clearway.model.task import Visit
from clearway.model.trajectory import Trajectory

Assignment = Mapping[str, tuple[str, ...]]


class Status(StrEnum):
    """How a search ended; truthy exactly when the plan is complete."""

    SOLVED = "solved"
    STOPPED = "stopped"
    INFEASIBLE = "infeasible"

    def __bool__(self) -> bool:
        return self is Status.SOLVED


@dataclass(frozen=True)
class Plan:
    """Trajectories with their assignment and bounds.

    ``conflict_free_until`` is in seconds, ``None`` for ever. Robots that are not planned
    have no trajectory and stand at their start. ``concerned`` names the robots that
    ``reason`` is about. ``discrete_bound`` holds what is proven on the finite graph that was
    searched: ``value`` and ``factor`` of the figure named ``of``, and the ``graph``'s name.
    """

    status: Status
    trajectories: Mapping[str, Trajectory]
    tours: Mapping[str, tuple[Visit, ...]]
    assignment: Assignment
    reason: str | None = None
    concerned: tuple[str, ...] = ()
    conflict_free_until: float | None = None
    lower_bound: float | None = None
    cost: float | None = None
    cost_name: str | None = None
    cost_lower_bound: float | None = None
    discrete_bound: Mapping[str, str | float] | None = None
    counters: Mapping[str, int] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.status)
