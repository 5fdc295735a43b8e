"""Legal routes to begin a search from."""

from clearway.assign.split import reseat, unseated
from clearway.protocols import AssignmentProblem, Routes


def first_routes(problem: AssignmentProblem, seats: int) -> Routes:
    """Return legal routes of at most ``seats`` tasks each, in an order that no task waits in vain.

    Raises
    ------
    ValueError
        If robots with this many seats cannot hold all tasks; says why.
    """
    m = len(problem.robots)
    order = _in_order(problem)
    routes = reseat(problem, [order[k::m] for k in range(m)], seats)
    if routes is None:
        raise ValueError(unseated(problem, seats)[0])
    rank = {task: place for place, task in enumerate(order)}
    return tuple(tuple(sorted(route, key=rank.__getitem__)) for route in routes)


def _in_order(problem: AssignmentProblem) -> list[int]:
    """Return all tasks, each after those that it must wait for."""
    waits = [0] * len(problem.tasks)
    followers: dict[int, list[int]] = {}
    for first, second in problem.before:
        waits[second] += 1
        followers.setdefault(first, []).append(second)
    order = [task for task, number in enumerate(waits) if number == 0]
    for task in order:
        for follower in followers.get(task, ()):
            waits[follower] -= 1
            if waits[follower] == 0:
                order.append(follower)
    return order
