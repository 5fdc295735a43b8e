"""The exam that every assigner sits."""

import math

import numpy as np
import pytest

from clearway.assign import (
    LITERAL,
    Apsga,
    ApsgaParams,
    AutomaticAssigner,
    ExactAssigner,
    Ga,
    GaParams,
    InsertionLocalSearch,
    InsertionParams,
    MemeticApsga,
    Psga,
    PsgaParams,
    Pso,
    PsoParams,
    RandomAssigner,
    RuinRecreate,
    RuinRecreateParams,
    SwarmParams,
)
from clearway.protocols import AssignmentProblem, check_routes, objective

SWARM = SwarmParams(particles=6, iterations=5)
ASSIGNERS = {
    "random, even": RandomAssigner(),
    "random, free": RandomAssigner(even=False),
    "insertion, even": InsertionLocalSearch(InsertionParams(rounds=5, even=True)),
    "insertion, free": InsertionLocalSearch(InsertionParams(rounds=5)),
    "pso": Pso(PsoParams(SWARM)),
    "ga": Ga(GaParams(individuals=6, generations=5)),
    "psga": Psga(PsgaParams(SWARM)),
    "apsga": Apsga(ApsgaParams(SWARM)),
    "apsga, literal": Apsga(ApsgaParams(SWARM, LITERAL)),
    "automatic, even": AutomaticAssigner(even=True),
    "automatic, free": AutomaticAssigner(),
    "exact, even": ExactAssigner(even=True),
    "exact, free": ExactAssigner(even=False),
    "memetic": MemeticApsga(),
    "ruin and recreate, even": RuinRecreate(even=True, params=RuinRecreateParams(rounds=200)),
    "ruin and recreate, free": RuinRecreate(even=False, params=RuinRecreateParams(rounds=200)),
}


@pytest.fixture(params=ASSIGNERS)
def assign(request):
    return ASSIGNERS[request.param]


def problem_of(m, n, seed=0, allowed=True, **more):
    """Points in a square: robots start at some, tasks are at others."""
    rng = np.random.default_rng(seed)
    starts, tasks = rng.uniform(0.0, 30.0, (m, 2)), rng.uniform(0.0, 30.0, (n, 2))
    return AssignmentProblem(
        robots=tuple(f"r{k}" for k in range(m)),
        tasks=tuple(f"t{j}" for j in range(n)),
        start_to_task=np.abs(starts[:, None] - tasks).sum(axis=-1),
        task_to_task=np.abs(tasks[:, None] - tasks).sum(axis=-1),
        start_turn=rng.uniform(0.0, math.pi, (m, n)),
        task_turn=rng.uniform(0.0, math.pi, (n, n)),
        allowed=np.array(allowed),
        **more,
    )


def routes_or_refusal(assign, problem, seed=0):
    """Return legal routes, or ``None`` where the problem is refused before and when called."""
    reasons = assign.unsupported(problem)
    assert isinstance(reasons, tuple)
    if not reasons:
        routes = assign(problem, seed)
        objective(problem, routes)
        return routes
    assert all(reasons)
    with pytest.raises(ValueError) as refusal:
        assign(problem, seed)
    assert str(refusal.value) in reasons
    return None


@pytest.mark.parametrize(("m", "n"), [(4, 12), (3, 10), (1, 5), (5, 2), (3, 0), (1, 1)])
def test_every_task_is_done_once(assign, m, n):
    """As many tasks as robots or more or fewer, divisible or not, one robot, no task at all."""
    problem = problem_of(m, n)
    assert assign.unsupported(problem) == ()
    routes = assign(problem, 1)
    check_routes(problem, routes)
    assert sorted(task for route in routes for task in route) == list(range(n))


def test_routes_are_tuples_of_numbers(assign):
    """One tuple per robot, holding plain integers that any file can store."""
    routes = assign(problem_of(3, 7), 1)
    assert isinstance(routes, tuple)
    assert all(isinstance(route, tuple) for route in routes)
    assert all(type(task) is int for route in routes for task in route)


@pytest.mark.parametrize("seed", range(10))
def test_robots_do_only_what_they_may(assign, seed):
    """Half of all pairs forbidden: the routes keep to the rest, or the refusal says why."""
    rng = np.random.default_rng(seed)
    allowed = rng.random((3, 6)) < 0.5
    allowed[rng.integers(3, size=6), np.arange(6)] = True
    routes_or_refusal(assign, problem_of(3, 6, seed, allowed), seed)


def test_tasks_kept_for_robots_go_to_them(assign):
    """With one robot allowed per task there is one way to share out, if any is offered."""
    owner = np.array([2, 0, 1, 1, 2, 0])
    routes = routes_or_refusal(assign, problem_of(3, 6, allowed=owner == np.arange(3)[:, None]), 4)
    assert routes is None or [sorted(route) for route in routes] == [[1, 5], [2, 3], [0, 4]]


@pytest.mark.parametrize("seed", range(5))
def test_tasks_wait_for_others_or_are_refused(assign, seed):
    """Routes that wait for each other are worth nothing: precedence is kept to, or refused."""
    routes_or_refusal(assign, problem_of(3, 6, seed, before=((5, 0), (4, 1), (3, 2))), seed)


def test_due_times_are_taken_or_refused(assign):
    """Whoever takes due times returns routes; whoever knows no time says so."""
    routes_or_refusal(assign, problem_of(3, 6, due=np.full(6, 20.0)))


def test_the_same_seed_gives_the_same_routes(assign):
    """Chance comes from the seed alone."""
    assert assign(problem_of(4, 12), 7) == assign(problem_of(4, 12), 7)


def test_numbering_of_tasks_does_not_matter(assign):
    """Whatever numbers the tasks go by, they are all done, and done as legally."""
    order = np.random.default_rng(2).permutation(9)
    rng = np.random.default_rng(3)
    allowed = rng.random((3, 9)) < 0.8
    problem, other = problem_of(3, 9, 0, allowed), problem_of(3, 9, 0, allowed[:, order])
    assert bool(assign.unsupported(problem)) == bool(assign.unsupported(other))
    routes_or_refusal(assign, other)


def test_the_problem_is_left_as_it_was(assign):
    """Assigning twice from one problem and once from its twin gives the same worth."""
    problem = problem_of(3, 8)
    first = objective(problem, assign(problem, 1)).value
    assert objective(problem, assign(problem, 1)).value == first
