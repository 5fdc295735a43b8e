"""The assigner that suits a problem: proven where it is small, else the best search we have."""

from clearway.assign.exact import ExactAssigner
from clearway.assign.memetic import MemeticApsga
from clearway.assign.ruin_recreate import RuinRecreate
from clearway.protocols import Assigner, AssignmentProblem, Routes

# Tasks up to which the exact solver ends in milliseconds, and the memetic swarm is the better one.
MOST_EXACT, MOST_MEMETIC = 16, 32


class AutomaticAssigner:
    """Chooses the exact solver, the memetic swarm (even splits) or ruin and recreate.

    Parameters
    ----------
    even
        Give every robot the same number of tasks; otherwise any.
    """

    def __init__(self, even: bool = False) -> None:
        self.even = even

    def chosen(self, problem: AssignmentProblem) -> Assigner:
        """Return the assigner that a problem is given to."""
        exact = ExactAssigner(even=self.even)
        if len(problem.tasks) <= MOST_EXACT and not exact.unsupported(problem):
            return exact
        if self.even and len(problem.tasks) <= MOST_MEMETIC and not problem.is_timed:
            return MemeticApsga()
        return RuinRecreate(even=self.even)

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        return self.chosen(problem)(problem, seed)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why there is no even split, if there is none."""
        return self.chosen(problem).unsupported(problem)
