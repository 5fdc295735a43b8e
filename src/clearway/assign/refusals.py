"""Kinds of problem that some assigners cannot take, each refusal with a mend."""

import numpy as np

from clearway.protocols import AssignmentProblem

ANY_PAIRS = "use InsertionLocalSearch, for an even split with InsertionParams(even=True)"


def timed(problem: AssignmentProblem) -> tuple[str, ...]:
    """Return why an assigner that knows no time cannot take the problem."""
    if not problem.is_timed:
        return ()
    what = []
    due = np.flatnonzero(np.isfinite(problem.due))
    if due.size:
        what.append(f"task {problem.tasks[due[0]]} has a due time")
    if problem.before:
        first, second = (problem.tasks[task] for task in problem.before[0])
        what.append(f"task {second} waits for task {first}")
    return (
        f"{' and '.join(what)}, but this assigner knows no time: "
        "leave out due and before, or use RuinRecreate",
    )


def choosy(problem: AssignmentProblem) -> tuple[str, ...]:
    """Return why an encoding in which any robot does any task in any order does not fit."""
    forbidden = np.argwhere(~problem.allowed)
    if len(forbidden):
        robot, task = forbidden[0]
        what = f"robot {problem.robots[robot]} may not do task {problem.tasks[task]}"
        return (f"{what}, but a permutation lets any robot do any: {ANY_PAIRS}",)
    apart = ~np.eye(len(problem.tasks), dtype=np.bool_)
    cut_off = np.argwhere(~np.isfinite(problem.task_to_task) & apart)
    if len(cut_off):
        robot, first, second = cut_off[0]
        what = (
            f"robot {problem.robots[robot]} finds no way from task {problem.tasks[first]} "
            f"to task {problem.tasks[second]}"
        )
        return (f"{what}, but a permutation puts tasks in any order: {ANY_PAIRS}",)
    return ()
