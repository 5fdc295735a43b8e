"""Proven optima of problems with few tasks."""

from clearway import _core
from clearway.assign.first_routes import first_routes
from clearway.assign.native import native_costs, require_ways
from clearway.assign.split import even_seats, unseated
from clearway.protocols import AssignmentProblem, Routes

MOST_TASKS = 16
# Rounds of ruin and recreate per task: the better the first answer, the fewer routes are listed.
FIRST_ROUNDS = 60


class ExactAssigner:
    """The best routes there are, for up to 16 tasks (A-20), in the core.

    All routes that might be part of something better than a good first answer are listed,
    those that are neither shortest nor cheapest for their tasks left out; then they are put
    together under prices of the tasks, with the length of the longest route cut into intervals.

    Parameters
    ----------
    even
        Equal tours (shorter for some where the number does not divide) instead of free ones.

    References
    ----------
    Baldacci, R., Christofides, N., Mingozzi, A. (2008). An exact algorithm for the vehicle
    routing problem based on the set partitioning formulation with additional cuts. Mathematical
    Programming 115. doi:10.1007/s10107-007-0178-5
    """

    def __init__(self, even: bool = True) -> None:
        self.even = even

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot, of the least objective; the seed breaks ties."""
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        n = len(problem.tasks)
        if n == 0:
            return ((),) * len(problem.robots)
        seats = even_seats(problem) if self.even else n
        costs = native_costs(problem)
        first = _core.RuinRecreateParams(rounds=FIRST_ROUNDS * n)
        start = _core.ruin_recreate(costs, first_routes(problem, seats), seats, first, seed)
        routes = _core.solve_exactly(costs, seats, start).routes
        return require_ways(problem, tuple(map(tuple, routes)))

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return that there are too many tasks, that they are timed, or no even split."""
        n = len(problem.tasks)
        reasons = []
        if n > MOST_TASKS:
            reasons.append(
                f"{n} tasks are more than the {MOST_TASKS} that can be proven optimal: "
                "use RuinRecreate, or MemeticApsga for an even split"
            )
        if problem.is_timed:
            reasons.append("due times and tasks that wait for others are not proven optimal")
        if self.even:
            reasons += unseated(problem, even_seats(problem))
        return tuple(reasons)
