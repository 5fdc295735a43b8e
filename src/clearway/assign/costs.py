"""What it costs each robot of a scenario to go from task to task."""

from collections.abc import Sequence
from functools import cache
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

from clearway.model import LOAD_CHANGE, Footprint, Pose, Robot, Scenario, Task
from clearway.protocols import EQUAL_WEIGHTS, AssignmentProblem, Weights
from clearway.world.grid import Grid

Floats = NDArray[np.float64]

# Cells (m) and by how much they are let nearer to obstacles than half a body's width (m): the
# second ones find every straight passage that is as wide as the body.
CELLS = ((1.0, 0.0), (0.25, 0.125))


def build(scenario: Scenario, weights: Weights = EQUAL_WEIGHTS) -> AssignmentProblem:
    """Return the assignment problem of all orders of a scenario, in their order.

    Distances are shortest paths over 1 m cells that keep half the body's width from
    obstacles, for each robot type and load state; where these leave a task without a way,
    over finer cells. They are those of the fastest type; slower ones have longer ways, which
    take it as long. Turns are differences of heading. Release times are left to planning.

    Raises
    ------
    ValueError
        If no robot can do some task, or go from one task to another that it may both do; the
        message names them and says what keeps each robot from it.
    """
    tasks = [order.task for order in scenario.orders]
    firsts = [task.visits[0].pose for task in tasks]
    lasts = [task.visits[-1].pose for task in tasks]
    starts = [robot.start for robot in scenario.robots]
    m, n = len(starts), len(tasks)
    speeds = {robot.type: scenario.type_of(robot).limits.speed for robot in scenario.robots}
    fastest = max(speeds.values(), default=1.0)
    start, between, inner = np.zeros((m, n)), np.zeros((m, n, n)), np.zeros((m, n))
    for name in sorted({robot.type for robot in scenario.robots}):
        like = [k for k, robot in enumerate(scenario.robots) if robot.type == name]
        for cell, relief in CELLS:
            start[like], between[like], inner[like] = _distances(
                scenario, name, [starts[k] for k in like], tasks, cell, relief
            )
            if all(np.isfinite(ways[like]).all() for ways in (start, between, inner)):
                break
        for ways in (start, between, inner):
            ways[like] *= fastest / speeds[name]
    allowed = _allowed(scenario, tasks, start, inner)
    _refuse_dead_ends(tasks, allowed, between)
    number = {task.id: j for j, task in enumerate(tasks)}
    return AssignmentProblem(
        robots=tuple(robot.id for robot in scenario.robots),
        tasks=tuple(task.id for task in tasks),
        start_to_task=start,
        task_to_task=between,
        start_turn=_turns(starts, firsts),
        task_turn=_turns(lasts, firsts),
        inner=inner,
        allowed=allowed,
        weights=weights,
        speed=fastest,
        service=np.array([sum(visit.service for visit in task.visits) for task in tasks]),
        due=np.array([np.inf if o.due is None else o.due for o in scenario.orders]),
        before=tuple(
            (number[other], j) for j, order in enumerate(scenario.orders) for other in order.after
        ),
    )


def half_width(footprint: Footprint) -> float:
    """Return half the lesser extent of a body (m), which it needs to drive along a wall."""
    if footprint.radius:
        return footprint.radius
    points = np.array([point for part in footprint.parts for point in part])
    return float(np.ptp(points, axis=0).min()) / 2.0


def loads_after(task: Task) -> list[int]:
    """Return the number of loads on board after each visit."""
    return list(accumulate(LOAD_CHANGE[visit.load] for visit in task.visits))


def _distances(
    scenario: Scenario,
    type_name: str,
    starts: Sequence[Pose],
    tasks: Sequence[Task],
    cell: float,
    relief: float,
) -> tuple[Floats, Floats, Floats]:
    """Return the distances (m) that one robot type drives to, between and within tasks."""
    robot_type = scenario.robot_types[type_name]

    @cache
    def grid(loaded: bool) -> Grid:
        inflate = max(half_width(robot_type.shape(loaded)) - relief, 0.0)
        return Grid(scenario.site, type_name, loaded, inflate, cell)

    n = len(tasks)
    firsts = _positions([task.visits[0].pose for task in tasks])
    lasts = _positions([task.visits[-1].pose for task in tasks])
    start = grid(False).distances(_positions(starts), firsts)
    between, inner = np.zeros((n, n)), np.zeros(n)
    carrying = np.array([loads_after(task)[-1] > 0 for task in tasks], dtype=np.bool_)
    for loaded in (False, True):
        leaving = np.flatnonzero(carrying == loaded)
        if leaving.size:
            between[leaving] = grid(loaded).distances(lasts[leaving], firsts)
    for number, task in enumerate(tasks):
        for (here, there), load in zip(pairwise(task.visits), loads_after(task), strict=False):
            leg = grid(load > 0).distances(_positions([here.pose]), _positions([there.pose]))
            inner[number] += leg[0, 0]
    return start, between, inner


def _allowed(
    scenario: Scenario, tasks: Sequence[Task], start: Floats, inner: Floats
) -> NDArray[np.bool_]:
    """Return who may do what; refuse a task that nobody can do."""
    allowed = np.ones(start.shape, dtype=np.bool_)
    for j, task in enumerate(tasks):
        refusals = []
        for k, robot in enumerate(scenario.robots):
            refusal = _refusal(scenario, robot, task, float(start[k, j]), float(inner[k, j]))
            if refusal is not None:
                allowed[k, j] = False
                refusals.append(f"{robot.id} {refusal}")
        if not allowed[:, j].any():
            told = "; ".join(refusals) or "there are no robots"
            raise ValueError(f"no robot can do task {task.id}: {told}")
    return allowed


def _refuse_dead_ends(tasks: Sequence[Task], allowed: NDArray[np.bool_], between: Floats) -> None:
    """Refuse two tasks that some robots may do, but none the one after the other."""
    may = np.zeros((len(tasks), len(tasks)), dtype=np.bool_)
    can = np.eye(len(tasks), dtype=np.bool_)
    for ours, ways in zip(allowed, between, strict=True):
        both = ours[:, None] & ours[None, :]
        may |= both
        can |= both & np.isfinite(ways)
    for i, j in np.argwhere(may & ~can):
        first, second = tasks[i].id, tasks[j].id
        raise ValueError(
            f"no robot finds a way from task {first} to task {second}, though each alone is "
            f"reachable; widen the passage, or keep the tasks for different robots"
        )


def _refusal(
    scenario: Scenario, robot: Robot, task: Task, start: float, inner: float
) -> str | None:
    """Return why a robot cannot do a task, or ``None``."""
    robot_type = scenario.type_of(robot)
    if task.robot is not None and task.robot != robot.id:
        return f"is not {task.robot}, for whom the task is kept"
    for visit in task.visits:
        if visit.needs is not None and visit.needs not in robot_type.capabilities:
            return f"has not the capability {visit.needs}"
    if max(loads_after(task)) > robot_type.capacity:
        return f"carries at most {robot_type.capacity} loads"
    if not np.isfinite(start):
        x, y, _ = task.visits[0].pose
        return f"finds no way from its start to ({x:g}, {y:g})"
    if not np.isfinite(inner):
        return "finds no way from visit to visit of the task"
    return None


def _positions(poses: Sequence[Pose]) -> Floats:
    return np.array([(pose.x, pose.y) for pose in poses], dtype=np.float64).reshape(-1, 2)


def _turns(here: Sequence[Pose], there: Sequence[Pose]) -> Floats:
    """Return absolute differences of heading (rad), wrapped into [0, pi]."""
    before = np.array([pose.theta for pose in here], dtype=np.float64)
    after = np.array([pose.theta for pose in there], dtype=np.float64)
    difference = np.abs(after[None, :] - before[:, None]) % (2.0 * np.pi)
    wrapped: Floats = np.minimum(difference, 2.0 * np.pi - difference)
    return wrapped
