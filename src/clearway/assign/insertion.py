"""Insertion by regret, mended by local search."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from clearway.assign.neighbourhoods import (
    Legs,
    Move,
    View,
    exchange_tails,
    insertions,
    relocate,
    reverse,
    swap,
)
from clearway.assign.refusals import timed
from clearway.assign.split import even_seats, reseat, unseated
from clearway.protocols import AssignmentProblem, Routes

Ints = NDArray[np.int64]

# A gain below this is rounding.
LEAST_GAIN = 1e-9
# Most tasks taken out in a round, and the share of the best value by which a round may end
# worse and still be gone on from: within 2.2 % of all proven optima in tests/data/oracles.
MOST_REMOVED = 12
SLACK = 0.02

NEIGHBOURHOODS: tuple[Callable[[View], Move | None], ...] = (
    partial(relocate, size=1, turned=False),
    swap,
    exchange_tails,
    reverse,
    partial(relocate, size=2, turned=False),
    partial(relocate, size=2, turned=True),
    partial(relocate, size=3, turned=False),
    partial(relocate, size=3, turned=True),
)


@dataclass(frozen=True)
class InsertionParams:
    """Effort, and shape of the split.

    Parameters
    ----------
    rounds
        Times that tasks are taken out and put back; more find better routes.
    evaluations
        Moves priced before the search stops, whatever the rounds; it binds on large problems.
    even
        Equal tours (shorter for some where the number does not divide) instead of free ones.
    """

    rounds: int = 60
    evaluations: int = 6_000_000
    even: bool = False

    def __post_init__(self) -> None:
        for name in ("rounds", "evaluations"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name} must be 0 or above, got {getattr(self, name)}")


class InsertionLocalSearch:
    """Regret insertion, then rounds of taking tasks out, putting them back and descending.

    The descent takes the best move of the first neighbourhood that has an improving one, in
    the order: one task elsewhere, two tasks change places, tails change robots, a part
    reversed, two or three tasks in a row elsewhere.

    References
    ----------
    Potvin, J.-Y., Rousseau, J.-M. (1993). A parallel route building algorithm for the vehicle
    routing and scheduling problem with time windows. European Journal of Operational
    Research 66. doi:10.1016/0377-2217(93)90221-8

    Schrimpf, G. et al. (2000). Record breaking optimization results using the ruin and
    recreate principle. Journal of Computational Physics 159. doi:10.1006/jcph.1999.6413

    Deviations
    ----------
    The longest route counts in every price, so neither regret nor gain is a sum over routes.
    """

    def __init__(self, params: InsertionParams = InsertionParams()) -> None:
        self.params = params

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot; the same seed gives the same routes."""
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        m, n = len(problem.robots), len(problem.tasks)
        if n == 0:
            return ((),) * m
        rng = np.random.default_rng(seed)
        legs = Legs(problem)
        seats = even_seats(problem) if self.params.even else n
        built = _insert_by_regret(View(legs, [[] for _ in range(m)], seats), np.arange(n))
        seated = reseat(problem, built.routes, seats)
        assert seated is not None
        best = here = self._descend(View(legs, seated, seats))
        nearness = legs.prices[:, :n, :n, 1].min(axis=0)
        for _ in range(self.params.rounds):
            if legs.evaluations >= self.params.evaluations:
                break
            count = int(rng.integers(1, min(MOST_REMOVED, n) + 1))
            out = _around_one(nearness, count, rng)
            kept = [[task for task in route if task not in out] for route in here.routes]
            there = self._descend(_insert_in_order(View(legs, kept, seats), out))
            if there.value < best.value - LEAST_GAIN:
                best = there
            if there.value <= best.value * (1.0 + SLACK):
                here = there
        return tuple(map(tuple, best.routes))

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return why time cannot be heeded, and why there is no even split if one is asked for."""
        seated = unseated(problem, even_seats(problem)) if self.params.even else ()
        return timed(problem) + seated

    def _descend(self, view: View) -> View:
        """Take improving moves until there is none or the evaluations are used up."""
        while view.legs.evaluations < self.params.evaluations:
            move = _improving(view)
            if move is None:
                break
            view = View(view.legs, move.apply(), view.seats)
        return view


def _improving(view: View) -> Move | None:
    """Return the best move of the first neighbourhood that improves, if any does."""
    for neighbourhood in NEIGHBOURHOODS:
        move = neighbourhood(view)
        if move is not None and move.change < -LEAST_GAIN:
            return move
    return None


def _insert_by_regret(view: View, tasks: Ints) -> View:
    """Put tasks in, each time the one that would lose most by its second-best robot."""
    while tasks.size:
        change = insertions(view, tasks)
        by_robot = np.sort(np.minimum.reduceat(change, view.first, axis=1), axis=1)
        best, second = by_robot[:, 0], by_robot[:, :2][:, -1]
        chosen = int(np.lexsort((best, best - second))[0])
        view = _put(view, int(tasks[chosen]), change[chosen])
        tasks = np.delete(tasks, chosen)
    return view


def _insert_in_order(view: View, tasks: list[int]) -> View:
    for task in tasks:
        view = _put(view, task, insertions(view, np.array([task]))[0])
    return view


def _put(view: View, task: int, change: NDArray[np.float64]) -> View:
    """Insert a task after the position where it costs least."""
    place = int(change.argmin())
    routes = [list(route) for route in view.routes]
    routes[view.owner[place]].insert(int(view.rank[place]), task)
    return View(view.legs, routes, view.seats)


def _around_one(nearness: NDArray[np.float64], count: int, rng: np.random.Generator) -> list[int]:
    """Return a random task and others that are cheap to combine with it, in random order."""
    n = len(nearness)
    centre = int(rng.integers(n))
    distance = nearness[centre] * rng.uniform(0.5, 1.5, n)
    distance[centre] = -1.0
    chosen = np.argsort(distance, kind="stable")[:count]
    return [int(task) for task in rng.permutation(chosen)]
