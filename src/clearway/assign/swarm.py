"""The loop that PSO, PSGA and APSGA share (A-17)."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from clearway.assign.breeding import BreedingParams, breed
from clearway.assign.evaluation import Evaluation
from clearway.assign.flight import Coefficients, FlightParams, fly
from clearway.assign.parameters import check_effort
from clearway.assign.permutation import decode, random_population, repair, round_randomly
from clearway.assign.refusals import choosy, timed
from clearway.assign.split import even_seats
from clearway.protocols import AssignmentProblem, Objective, Routes, objective

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class SwarmParams:
    """Effort of a swarm, and how its particles fly.

    Parameters
    ----------
    particles, iterations
        Size of the swarm and steps that it makes (N and T); more of either find better
        routes.
    """

    particles: int = 30
    iterations: int = 200
    flight: FlightParams = field(default_factory=FlightParams)

    def __post_init__(self) -> None:
        check_effort("particles", self.particles, 1)
        check_effort("iterations", self.iterations, 0)


@dataclass(frozen=True)
class SwarmTrace:
    """What a run found, and how.

    Parameters
    ----------
    evaluations
        Permutations priced.
    history
        Least value found at the start and after each iteration.
    padding
        Tasks of no cost that made up the number to a multiple of the robots'.
    """

    routes: Routes
    objective: Objective
    evaluations: int
    history: tuple[float, ...]
    padding: int


def search(
    problem: AssignmentProblem,
    seed: int,
    params: SwarmParams,
    coefficients: Callable[[float, float, float], Coefficients],
    breeding: BreedingParams | None = None,
) -> SwarmTrace:
    """Let a swarm look for an even split of least value.

    Parameters
    ----------
    coefficients
        Gives those of the next step from the share of iterations done, the least value found
        and the mean value of the present positions.
    breeding
        ``None`` for none.

    Raises
    ------
    ValueError
        If the problem is not supported.
    """
    evaluation, rng = take(problem), np.random.default_rng(seed)

    def price(population: Ints) -> Floats:
        return evaluation(population).value

    positions = random_population(rng, params.particles, padded_length(problem))
    velocities = np.zeros(positions.shape)
    value = price(positions)
    bests, least = positions, value
    history = [float(least.min())]
    for done in range(params.iterations):
        step = coefficients(done / params.iterations, history[-1], float(value.mean()))
        leader = bests[least.argmin()]
        moved, velocities = fly(rng, params.flight, step, positions, velocities, bests, leader)
        positions = repair(rng, round_randomly(rng, moved))
        if breeding is None:
            value = price(positions)
        else:
            positions, value = breed(rng, breeding, positions, bests, price)
        is_better = value < least
        bests = np.where(is_better[:, None], positions, bests)
        least = np.where(is_better, value, least)
        history.append(float(least.min()))
    return trace_of(problem, bests[least.argmin()], evaluation, history)


def unencodable(problem: AssignmentProblem) -> tuple[str, ...]:
    """Return why permutations of tasks cannot stand for all routes of a problem, and them only."""
    return timed(problem) + choosy(problem)


def take(problem: AssignmentProblem) -> Evaluation:
    """Return the evaluation of a problem that permutations can encode; refuse another."""
    reasons = unencodable(problem)
    if reasons:
        raise ValueError(reasons[0])
    return Evaluation(problem)


def padded_length(problem: AssignmentProblem) -> int:
    """Return the length of permutations in which all robots have equally many seats (A-6)."""
    return len(problem.robots) * even_seats(problem)


def trace_of(
    problem: AssignmentProblem, permutation: Ints, evaluation: Evaluation, history: list[float]
) -> SwarmTrace:
    """Return the trace of a run that ended with a permutation."""
    routes = decode(permutation, len(problem.robots), len(problem.tasks))
    return SwarmTrace(
        routes=routes,
        objective=objective(problem, routes),
        evaluations=evaluation.count,
        history=tuple(history),
        padding=len(permutation) - len(problem.tasks),
    )
