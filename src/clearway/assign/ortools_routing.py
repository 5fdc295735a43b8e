"""OR-Tools' routing library as an assigner, to compare with."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from clearway.assign.partner import load, profiles, reasons_against, whole
from clearway.assign.split import even_seats
from clearway.protocols import AssignmentProblem, Routes

# No sum of legs that can be driven comes near; a thousand of them still fit the library's numbers.
NO_WAY = 10**12
WALL = 50


class OrToolsRouting:
    """OR-Tools with guided local search; needs the extra ``baselines``.

    The whole objective is put to it: legs as arc costs, the longest route as the global span of
    the distance, in thousandths.

    Parameters
    ----------
    even
        Equal tours (shorter for some where the number does not divide) instead of free ones.
    seconds
        By the clock, after which its search ends; it has no other bound that is fair to
        compare at. So the same seed need not give the same routes; the library takes none.
    clock
        Seconds passed; processor time unless told otherwise.
    """

    def __init__(
        self,
        even: bool = False,
        seconds: float = 2.0,
        clock: Callable[[], float] = time.process_time,
    ) -> None:
        if not seconds > 0.0:
            raise ValueError(f"seconds must be above 0, got {seconds}")
        self.even = even
        self.seconds = seconds
        self.clock = clock

    def __call__(self, problem: AssignmentProblem, seed: int) -> Routes:
        """Return one route per robot, the best found in time.

        Raises
        ------
        NotInstalled
            If OR-Tools is not there.
        ValueError
            If the problem is not supported, or no routes were found in time.
        """
        library: Any = load("ortools.constraint_solver.pywrapcp")
        enums: Any = load("ortools.constraint_solver.routing_enums_pb2")
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError(reasons[0])
        m, n = problem.start_to_task.shape
        if n == 0:
            return tuple(() for _ in range(m))
        manager = library.RoutingIndexManager(n + m + 1, m, [n + k for k in range(m)], [n + m] * m)
        routing = library.RoutingModel(manager)
        weights = problem.weights
        spans = [0] * m
        for kind in profiles(problem):
            price = weights.total_distance * kind.distance + weights.turning * kind.turn
            prices = routing.RegisterTransitMatrix(whole(price, kind.is_way, NO_WAY).tolist())
            length = whole(weights.max_distance * kind.distance, kind.is_way, 0)
            span = routing.RegisterTransitMatrix(length.tolist())
            for k in kind.robots:
                routing.SetArcCostEvaluatorOfVehicle(prices, k)
                spans[k] = span
        routing.AddDimensionWithVehicleTransits(spans, 0, NO_WAY, True, "distance")
        routing.GetDimensionOrDie("distance").SetGlobalSpanCostCoefficient(1)
        if self.even:
            one = routing.RegisterUnaryTransitVector([1] * n + [0] * (m + 1))
            routing.AddDimension(one, 0, even_seats(problem), True, "tasks")
        for task in np.flatnonzero(~problem.allowed.all(axis=0)):
            who = [int(k) for k in np.flatnonzero(problem.allowed[:, task])]
            routing.VehicleVar(manager.NodeToIndex(int(task))).SetValues(who)
        parameters = library.DefaultRoutingSearchParameters()
        parameters.first_solution_strategy = enums.FirstSolutionStrategy.PARALLEL_CHEAPEST_INSERTION
        parameters.local_search_metaheuristic = enums.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
        # The library warns unless it has a limit of its own, which is in wall time.
        parameters.time_limit.seconds = 1 + int(WALL * self.seconds)
        end = self.clock() + self.seconds
        routing.AddSearchMonitor(routing.solver().CustomLimit(lambda: self.clock() > end))
        solution = routing.SolveWithParameters(parameters)
        if solution is None:
            raise ValueError(f"OR-Tools found no routes within {self.seconds:g} s; allow more")
        routes: list[tuple[int, ...]] = []
        for k in range(m):
            route: list[int] = []
            index = solution.Value(routing.NextVar(routing.Start(k)))
            while not routing.IsEnd(index):
                route.append(int(manager.IndexToNode(index)))
                index = solution.Value(routing.NextVar(index))
            routes.append(tuple(route))
        return tuple(routes)

    def unsupported(self, problem: AssignmentProblem) -> tuple[str, ...]:
        """Return that tasks are timed, or why there is no even split, if one is asked for."""
        return reasons_against(problem, self.even)
