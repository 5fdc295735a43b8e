"""What an assignment problem must be, and what its routes are worth."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.oracles.brute_force_assignment import optimum

from clearway.protocols import (
    AssignmentProblem,
    Weights,
    check_routes,
    finish_times,
    objective,
)

# Two robots, three tasks: distances from starts, between tasks, and turns.
START = np.array([[3.0, 5.0, 9.0], [8.0, 4.0, 2.0]])
BETWEEN = np.array([[0.0, 6.0, 7.0], [6.0, 0.0, 3.0], [7.0, 3.0, 0.0]])
START_TURN = np.array([[0.0, 1.0, 2.0], [0.5, 0.0, 1.0]])
TURN = np.array([[0.0, 1.0, 2.0], [1.0, 0.0, 3.0], [2.0, 3.0, 0.0]])


def small(**changes):
    parts = {
        "robots": ("ann", "bob"),
        "tasks": ("x", "y", "z"),
        "start_to_task": START,
        "task_to_task": BETWEEN,
        "start_turn": START_TURN,
        "task_turn": TURN,
    }
    return AssignmentProblem(**{**parts, **changes})


def test_longest_sum_and_turns_add_up():
    """Ann: x then y, 3 + 6 = 9 m and 0 + 1 rad; bob: z, 2 m and 1 rad. 9 + 11 + 2 = 22."""
    worth = objective(small(), [(0, 1), (2,)])
    assert (worth.max_distance, worth.total_distance, worth.turning) == (9.0, 11.0, 2.0)
    assert worth.value == 22.0


def test_weights_weigh_their_terms():
    """With weights 2, 0.5 and 10 the same routes are worth 18 + 5.5 + 20 = 43.5."""
    worth = objective(small(weights=Weights(2.0, 0.5, 10.0)), [(0, 1), (2,)])
    assert worth.value == 43.5


def test_ways_within_tasks_count():
    """If z takes 4 m by itself, bob drives 6 m; an idle ann drives none."""
    worth = objective(small(inner=np.array([0.0, 0.0, 4.0])), [(), (2, 1, 0)])
    assert worth.max_distance == worth.total_distance == 2.0 + 4.0 + 3.0 + 6.0


def test_robots_may_drive_in_different_ways():
    """A matrix per robot: the same route costs ann and bob what their own legs cost."""
    problem = small(task_to_task=np.stack([BETWEEN, 10.0 * BETWEEN]))
    assert objective(problem, [(0, 1, 2), ()]).total_distance == 3.0 + 6.0 + 3.0
    assert objective(problem, [(), (0, 1, 2)]).total_distance == 8.0 + 60.0 + 30.0


def test_no_way_means_not_allowed():
    """A robot without a way to a task may not do it."""
    start = START.copy()
    start[0, 2] = math.inf
    assert small(start_to_task=start).allowed.tolist() == [[True, True, False], [True] * 3]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"start_to_task": -START}, r"start_to_task\[0, 0\]"),
        ({"task_to_task": np.where(BETWEEN == 3.0, np.nan, BETWEEN)}, "task_to_task.*nan"),
        ({"task_turn": TURN + math.inf}, "task_turn must be finite"),
        ({"start_turn": START_TURN[:1, :2]}, r"start_turn must have shape \(2, 3\)"),
        ({"tasks": ("x", "y", "x")}, "tasks need ids of their own; x"),
        ({"robots": ("ann", "ann")}, "robots need ids of their own; ann"),
        ({"allowed": np.array([[True, True, False]])}, "no robot may do task z"),
    ],
)
def test_nonsense_is_refused_by_name(changes, told):
    """Negative, undefined, misshapen or impossible input is an error where it is built."""
    with pytest.raises(ValueError, match=told):
        small(**changes)


@pytest.mark.parametrize("weight", [-1.0, math.nan, math.inf])
def test_weights_are_finite_and_not_negative(weight):
    """A negative weight would reward detours."""
    with pytest.raises(ValueError, match="turning"):
        Weights(turning=weight)


@pytest.mark.parametrize(
    ("routes", "told"),
    [
        ([(0, 1)], "2 robots need as many routes, got 1"),
        ([(0, 1), ()], "task z must be done once, not 0 times"),
        ([(0, 1), (2, 1)], "task y must be done once, not 2 times"),
        ([(0, 1), (2, 7)], r"do not exist: \[7\]"),
        ([(2, 1), (0,)], "robot ann may not do task z"),
    ],
)
def test_wrong_routes_have_no_worth(routes, told):
    """Each task is done once, by a robot that may."""
    problem = small(allowed=np.array([[True, True, False], [True, True, True]]))
    check_routes(problem, [(0, 1), (2,)])
    with pytest.raises(ValueError, match=told):
        objective(problem, routes)


def test_arrays_cannot_be_changed_afterwards():
    """What was checked stays as it was."""
    with pytest.raises(ValueError, match="read-only"):
        small().inner[0, 0] = 1.0


def test_the_proven_routes_have_their_published_worth(proven):
    """Value, longest, sum and turns of each proven optimum, recomputed."""
    problem, _, answer = proven
    worth = objective(problem, answer["routes"])
    assert worth.value == pytest.approx(answer["F"], abs=1e-5)
    assert worth.max_distance == answer["max"]
    assert worth.total_distance == answer["total"]
    assert worth.turning == pytest.approx(answer["turning"], abs=1e-5)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("even", [False, True])
def test_names_of_tasks_do_not_matter(make_problem, seed, even):
    """Numbering the tasks in another order leaves the optimum as it is."""
    problem = make_problem(seed, m=2, n=4)
    order = np.random.default_rng(seed).permutation(4)
    renamed = replace(
        problem,
        tasks=tuple(problem.tasks[j] for j in order),
        start_to_task=problem.start_to_task[:, order],
        task_to_task=problem.task_to_task[:, order][:, :, order],
        start_turn=problem.start_turn[:, order],
        task_turn=problem.task_turn[order][:, order],
        inner=problem.inner[:, order],
        allowed=problem.allowed[:, order],
    )
    assert optimum(renamed, even) == pytest.approx(optimum(problem, even))


@pytest.mark.parametrize("seed", range(5))
def test_a_free_split_is_never_dearer(make_problem, seed):
    """Even splits are among the free ones."""
    problem = make_problem(seed, m=2, n=4)
    assert optimum(problem) <= optimum(problem, even=True)


def test_all_costs_scale_together():
    """Three times the distances and turns, three times the worth of any routes."""
    problem = small()
    tripled = small(
        start_to_task=3.0 * START,
        task_to_task=3.0 * BETWEEN,
        start_turn=3.0 * START_TURN,
        task_turn=3.0 * TURN,
    )
    for routes in ([(0, 1), (2,)], [(2, 0), (1,)], [(), (1, 2, 0)]):
        assert objective(tripled, routes).value == 3.0 * objective(problem, routes).value


def line(**more):
    """Two robots and four tasks, every leg a metre long, driven at 2 m/s."""
    return AssignmentProblem(
        ("a", "b"),
        ("t0", "t1", "t2", "t3"),
        np.ones((2, 4)),
        1.0,
        0.0,
        0.0,
        **({"speed": 2.0} | more),
    )


def test_a_task_begins_once_those_before_it_are_finished():
    """Worked by hand: t2 is reached after 0.5 s, waits until t0 is finished at 2.5 s."""
    problem = line(service=2.0, before=((0, 2),))
    assert finish_times(problem, ((0, 1), (2, 3))) == pytest.approx([2.5, 5.0, 4.5, 7.0])


def test_every_second_late_costs():
    problem = line(due=np.array([0.25, np.inf, np.inf, 0.5]), weights=Weights(tardiness=10.0))
    worth = objective(problem, ((0, 1), (2, 3)))
    assert worth.tardiness == pytest.approx(0.25 + 0.5)
    assert worth.value == pytest.approx(2.0 + 4.0 + 7.5)


def test_tasks_that_wait_for_each_other_are_named():
    with pytest.raises(ValueError, match="t1 before t2 before t3 before t1; drop one"):
        line(before=((1, 2), (0, 1), (2, 3), (3, 1)))


def test_routes_that_wait_for_each_other_are_refused():
    with pytest.raises(ValueError, match="routes wait for each other"):
        objective(line(before=((1, 2), (3, 0))), ((0, 1), (2, 3)))


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"speed": 0.0}, "speed must be above 0"),
        ({"service": np.nan}, "service"),
        ({"service": np.inf}, "service must be finite"),
        ({"due": -1.0}, "due"),
        ({"before": ((0, 9),)}, "before names tasks 0 and 9"),
    ],
)
def test_wrong_times_are_named(wrong, told):
    with pytest.raises(ValueError, match=told):
        line(**wrong)
