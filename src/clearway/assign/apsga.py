"""Particle swarm whose particles breed and whose coefficients adapt."""

from dataclasses import dataclass, field

from clearway.assign.breeding import BreedingParams
from clearway.assign.flight import Coefficients
from clearway.assign.parameters import check_amount
from clearway.assign.swarm import SwarmParams, SwarmTrace, search, unencodable
from clearway.protocols import AssignmentProblem, Routes


@dataclass(frozen=True)
class AdaptationParams:
    """How coefficients change over a run (A-16; eq. 18 and after).

    Parameters
    ----------
    w_max, w_min
        Inertia that is aimed at in the beginning and in the end.
    gamma
        What is added to the inertia when all positions are as good as the best; more keeps a
        swarm that has drawn together moving.
    c_max, c_min
        The pull of a particle's own best falls from the first to the second, that of the
        swarm's best rises from the second to the first.
    is_confined
        Keep the inertia in [w_min, w_max], which the printed sum leaves (EA-5).
    """

    w_max: float = 1.0
    w_min: float = 0.0
    gamma: float = 0.2
    c_max: float = 2.5
    c_min: float = 0.5
    is_confined: bool = False

    def __post_init__(self) -> None:
        for name in ("w_max", "w_min", "gamma", "c_max", "c_min"):
            check_amount(name, getattr(self, name))
        for letter in "wc":
            low, high = getattr(self, f"{letter}_min"), getattr(self, f"{letter}_max")
            if low > high:
                raise ValueError(f"{letter}_min must be at most {letter}_max = {high}, got {low}")

    def coefficients(self, progress: float, best: float, mean: float) -> Coefficients:
        """Return the coefficients at t/T = ``progress``.

        ``best`` is the least value found, ``mean`` that of the present positions; where all
        are 0 they are as good as the best.
        """
        inertia = self.w_max - (self.w_max - self.w_min) * progress
        inertia += self.gamma * (best / mean if mean > 0.0 else 1.0)
        if self.is_confined:
            inertia = min(max(inertia, self.w_min), self.w_max)
        shift = (self.c_max - self.c_min) * progress
        return Coefficients(inertia, self.c_max - shift, self.c_min + shift)


@dataclass(frozen=True)
class ApsgaParams:
    """Parameters of APSGA; ``LITERAL`` breeding takes the paper to the letter."""

    swarm: SwarmParams = field(default_factory=SwarmParams)
    breeding: BreedingParams = field(default_factory=BreedingParams)
    adaptation: AdaptationParams = field(default_factory=AdaptationParams)


class Apsga:
    """Adaptive particle swarm with crossover and mutation: the paper's Algorithm 1.

    References
    ----------
    Zhang, L. et al. An enhanced hybrid metaheuristic for hierarchical scheduling in 4WIDS
    multi-robot systems under confined environments. Control Engineering Practice.

    Deviations
    ----------
    What the paper leaves open is chosen: parents are personal bests and a child must be
    better than the position it replaces (``ELITIST``); positions stay within [0, n - 1]; a
    tenth of the children is mutated; what both fragments of a crossover cover is exchanged twice,
    so not at all. Where the tasks do not divide by the robots, tasks of no
    cost make up the number.
    """

    def __init__(self, params: ApsgaParams = ApsgaParams()) -> None:
        self.params = params

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        return self.trace(problem, seed).routes

    def trace(self, problem: AssignmentProblem, seed: int) -> SwarmTrace:
        """Return the routes with what they are worth and how they were found."""
        params = self.params
        return search(problem, seed, params.swarm, params.adaptation.coefficients, params.breeding)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why permutations cannot encode the problem."""
        return unencodable(problem)
