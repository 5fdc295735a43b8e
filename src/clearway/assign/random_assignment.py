"""Tasks shared out by chance: the yardstick for every other assigner."""

from itertools import accumulate, pairwise

import numpy as np

from clearway.assign.refusals import timed
from clearway.assign.split import even_seats, reseat, unseated
from clearway.protocols import AssignmentProblem, Routes


class RandomAssigner:
    """Random permutation of the tasks, cut into tours (the paper's NTA).

    Parameters
    ----------
    even
        Cut into equal tours, the first ones longer by one where the number does not divide;
        otherwise each task goes to any robot that may do it.

    References
    ----------
    Zhang, L. et al. An enhanced hybrid metaheuristic for hierarchical scheduling in 4WIDS
    multi-robot systems under confined environments. Control Engineering Practice.

    Deviations
    ----------
    Tasks that fall to a robot that may not do them are moved on (the paper's robots are all
    alike).
    """

    def __init__(self, even: bool = True) -> None:
        self.even = even

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        rng = np.random.default_rng(seed)
        m = len(problem.robots)
        order = [int(task) for task in rng.permutation(len(problem.tasks))]
        if not self.even:
            free: list[list[int]] = [[] for _ in range(m)]
            for task in order:
                free[int(rng.choice(np.flatnonzero(problem.allowed[:, task])))].append(task)
            return tuple(map(tuple, free))
        if not order:
            return ((),) * m
        q, more = divmod(len(order), m)
        cuts = accumulate((q + (k < more) for k in range(m)), initial=0)
        routes = reseat(
            problem, [order[first:last] for first, last in pairwise(cuts)], even_seats(problem)
        )
        assert routes is not None
        return routes

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why time cannot be heeded, and why there is no even split if there is none."""
        seated = unseated(problem, even_seats(problem)) if self.even else ()
        return timed(problem) + seated
