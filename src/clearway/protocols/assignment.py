"""The joint between a scenario's work and the algorithms that share it out."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Routes = tuple[tuple[int, ...], ...]
Scalar = TypeVar("Scalar", bound=np.generic)


@dataclass(frozen=True)
class Weights:
    """What a metre of the longest route, a metre of any route and a radian of turning cost."""

    max_distance: float = 1.0
    total_distance: float = 1.0
    turning: float = 1.0

    def __post_init__(self) -> None:
        for name in ("max_distance", "total_distance", "turning"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0.0):
                raise ValueError(f"weight {name} must be 0 or above and finite, got {value}")


EQUAL_WEIGHTS = Weights()


@dataclass(frozen=True, eq=False)
class AssignmentProblem:
    """m robots, n tasks and what it costs to go from one to the next.

    Arrays are copied, made read-only and spread to the shapes below, so a matrix of shape
    ``(n, n)`` serves robots that all drive alike.

    Parameters
    ----------
    robots, tasks
        Ids; a route is a tuple of positions in ``tasks``.
    start_to_task
        Distance (m) from each robot's start to each task's first visit, ``(m, n)``;
        infinite where there is no way.
    task_to_task
        Distance (m) from the last visit of one task to the first of the next for each
        robot, ``(m, n, n)``.
    start_turn, task_turn
        Absolute difference of headings (rad) over the same legs, ``(m, n)`` and ``(n, n)``.
    inner
        Distance (m) within each task, from its first visit to its last, ``(m, n)``.
    allowed
        Whether a robot may do a task, ``(m, n)``; an infinite ``start_to_task`` or
        ``inner`` forbids it too.
    """

    robots: tuple[str, ...]
    tasks: tuple[str, ...]
    start_to_task: Floats
    task_to_task: Floats
    start_turn: Floats
    task_turn: Floats
    inner: Floats = field(default_factory=lambda: np.zeros(()))
    allowed: Bools = field(default_factory=lambda: np.ones((), dtype=np.bool_))
    weights: Weights = EQUAL_WEIGHTS

    def __post_init__(self) -> None:
        for name in ("robots", "tasks"):
            ids = getattr(self, name)
            double = sorted({i for i in ids if ids.count(i) > 1})
            if double:
                raise ValueError(f"{name} need ids of their own; {', '.join(double)} occurs twice")
        m, n = len(self.robots), len(self.tasks)
        for name, shape in (
            ("start_to_task", (m, n)),
            ("task_to_task", (m, n, n)),
            ("start_turn", (m, n)),
            ("task_turn", (n, n)),
            ("inner", (m, n)),
        ):
            costs = _spread(np.array(getattr(self, name), dtype=np.float64), shape, name)
            wrong = np.argwhere(~(costs >= 0.0))
            if len(wrong):
                place = tuple(int(i) for i in wrong[0])
                raise ValueError(f"{name}{list(place)} must be 0 or above, got {costs[place]}")
            object.__setattr__(self, name, costs)
        for name in ("start_turn", "task_turn"):
            if not np.isfinite(getattr(self, name)).all():
                raise ValueError(f"{name} must be finite")
        allowed = _spread(np.array(self.allowed, dtype=np.bool_), (m, n), "allowed")
        allowed = allowed & np.isfinite(self.start_to_task) & np.isfinite(self.inner)
        allowed.flags.writeable = False
        object.__setattr__(self, "allowed", allowed)
        for task in np.flatnonzero(~allowed.any(axis=0)):
            raise ValueError(f"no robot may do task {self.tasks[task]}; allow or drop it")


@dataclass(frozen=True)
class Objective:
    """The value of a set of routes (to be minimised) and its terms (m, m, rad)."""

    value: float
    max_distance: float
    total_distance: float
    turning: float


class Assigner(Protocol):
    """Shares out tasks: an order of tasks for each robot, every task exactly once."""

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot, in the order of ``problem.robots``."""

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return reasons, fit for a person to act on, why the problem cannot be taken."""


def check_routes(problem: AssignmentProblem, routes: Sequence[Sequence[int]]) -> None:
    """Raise ``ValueError`` unless each task is done once, by a robot that may."""
    if len(routes) != len(problem.robots):
        raise ValueError(f"{len(problem.robots)} robots need as many routes, got {len(routes)}")
    done = [task for route in routes for task in route]
    for number, name in enumerate(problem.tasks):
        if done.count(number) != 1:
            raise ValueError(f"task {name} must be done once, not {done.count(number)} times")
    if len(done) != len(problem.tasks):
        strange = sorted(set(done) - set(range(len(problem.tasks))))
        raise ValueError(f"routes name tasks that do not exist: {strange}")
    for robot, route in enumerate(routes):
        for task in route:
            if not problem.allowed[robot, task]:
                raise ValueError(
                    f"robot {problem.robots[robot]} may not do task {problem.tasks[task]}"
                )


def objective(problem: AssignmentProblem, routes: Sequence[Sequence[int]]) -> Objective:
    """Return longest route, sum of routes and sum of turns, weighted and apart.

    A route begins at the robot's start and ends at its last task; an empty one has length 0.

    Raises
    ------
    ValueError
        If a task is left out, done twice or given to a robot that may not do it.
    """
    check_routes(problem, routes)
    lengths = [0.0]
    turning = 0.0
    for robot, route in enumerate(routes):
        length = 0.0
        for before, task in zip((None, *route), route, strict=False):
            if before is None:
                length += float(problem.start_to_task[robot, task])
                turning += float(problem.start_turn[robot, task])
            else:
                length += float(problem.task_to_task[robot, before, task])
                turning += float(problem.task_turn[before, task])
            length += float(problem.inner[robot, task])
        lengths.append(length)
    longest, total, weights = max(lengths), sum(lengths), problem.weights
    return Objective(
        value=weights.max_distance * longest
        + weights.total_distance * total
        + weights.turning * turning,
        max_distance=longest,
        total_distance=total,
        turning=turning,
    )


def _spread(array: NDArray[Scalar], shape: tuple[int, ...], name: str) -> NDArray[Scalar]:
    try:
        return np.broadcast_to(array, shape)
    except ValueError:
        raise ValueError(f"{name} must have shape {shape}, got {array.shape}") from None
