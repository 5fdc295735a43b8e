"""PyVRP as an assigner, to compare with."""

import time
from collections.abc import Callable
from typing import Any

from clearway.assign.partner import UNITS, better, load, profiles, reasons_against, whole
from clearway.assign.split import even_seats
from clearway.protocols import AssignmentProblem, Routes, objective

# Each run may use routes that are shorter than the longest one found before, by this factor.
TIGHTER = 0.85
# Where no routes were found the limit is let out by this factor.
LOOSER = 1.08
NO_WAY = 2**40


class _Stop:
    """Says stop when the time is up."""

    def __init__(self, clock: Callable[[], float], seconds: float) -> None:
        self.clock = clock
        self.end = clock() + seconds

    def __call__(self, best_cost: float) -> bool:
        return self.clock() > self.end


class PyVrpRouting:
    """PyVRP's iterated local search; needs the extra ``baselines``.

    The library knows no longest route in its objective. It gets the weighted sum of distances
    (as distance) and turns (as duration), and a most distance per route: first none, then,
    in ``runs`` runs of equal time, each time a tighter one. The best by the true objective
    is kept.

    Parameters
    ----------
    even
        Equal tours (shorter for some where the number does not divide) instead of free ones.
    seconds
        By the clock, after which its search ends; it has no other bound that is fair to
        compare at. So the same seed need not give the same routes.
    runs
        Limits tried on the longest route.
    clock
        Seconds passed; processor time unless told otherwise.
    """

    def __init__(
        self,
        even: bool = False,
        seconds: float = 2.0,
        runs: int = 5,
        clock: Callable[[], float] = time.process_time,
    ) -> None:
        if not seconds > 0.0:
            raise ValueError(f"seconds must be above 0, got {seconds}")
        if runs < 1:
            raise ValueError(f"runs must be 1 or above, got {runs}")
        self.even = even
        self.seconds = seconds
        self.runs = runs
        self.clock = clock

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot, the best found in time.

        Raises
        ------
        NotInstalled
            If PyVRP is not there.
        ValueError
            If the problem is not supported, or no routes were found in time.
        """
        library: Any = load("pyvrp")
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        m, n = problem.start_to_task.shape
        if n == 0:
            return tuple(() for _ in range(m))
        best: Routes | None = None
        limit: float | None = None
        data = self._data(library, problem)
        for run in range(self.runs):
            units = None if limit is None else int(UNITS * _per_metre(problem) * limit)
            found = library.solve(
                data if units is None else _limited(data, units),
                stop=_Stop(self.clock, self.seconds / self.runs),
                seed=seed + run,
                display=False,
            )
            if found.is_feasible():
                routes = _routes(found.best, m)
                best = better(problem, routes, best)
                limit = TIGHTER * objective(problem, routes).max_distance
            elif limit is not None:
                limit *= LOOSER
        if best is None:
            raise ValueError(f"PyVRP found no routes within {self.seconds:g} s; allow more")
        return best

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return that tasks are timed, or why there is no even split, if one is asked for."""
        return reasons_against(problem, self.even)

    def _data(self, library: Any, problem: AssignmentProblem) -> Any:
        """Return the library's problem: a depot for each robot's start, and an end for all."""
        m, n = problem.start_to_task.shape
        weights = problem.weights
        kinds = profiles(problem)
        vehicles: dict[int, Any] = {}
        for number, kind in enumerate(kinds):
            for k in kind.robots:
                vehicles[k] = library.VehicleType(
                    capacity=[even_seats(problem)] if self.even else [],
                    start_depot=k,
                    end_depot=m,
                    unit_distance_cost=int(weights.total_distance > 0.0),
                    unit_duration_cost=1,
                    profile=number,
                )
        return library.ProblemData(
            locations=[library.Location(0.0, 0.0) for _ in range(n + m + 1)],
            clients=[library.Client(j, delivery=[1] if self.even else []) for j in range(n)],
            depots=[library.Depot(n + k) for k in range(m + 1)],
            vehicle_types=[vehicles[k] for k in range(m)],
            distance_matrices=[
                whole(_per_metre(problem) * kind.distance, kind.is_way, NO_WAY) for kind in kinds
            ],
            duration_matrices=[
                whole(weights.turning * kind.turn, kind.is_way, NO_WAY) for kind in kinds
            ],
        )


def _per_metre(problem: AssignmentProblem) -> float:
    """Return what a metre counts in the library's distances, which the limit is on, too."""
    return problem.weights.total_distance or 1.0


def _limited(data: Any, limit: int) -> Any:
    """Return the problem with a most distance for every route, in units."""
    return data.replace(
        vehicle_types=[kind.replace(max_distance=limit) for kind in data.vehicle_types()]
    )


def _routes(solution: Any, m: int) -> Routes:
    routes: list[tuple[int, ...]] = [()] * m
    for route in solution.routes():
        routes[route.vehicle_type()] = tuple(int(stop.idx) for stop in route if stop.is_client())
    return tuple(routes)
