"""What routing libraries are told: whole numbers for legs, between tasks and from starts."""

import importlib
from dataclasses import dataclass
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from clearway.assign.split import even_seats, unseated
from clearway.protocols import AssignmentProblem, Routes, objective

Floats = NDArray[np.float64]

# Units per metre of value: the libraries take whole numbers only.
UNITS = 1000.0


class NotInstalled(ImportError):
    """A library that is an optional extra is not there."""


def load(module: str) -> ModuleType:
    """Return a module of an optional library.

    Raises
    ------
    NotInstalled
        If it is not installed; says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = module.partition(".")[0]
        raise NotInstalled(
            f"{name} is not installed: pip install 'clearway[baselines]'", name=name
        ) from error


@dataclass(frozen=True)
class Profile:
    """Legs of robots that drive alike and may do the same, in a library's numbering.

    Numbers are the tasks, then the starts of all robots, then an end that costs nothing to
    reach. ``distance`` (m), ``turn`` (rad) and ``is_way`` are square.
    """

    robots: tuple[int, ...]
    distance: Floats
    turn: Floats
    is_way: NDArray[np.bool_]


def profiles(problem: AssignmentProblem) -> list[Profile]:
    """Return one profile for each kind of robot."""
    m, n = problem.start_to_task.shape
    kinds: list[list[int]] = []
    for k in range(m):
        for like in kinds:
            if all(
                np.array_equal(table[k], table[like[0]])
                for table in (problem.task_to_task, problem.inner, problem.allowed)
            ):
                like.append(k)
                break
        else:
            kinds.append([k])
    found = []
    for like in kinds:
        distance = np.full((n + m + 1, n + m + 1), np.inf)
        turn = np.zeros_like(distance)
        distance[:n, :n] = problem.task_to_task[like[0]] + problem.inner[like[0]]
        turn[:n, :n] = problem.task_turn
        for k in like:
            distance[n + k, :n] = problem.start_to_task[k] + problem.inner[k]
            turn[n + k, :n] = problem.start_turn[k]
        distance[:, :n][:, ~problem.allowed[like[0]]] = np.inf
        distance[:, n + m] = 0.0
        np.fill_diagonal(distance, 0.0)
        np.fill_diagonal(turn, 0.0)
        is_way = np.isfinite(distance)
        found.append(Profile(tuple(like), np.where(is_way, distance, 0.0), turn, is_way))
    return found


def whole(value: Floats, is_way: NDArray[np.bool_], no_way: int) -> NDArray[np.int64]:
    """Return values in whole units, and ``no_way`` where there is no way."""
    numbers: NDArray[np.int64] = np.where(is_way, np.rint(UNITS * value), no_way).astype(np.int64)
    return numbers


def reasons_against(problem: AssignmentProblem, even: bool) -> tuple[str, ...]:
    """Return why routing libraries cannot take the problem as we put it to them."""
    reasons = []
    if problem.is_timed:
        reasons.append("due times and tasks that wait for others are not put to the library")
    if even:
        reasons += unseated(problem, even_seats(problem))
    return tuple(reasons)


def better(problem: AssignmentProblem, routes: Routes, best: Routes | None) -> Routes:
    """Return whichever routes have the lesser true objective."""
    if best is None or objective(problem, routes).value < objective(problem, best).value:
        return routes
    return best
