"""Memetic swarm for even splits: the default for the paper's problem (A-21)."""

from clearway import _core
from clearway.assign.first_routes import first_routes
from clearway.assign.native import native_costs, require_ways
from clearway.assign.split import even_seats, unseated
from clearway.protocols import AssignmentProblem, Routes

MemeticParams = _core.MemeticParams


class MemeticApsga:
    """Adaptive swarm and genetic hybrid whose children descend, for even splits.

    A child has each coordinate from its particle's best, from the best of all or from the
    particle, mended to a permutation; parts of two children change sides, coordinates mutate;
    then the child descends over pair swaps, moves and reversals within a robot and exchanges of
    equally long tails, first improvement first. It replaces the particle if it is better. One
    particle begins with tasks dealt out in order, the others at random.

    References
    ----------
    Zhang, L. et al. An enhanced hybrid metaheuristic for hierarchical scheduling in 4WIDS
    multi-robot systems under confined environments. Control Engineering Practice.

    Deviations
    ----------
    Task numbers have no metric, so coordinates are inherited instead of moved (eq. 16), and
    there is no descent in the paper. Where the tasks do not divide by the robots, tasks of no
    cost make up the number.
    """

    def __init__(self, params: MemeticParams | None = None) -> None:
        self.params = params or MemeticParams()

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        if not problem.tasks:
            return ((),) * len(problem.robots)
        seats = even_seats(problem)
        start = first_routes(problem, seats)
        costs = native_costs(problem)
        routes = _core.swarm_memetically(costs, seats, start, self.params, seed).routes
        return require_ways(problem, tuple(map(tuple, routes)))

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why there is no even split, if there is none."""
        return unseated(problem, even_seats(problem))
