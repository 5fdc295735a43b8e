"""Who does which task when robots are choosy or have few seats."""

from collections.abc import Sequence

from clearway.protocols import AssignmentProblem, Routes


def even_seats(problem: AssignmentProblem) -> int:
    """Return how many tasks a robot may have in an even split.

    Where the tasks do not divide by the robots, tasks of no cost are thought to make up the
    number, so a robot may have fewer than this.
    """
    return -(-len(problem.tasks) // max(len(problem.robots), 1))


def reseat(
    problem: AssignmentProblem, routes: Sequence[Sequence[int]], seats: int
) -> Routes | None:
    """Return the routes with as few changes as needed for every task to be where it may be.

    Tasks whose robot may not do them move, in augmenting paths, to robots that may and have
    at most ``seats`` tasks; a task that gives way leaves its place in the route to the
    newcomer. ``None`` if there is no such assignment.
    """
    tours = [[t for t in route if problem.allowed[k, t]] for k, route in enumerate(routes)]
    for k, route in enumerate(routes):
        for task in route:
            if not problem.allowed[k, task] and not _seat(problem, tours, task, seats, set()):
                return None
    return tuple(map(tuple, tours))


def unseated(problem: AssignmentProblem, seats: int) -> tuple[str, ...]:
    """Return why robots with this many seats cannot hold all tasks; empty if they can."""
    tours: list[list[int]] = [[] for _ in problem.robots]
    for number, task in enumerate(problem.tasks):
        tried: set[int] = set()
        if not _seat(problem, tours, number, seats, tried):
            full = ", ".join(problem.robots[k] for k in sorted(tried))
            return (
                f"an even split gives a robot at most {seats} tasks, and with task {task} "
                f"there are more than that only for {full}: use a free split",
            )
    return ()


def _seat(
    problem: AssignmentProblem, tours: list[list[int]], task: int, seats: int, tried: set[int]
) -> bool:
    """Seat a task, moving others on if need be, without trying a robot twice."""
    for k, tour in enumerate(tours):
        if not problem.allowed[k, task] or k in tried:
            continue
        tried.add(k)
        if len(tour) < seats:
            tour.append(task)
            return True
        for place, sitting in enumerate(tour):
            if _seat(problem, tours, sitting, seats, tried):
                tour[place] = task
                return True
    return False
