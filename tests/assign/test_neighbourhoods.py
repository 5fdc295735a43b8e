"""What moves cost is what they change."""

from functools import partial
from itertools import combinations

import numpy as np
import pytest

from clearway.assign.neighbourhoods import (
    Legs,
    View,
    exchange_tails,
    insertions,
    relocate,
    reverse,
    swap,
)
from clearway.protocols import Weights, objective

ROUTES = [[4, 0, 6], [], [2, 5, 1, 7], [3]]
SEATS = 8


def without_repeats(candidates):
    """All different routes that a move leads to, as lists of lists."""
    unique = {tuple(map(tuple, routes)) for routes in candidates}
    return [routes for routes in unique if routes != tuple(map(tuple, ROUTES))]


def all_relocations(size, turned):
    for k, route in enumerate(ROUTES):
        for i in range(len(route) - size + 1):
            row = route[i : i + size]
            rest = [list(other) for other in ROUTES]
            del rest[k][i : i + size]
            for goal, other in enumerate(rest):
                for j in range(len(other) + 1):
                    if turned and goal == k and j == i:
                        continue
                    routes = [list(each) for each in rest]
                    routes[goal][j:j] = row[::-1] if turned else row
                    yield routes


def all_swaps():
    """Neighbours in a route are left to relocation."""
    places = [(k, i) for k, route in enumerate(ROUTES) for i in range(len(route))]
    for (k, i), (g, j) in combinations(places, 2):
        if k == g and abs(i - j) == 1:
            continue
        routes = [list(route) for route in ROUTES]
        routes[k][i], routes[g][j] = routes[g][j], routes[k][i]
        yield routes


def all_reversals():
    for k, route in enumerate(ROUTES):
        for i, j in combinations(range(len(route) + 1), 2):
            routes = [list(other) for other in ROUTES]
            routes[k][i:j] = route[i:j][::-1]
            yield routes


def all_tail_exchanges():
    for k, g in combinations(range(len(ROUTES)), 2):
        for i in range(len(ROUTES[k]) + 1):
            for j in range(len(ROUTES[g]) + 1):
                routes = [list(route) for route in ROUTES]
                routes[k] = ROUTES[k][:i] + ROUTES[g][j:]
                routes[g] = ROUTES[g][:j] + ROUTES[k][i:]
                yield routes


NEIGHBOURHOODS = {
    "one task": (partial(relocate, size=1, turned=False), partial(all_relocations, 1, False)),
    "two tasks": (partial(relocate, size=2, turned=False), partial(all_relocations, 2, False)),
    "two turned": (partial(relocate, size=2, turned=True), partial(all_relocations, 2, True)),
    "three turned": (partial(relocate, size=3, turned=True), partial(all_relocations, 3, True)),
    "swap": (swap, all_swaps),
    "reverse": (reverse, all_reversals),
    "tails": (exchange_tails, all_tail_exchanges),
}


@pytest.mark.parametrize("name", NEIGHBOURHOODS)
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("seats", [4, SEATS])
def test_the_best_move_is_the_best_neighbour(make_problem, name, seed, seats):
    """The move found has the least objective of all neighbours, listed and summed one by one."""
    problem = make_problem(seed, m=4, n=8)
    neighbourhood, listed = NEIGHBOURHOODS[name]
    move = neighbourhood(View(Legs(problem), ROUTES, seats))
    now = objective(problem, ROUTES).value
    values = [
        objective(problem, routes).value
        for routes in without_repeats(listed())
        if all(len(route) <= seats for route in routes)
    ]
    assert move.change == pytest.approx(min(values) - now)
    assert objective(problem, move.apply()).value == pytest.approx(min(values))


@pytest.mark.parametrize("seed", range(6))
def test_an_insertion_costs_what_it_adds(make_problem, seed):
    """Every price of putting a task in equals the objective after less the one before."""
    problem = make_problem(seed, m=4, n=8)
    legs = Legs(problem)
    routes = [[4, 0], [], [2, 5, 1], [3]]
    view = View(legs, routes, SEATS)
    prices = insertions(view, np.array([6, 7]))
    for row, task in enumerate((6, 7)):
        position = 0
        for k, route in enumerate(routes):
            for place in range(len(route) + 1):
                after = [list(other) for other in routes]
                after[k].insert(place, task)
                assert prices[row, position] == pytest.approx(
                    View(legs, after, SEATS).value - view.value
                )
                position += 1


@pytest.mark.parametrize("seed", range(6))
def test_routes_are_worth_their_objective(make_problem, seed):
    """The sum of legs and the longest route give the objective of the joint."""
    problem = make_problem(seed, m=4, n=8)
    assert View(Legs(problem), ROUTES, SEATS).value == pytest.approx(
        objective(problem, ROUTES).value
    )


def test_full_robots_take_nothing_in(make_problem):
    """With two seats each, two robots and four tasks, a single task has nowhere else to go."""
    problem = make_problem(1, m=2, n=4)
    view = View(Legs(problem), [[0, 1], [2, 3]], 2)
    best = relocate(view, 1, False)
    assert {len(route) for route in best.apply()} == {2}
    assert np.isinf(insertions(view, np.array([0]))).all()


def test_a_forbidden_task_costs_more_than_any_routes(make_problem):
    """Giving up a forbidden task pays whatever else it costs, even where nothing has weight."""
    problem = make_problem(3, m=2, n=4, refused=0.5, weights=Weights(0.0, 0.0, 0.0))
    task = int(np.flatnonzero(~problem.allowed[0])[0])
    routes = [[task], [other for other in range(4) if other != task]]
    assert problem.allowed[1, task]
    assert relocate(View(Legs(problem), routes, 4), 1, False).change < -0.5


def test_nothing_to_move(make_problem):
    """A single task of a single robot has no neighbours."""
    view = View(Legs(make_problem(0, m=1, n=1)), [[0]], 1)
    for neighbourhood, _ in NEIGHBOURHOODS.values():
        move = neighbourhood(view)
        assert move is None or np.isinf(move.change)
