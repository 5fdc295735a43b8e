"""The joint between a scenario's work and the algorithms that share it out."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Routes = tuple[tuple[int, ...], ...]
Scalar = TypeVar("Scalar", bound=np.generic)


@dataclass(frozen=True)
class Weights:
    """What a metre of the longest route, one of any, a radian of turn and a second late cost."""

    max_distance: float = 1.0
    total_distance: float = 1.0
    turning: float = 1.0
    tardiness: float = 1.0

    def __post_init__(self) -> None:
        for name in ("max_distance", "total_distance", "turning", "tardiness"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0.0):
                raise ValueError(f"weight {name} must be 0 or above and finite, got {value}")


EQUAL_WEIGHTS = Weights()


@dataclass(frozen=True, eq=False)
class AssignmentProblem:
    """m robots, n tasks and what it costs to go from one to the next.

    Arrays are copied, made read-only and spread to the shapes below, so a matrix of shape
    ``(n, n)`` serves robots that all drive alike. Robots of unlike speeds have distances as the
    fastest would drive them in the same time, so that routes of equal length take equally long.

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
    speed
        At which all distances are driven (m/s).
    service
        Time (s) that the visits of each task take, ``(n,)``.
    due
        When each task is to be finished (s), ``(n,)``; infinite where that does not matter.
    before
        Pairs of tasks of which the first must be finished before the second begins.
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
    speed: float = 1.0
    service: Floats = field(default_factory=lambda: np.zeros(()))
    due: Floats = field(default_factory=lambda: np.full((), np.inf))
    before: tuple[tuple[int, int], ...] = ()

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
            ("service", (n,)),
            ("due", (n,)),
        ):
            costs = _spread(np.array(getattr(self, name), dtype=np.float64), shape, name)
            wrong = np.argwhere(~(costs >= 0.0))
            if len(wrong):
                place = tuple(int(i) for i in wrong[0])
                raise ValueError(f"{name}{list(place)} must be 0 or above, got {costs[place]}")
            object.__setattr__(self, name, costs)
        for name in ("start_turn", "task_turn", "service"):
            if not np.isfinite(getattr(self, name)).all():
                raise ValueError(f"{name} must be finite")
        allowed = _spread(np.array(self.allowed, dtype=np.bool_), (m, n), "allowed")
        allowed = allowed & np.isfinite(self.start_to_task) & np.isfinite(self.inner)
        allowed.flags.writeable = False
        object.__setattr__(self, "allowed", allowed)
        for task in np.flatnonzero(~allowed.any(axis=0)):
            raise ValueError(f"no robot may do task {self.tasks[task]}; allow or drop it")
        if not (np.isfinite(self.speed) and self.speed > 0.0):
            raise ValueError(f"speed must be above 0 and finite, got {self.speed}")
        self._check_before()

    def _check_before(self) -> None:
        n = len(self.tasks)
        for first, second in self.before:
            if not (0 <= first < n and 0 <= second < n):
                raise ValueError(f"before names tasks {first} and {second}, but there are {n}")
        circle = find_circle(self.before)
        if circle:
            told = " before ".join(self.tasks[task] for task in (*circle, circle[0]))
            raise ValueError(f"tasks wait for each other: {told}; drop one of these")

    @property
    def is_timed(self) -> bool:
        """Whether it matters when tasks are done: some are due, or must wait for others."""
        return bool(self.before) or bool(np.isfinite(self.due).any())


@dataclass(frozen=True)
class Objective:
    """The value of a set of routes (to be minimised) and its terms (m, m, rad, s)."""

    value: float
    max_distance: float
    total_distance: float
    turning: float
    tardiness: float = 0.0


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
    """Return longest route, sum of routes, of turns and of delays, weighted and apart.

    A route begins at the robot's start and ends at its last task; an empty one has length 0.

    Raises
    ------
    ValueError
        If a task is left out, done twice or given to a robot that may not do it, or if routes
        wait for each other.
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
    late = 0.0
    if problem.is_timed:
        late = float(np.maximum(finish_times(problem, routes) - problem.due, 0.0).sum())
    return Objective(
        value=weights.max_distance * longest
        + weights.total_distance * total
        + weights.turning * turning
        + weights.tardiness * late,
        max_distance=longest,
        total_distance=total,
        turning=turning,
        tardiness=late,
    )


def finish_times(problem: AssignmentProblem, routes: Sequence[Sequence[int]]) -> Floats:
    """Return when each task is finished (s), if everybody sets out at once and nobody is met.

    A robot drives up to a task's first visit and waits there until all tasks that must be
    finished before are.

    Raises
    ------
    ValueError
        If routes wait for each other; names the tasks.
    """
    follows = [pair for route in routes for pair in pairwise(route)]
    circle = find_circle((*problem.before, *follows))
    if circle:
        told = ", ".join(problem.tasks[task] for task in circle)
        raise ValueError(f"routes wait for each other at {told}")
    waits: dict[int, list[int]] = {}
    for first, second in problem.before:
        waits.setdefault(second, []).append(first)
    done = np.full(len(problem.tasks), np.nan)
    ahead = [list(route) for route in routes]
    at: list[int | None] = [None] * len(ahead)
    while any(ahead):
        for robot, route in enumerate(ahead):
            while route and not np.isnan(done[waits.get(route[0], [])]).any():
                task, here = route.pop(0), at[robot]
                came = (
                    problem.start_to_task[robot, task] / problem.speed
                    if here is None
                    else done[here] + problem.task_to_task[robot, here, task] / problem.speed
                )
                begin = max(came, *done[waits.get(task, [])], 0.0)
                done[task] = begin + problem.inner[robot, task] / problem.speed
                done[task] += problem.service[task]
                at[robot] = task
    return done


def find_circle(pairs: Sequence[tuple[int, int]]) -> list[int]:
    """Return numbers that follow each other round in a circle, or nothing."""
    after: dict[int, list[int]] = {}
    for first, second in pairs:
        after.setdefault(first, []).append(second)
    seen: set[int] = set()
    for root in after:
        path: list[int] = []
        left = [(root, 0)]
        while left:
            number, depth = left.pop()
            del path[depth:]
            if number in path:
                return path[path.index(number) :]
            if number in seen:
                continue
            seen.add(number)
            path.append(number)
            left += [(follower, depth + 1) for follower in after.get(number, ())]
    return []


def _spread(array: NDArray[Scalar], shape: tuple[int, ...], name: str) -> NDArray[Scalar]:
    try:
        return np.broadcast_to(array, shape)
    except ValueError:
        raise ValueError(f"{name} must have shape {shape}, got {array.shape}") from None
