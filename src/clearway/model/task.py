"""Work: visits, tasks and orders."""

import math
from dataclasses import dataclass
from typing import Literal

from clearway.model.pose import Pose, check_pose

Load = Literal["pick", "drop"]

# By how much a visit changes the number of loads on board.
LOAD_CHANGE: dict[Load | None, int] = {"pick": 1, "drop": -1, None: 0}


@dataclass(frozen=True)
class Visit:
    """One stop of a robot at a pose.

    Parameters
    ----------
    task
        Id of the task it belongs to; ``None`` for parking and charging.
    service
        Time to stand there (s).
    load
        ``pick`` or ``drop``, effective at the end of the service.
    needs
        Capability that the robot must have.
    together
        Robots that must stand at their own poses in the same service interval.
    """

    task: str | None
    pose: Pose
    service: float = 0.0
    load: Load | None = None
    needs: str | None = None
    together: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose", check_pose(self.pose, "pose of a visit"))
        if not (math.isfinite(self.service) and self.service >= 0.0):
            raise ValueError(f"service must be 0 or above and finite, got {self.service}")
        if self.load not in (None, "pick", "drop"):
            raise ValueError(f"load must be 'pick' or 'drop', got {self.load!r}")


@dataclass(frozen=True)
class Task:
    """Visits that one robot does in order; ``robot`` names the only one that may, if any."""

    id: str
    visits: tuple[Visit, ...]
    robot: str | None = None

    def __post_init__(self) -> None:
        if not self.visits:
            raise ValueError(f"task {self.id} has no visits")


@dataclass(frozen=True)
class Order:
    """A task with its release and due times (s) and its priority (larger is more urgent)."""

    task: Task
    release: float = 0.0
    due: float | None = None
    priority: float = 0.0
