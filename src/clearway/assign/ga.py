"""Genetic algorithm on permutations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.assign.parameters import check_effort, check_share
from clearway.assign.permutation import crossover, mutate, random_population
from clearway.assign.swarm import (
    SwarmTrace,
    padded_length,
    take,
    trace_of,
    unencodable,
)
from clearway.protocols import AssignmentProblem, Routes

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class GaParams:
    """Parameters of the genetic algorithm.

    Parameters
    ----------
    individuals, generations
        Size of the population and times that it is replaced; more of either find better
        routes.
    p_crossover
        Share of pairs that exchange fragments; more mix the population faster.
    p_mutation
        Share of children in which two tasks change places; more scatter it.
    """

    individuals: int = 30
    generations: int = 200
    p_crossover: float = 0.9
    p_mutation: float = 0.1

    def __post_init__(self) -> None:
        check_effort("individuals", self.individuals, 1)
        check_effort("generations", self.generations, 0)
        check_share("p_crossover", self.p_crossover)
        check_share("p_mutation", self.p_mutation)


class Ga:
    """Roulette selection, crossover and mutation (A-12 to A-14); no elite survives (A-19).

    References
    ----------
    Goldberg, D. E. (1989). Genetic Algorithms in Search, Optimization and Machine Learning.
    Addison-Wesley.

    Deviations
    ----------
    Crossover and repair are those of the swarms.
    """

    def __init__(self, params: GaParams = GaParams()) -> None:
        self.params = params

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        return self.trace(problem, seed).routes

    def trace(self, problem: AssignmentProblem, seed: int) -> SwarmTrace:
        """Return the best routes of all generations and how they were found."""
        params = self.params
        evaluation, rng = take(problem), np.random.default_rng(seed)
        population = random_population(rng, params.individuals, padded_length(problem))
        value = evaluation(population).value
        best, history = population[value.argmin()], [float(value.min())]
        for _ in range(params.generations):
            parents = population[roulette(rng, value)]
            children = crossover(rng, parents, params.p_crossover)
            population = mutate(rng, children, params.p_mutation)
            value = evaluation(population).value
            if value.min() < history[-1]:
                best = population[value.argmin()]
            history.append(min(history[-1], float(value.min())))
        return trace_of(problem, best, evaluation, history)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why permutations cannot encode the problem."""
        return unencodable(problem)


def roulette(rng: np.random.Generator, value: Floats) -> Ints:
    """Draw as many parents as there are, each by how much better it is than the worst.

    Where all are alike they are drawn evenly.
    """
    merit = value.max() - value
    total = merit.sum()
    chance = merit / total if total > 0.0 else None
    return rng.choice(len(value), size=len(value), p=chance)
