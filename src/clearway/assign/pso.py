"""Particle swarm on permutations."""

from dataclasses import dataclass, field

from clearway.assign.flight import Coefficients
from clearway.assign.swarm import SwarmParams, SwarmTrace, search, unencodable
from clearway.protocols import AssignmentProblem, Routes


@dataclass(frozen=True)
class PsoParams:
    """Parameters of PSO; the coefficients stay as they are for the whole run."""

    swarm: SwarmParams = field(default_factory=SwarmParams)
    coefficients: Coefficients = field(default_factory=Coefficients)


class Pso:
    """Particles that fly over task numbers, are rounded by chance and mended (A-9 to A-12).

    References
    ----------
    Kennedy, J., Eberhart, R. (1995). Particle swarm optimization. ICNN'95.
    doi:10.1109/ICNN.1995.488968

    Clerc, M., Kennedy, J. (2002). The particle swarm: explosion, stability, and convergence
    in a multidimensional complex space. IEEE Transactions on Evolutionary Computation 6.
    doi:10.1109/4235.985692 (the coefficients)
    """

    def __init__(self, params: PsoParams = PsoParams()) -> None:
        self.params = params

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        return self.trace(problem, seed).routes

    def trace(self, problem: AssignmentProblem, seed: int) -> SwarmTrace:
        """Return the routes with what they are worth and how they were found."""
        return search(problem, seed, self.params.swarm, lambda *_: self.params.coefficients)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why permutations cannot encode the problem."""
        return unencodable(problem)
