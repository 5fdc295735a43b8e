"""Particle swarm whose particles breed."""

from dataclasses import dataclass, field

from clearway.assign.breeding import BreedingParams
from clearway.assign.flight import Coefficients
from clearway.assign.swarm import SwarmParams, SwarmTrace, search, unencodable
from clearway.protocols import AssignmentProblem, Routes


@dataclass(frozen=True)
class PsgaParams:
    """Parameters of PSGA; ``LITERAL`` breeding takes the paper to the letter."""

    swarm: SwarmParams = field(default_factory=SwarmParams)
    coefficients: Coefficients = field(default_factory=Coefficients)
    breeding: BreedingParams = field(default_factory=BreedingParams)


class Psga:
    """Particle swarm with crossover and mutation: APSGA without adaptation (A-17, A-19).

    References
    ----------
    Zhang, L. et al. An enhanced hybrid metaheuristic for hierarchical scheduling in 4WIDS
    multi-robot systems under confined environments. Control Engineering Practice.
    """

    def __init__(self, params: PsgaParams = PsgaParams()) -> None:
        self.params = params

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        return self.trace(problem, seed).routes

    def trace(self, problem: AssignmentProblem, seed: int) -> SwarmTrace:
        """Return the routes with what they are worth and how they were found."""
        params = self.params
        return search(problem, seed, params.swarm, lambda *_: params.coefficients, params.breeding)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why permutations cannot encode the problem."""
        return unencodable(problem)
