"""Least objective of a tiny assignment problem, by trying every order and every cut."""

from itertools import combinations_with_replacement, pairwise, permutations

from clearway.protocols import AssignmentProblem, find_circle, objective


def optimum(problem: AssignmentProblem, even: bool = False) -> float:
    """Return the least value over all legal routes; infinite where there are none."""
    m, n = len(problem.robots), len(problem.tasks)
    seats = -(-n // m) if even else n
    best = float("inf")
    for order in permutations(range(n)):
        for cuts in combinations_with_replacement(range(n + 1), m - 1):
            routes = [order[first:last] for first, last in pairwise((0, *cuts, n))]
            if all(
                len(route) <= seats and all(problem.allowed[k, task] for task in route)
                for k, route in enumerate(routes)
            ):
                best = min(best, _value(problem, routes))
    return best


def _value(problem: AssignmentProblem, routes: list[tuple[int, ...]]) -> float:
    """Return the objective; infinite where routes wait for each other."""
    if find_circle((*problem.before, *(pair for route in routes for pair in pairwise(route)))):
        return float("inf")
    return objective(problem, routes).value
