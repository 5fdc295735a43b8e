"""What a plan file holds: the plan sampled in time, with all that is needed to judge it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clearway.model.plan import Assignment, Status
from clearway.model.robot import Robot, RobotType
from clearway.model.site import Site
from clearway.model.task import Visit
from clearway.model.trajectory import Trajectory

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Track:
    """A robot's motion as samples.

    Parameters
    ----------
    t, x, y, theta
        Arrays of shape ``(num_samples,)``: seconds from 0 on, metres, radians. Between
        samples everything is linear, theta the short way.
    mode
        Mode from each sample to the next; ``None`` where there are no modes.
    """

    t: Floats
    x: Floats
    y: Floats
    theta: Floats
    mode: tuple[str | None, ...]

    def __post_init__(self) -> None:
        lengths = {len(self.t), len(self.x), len(self.y), len(self.theta), len(self.mode)}
        if len(lengths) != 1 or 0 in lengths:
            raise ValueError(
                f"the arrays of a trajectory need one common length above 0, got {sorted(lengths)}"
            )

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Track)
            and self.mode == other.mode
            and all(
                np.array_equal(getattr(self, k), getattr(other, k))
                for k in ("t", "x", "y", "theta")
            )
        )


@dataclass(frozen=True)
class PlanRecord:
    """The content of ``plan.json`` (format ``clearway.plan/1``), field by field.

    ``tours`` are the robots' visits; ``paths`` are the exact pieces and timing behind the
    samples (absent for foreign plans). A robot missing in ``tracks`` stands at its start.
    """

    scenario: str
    system: str
    seed: int
    status: Status
    site: Site
    robot_types: Mapping[str, RobotType]
    robots: tuple[Robot, ...]
    tours: Mapping[str, tuple[Visit, ...]]
    tracks: Mapping[str, Track]
    assignment: Assignment
    sum_of_costs: float
    makespan: float
    reason: str | None = None
    lower_bound: float | None = None
    cost: float | None = None
    cost_name: str | None = None
    cost_lower_bound: float | None = None
    discrete_bound: Mapping[str, Any] | None = None
    conflict_free_until: float | None = None
    paths: Mapping[str, Trajectory] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    timings: Mapping[str, Any] = field(default_factory=dict)
    version: str = ""
