"""Tasks taken out of routes and put back where they cost least, thousands of times."""

from clearway import _core
from clearway.assign.first_routes import first_routes
from clearway.assign.native import native_costs, require_ways
from clearway.assign.split import even_seats, unseated
from clearway.protocols import AssignmentProblem, Routes

RuinRecreateParams = _core.RuinRecreateParams


class RuinRecreate:
    """Ruin and recreate with annealed acceptance, in the core.

    Strings of tasks of neighbouring routes are taken out, or tasks near each other, or any;
    they are put back one by one where they cost least, some places overlooked. Robots
    may be unlike, pairs forbidden, tasks due or waiting for each other.

    Parameters
    ----------
    even
        Equal tours (shorter for some where the number does not divide) instead of free ones.

    References
    ----------
    Schrimpf, G. et al. (2000). Record breaking optimization results using the ruin and
    recreate principle. Journal of Computational Physics 159. doi:10.1006/jcph.1999.6413

    Christiaens, J., Vanden Berghe, G. (2020). Slack induction by string removals for vehicle
    routing problems. Transportation Science 54. doi:10.1287/trsc.2019.0914

    Deviations
    ----------
    The longest route counts in the price of every place; a quarter of the ruins begin at it.
    One place in fifty is overlooked: one in ten (A-22) measured worse on free splits.
    """

    def __init__(self, even: bool = False, params: RuinRecreateParams | None = None) -> None:
        self.even = even
        self.params = params or RuinRecreateParams()

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        n = len(problem.tasks)
        if n == 0:
            return ((),) * len(problem.robots)
        seats = even_seats(problem) if self.even else n
        start = first_routes(problem, seats)
        costs = native_costs(problem)
        routes = _core.ruin_recreate(costs, start, seats, self.params, seed)
        return require_ways(problem, tuple(map(tuple, routes)))

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why there is no even split, if one is asked for."""
        return unseated(problem, even_seats(problem)) if self.even else ()
