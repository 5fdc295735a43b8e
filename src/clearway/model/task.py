"""Work: visits, tasks and orders."""

import math
from dataclasses import dataclass, replace
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
    not_before
        Second from 0 on before which the service does not begin; a robot that comes sooner
        waits, there or elsewhere.
    after
        Ids of tasks, whoever does them, that must be finished before the service begins.
    due
        Second by which the service should have ended; only told, never demanded.
    """

    task: str | None
    pose: Pose
    service: float = 0.0
    load: Load | None = None
    needs: str | None = None
    together: tuple[str, ...] = ()
    not_before: float = 0.0
    after: tuple[str, ...] = ()
    due: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose", check_pose(self.pose, "pose of a visit"))
        for name in ("service", "not_before", "due"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f"{name} must be 0 or above and finite, got {value}")
        if self.load not in (None, "pick", "drop"):
            raise ValueError(f"load must be 'pick' or 'drop', got {self.load!r}")


@dataclass(frozen=True)
class Task:
    """Visits that one robot does in order.

    Parameters
    ----------
    robot
        The only one that may do it, if any.
    fetches
        Name of a shelf that is to be brought to a station and stored again. The system chooses
        where, so such a task has no visits; only systems that move shelves take it.
    """

    id: str
    visits: tuple[Visit, ...]
    robot: str | None = None
    fetches: str | None = None

    def __post_init__(self) -> None:
        if bool(self.visits) == (self.fetches is not None):
            what = "has no visits" if not self.visits else "has visits and fetches a shelf"
            raise ValueError(f"task {self.id} {what}; give either visits or fetches")


@dataclass(frozen=True)
class Order:
    """A task with its release and due times (s) and its priority (larger is more urgent).

    ``after`` are ids of tasks that must be finished before this one's first visit is served.
    """

    task: Task
    release: float = 0.0
    due: float | None = None
    priority: float = 0.0
    after: tuple[str, ...] = ()

    @property
    def visits(self) -> tuple[Visit, ...]:
        """Visits of the task; the first one waits as the order does, the last one is due."""
        if not self.task.visits:
            return ()
        first, *rest = self.task.visits
        begin = max(first.not_before, self.release)
        visits = [replace(first, not_before=begin, after=(*first.after, *self.after)), *rest]
        if self.due is not None:
            visits[-1] = replace(visits[-1], due=self.due)
        return tuple(visits)
