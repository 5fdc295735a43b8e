"""The worth of a whole population of even splits in one call."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.protocols import AssignmentProblem

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Worths:
    """Value and terms of each permutation, as in ``Objective`` (m, m, rad), ``(N,)`` each."""

    value: Floats
    max_distance: Floats
    total_distance: Floats
    turning: Floats


class Evaluation:
    """Prices populations of permutations as ``objective`` prices their routes.

    ``count`` is the number of permutations priced so far.
    """

    def __init__(self, problem: AssignmentProblem) -> None:
        m, n = problem.start_to_task.shape
        self.weights, self.count = problem.weights, 0
        # Number n is where a route starts, and after its last task the padding, which is free.
        self.distance = np.zeros((m, n + 1, n + 1))
        self.distance[:, :n, :n] = problem.task_to_task
        self.distance[:, n, :n] = problem.start_to_task
        self.distance[:, :, :n] += problem.inner[:, None, :]
        self.turn = np.zeros((m, n + 1, n + 1))
        self.turn[:, :n, :n] = problem.task_turn
        self.turn[:, n, :n] = problem.start_turn

    def __call__(self, population: Ints) -> Worths:
        """Return what each row of a population ``(N, length)`` is worth."""
        (m, _, ends), count = self.distance.shape, len(population)
        start = ends - 1
        nodes = np.minimum(population, start).reshape(count, m, -1 if m else 0)
        if population.shape[1] > start:
            padding_last = np.argsort(nodes == start, axis=2, kind="stable")
            nodes = np.take_along_axis(nodes, padding_last, axis=2)
        before = np.concatenate((np.full((count, m, 1), start), nodes), axis=2)[..., :-1]
        legs = np.arange(m)[:, None], before, nodes
        lengths = self.distance[legs].sum(axis=2)
        longest, total = lengths.max(axis=1, initial=0.0), lengths.sum(axis=1)
        turning = self.turn[legs].sum(axis=(1, 2))
        self.count += count
        weights = self.weights
        return Worths(
            value=weights.max_distance * longest
            + weights.total_distance * total
            + weights.turning * turning,
            max_distance=longest,
            total_distance=total,
            turning=turning,
        )
