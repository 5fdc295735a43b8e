"""An assignment problem handed to the native core."""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from clearway import _core
from clearway.protocols import AssignmentProblem, Routes

Floats = NDArray[np.float64]


def native_costs(problem: AssignmentProblem) -> _core.AssignmentCosts:
    """Return the problem's costs as the core reads them; robots that drive alike share a table."""
    kind, models = _kinds(problem)
    weights = problem.weights
    return _core.AssignmentCosts(
        kind=kind,
        start=np.ascontiguousarray(problem.start_to_task),
        start_turn=np.ascontiguousarray(problem.start_turn),
        between=np.ascontiguousarray(problem.task_to_task[models]),
        turn=np.ascontiguousarray(problem.task_turn),
        inner=np.ascontiguousarray(problem.inner),
        allowed=np.ascontiguousarray(problem.allowed, dtype=np.uint8),
        weights=(
            weights.max_distance,
            weights.total_distance,
            weights.turning,
            weights.tardiness,
        ),
        speed=problem.speed,
        service=np.ascontiguousarray(problem.service),
        due=np.ascontiguousarray(problem.due),
        before=problem.before,
    )


def values(costs: _core.AssignmentCosts, orders: ArrayLike, cuts: ArrayLike) -> Floats:
    """Return the objective of many sets of routes at once, each as ``objective`` values it.

    Parameters
    ----------
    orders
        All tasks in some order, one row per set, ``(num_sets, num_tasks)``.
    cuts
        Robot k has the tasks from ``cuts[k]`` up to ``cuts[k + 1]`` of the order. One row per
        set, ``(num_sets, num_robots + 1)``, or one for all, ``(num_robots + 1,)``.

    Returns
    -------
    NDArray
        Values, ``(num_sets,)``; infinite where a robot may not do one of its tasks, a leg has
        no way, or routes wait for each other.

    Raises
    ------
    ValueError
        If an order leaves out a task or cuts do not rise from 0 to the number of tasks.
    """
    return np.array(
        costs.values(
            np.ascontiguousarray(orders, dtype=np.int32), np.ascontiguousarray(cuts, dtype=np.int32)
        )
    )


def require_ways(problem: AssignmentProblem, routes: Routes) -> Routes:
    """Return the routes if every leg of theirs can be driven.

    Raises
    ------
    ValueError
        If a leg has no way; names the robot and the tasks.
    """
    for k, route in enumerate(routes):
        for here, there in pairwise(route):
            if not np.isfinite(problem.task_to_task[k, here, there]):
                raise ValueError(
                    f"no routes found without a leg that has no way: robot {problem.robots[k]} "
                    f"cannot go from task {problem.tasks[here]} to {problem.tasks[there]}"
                )
    return routes


def _kinds(problem: AssignmentProblem) -> tuple[list[int], list[int]]:
    """Return each robot's kind, and one robot of each kind."""
    kind: list[int] = []
    models: list[int] = []
    for k in range(len(problem.robots)):
        for number, model in enumerate(models):
            if np.array_equal(problem.inner[k], problem.inner[model]) and np.array_equal(
                problem.task_to_task[k], problem.task_to_task[model]
            ):
                kind.append(number)
                break
        else:
            kind.append(len(models))
            models.append(k)
    return kind, models
