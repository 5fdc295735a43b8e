"""Tasks taken out and put back."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.oracles.brute_force_assignment import optimum

from clearway.assign import RuinRecreate, RuinRecreateParams
from clearway.protocols import AssignmentProblem, objective

SCALE = Path(__file__).parents[1] / "data" / "oracles" / "assignment_scale.json"


def wrapped(angle):
    turn = np.abs(angle) % (2.0 * math.pi)
    return np.minimum(turn, 2.0 * math.pi - turn)


def test_published_optima_are_hit(proven):
    """Each split of each proven instance, by at least three of four seeds."""
    problem, split, answer = proven
    assign = RuinRecreate(split == "even", RuinRecreateParams(rounds=30_000))
    found = np.array([objective(problem, assign(problem, seed)).value for seed in range(4)])
    assert found.min() >= answer["F"] - 1e-5
    assert (found <= answer["F"] + 1e-5).sum() >= 3


@pytest.mark.parametrize("timed", [None, 0, 2])
@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_small_problems_are_solved(make_problem, seed, even, timed):
    """Unlike robots, forbidden pairs, due times and order: the optimum of five tasks."""
    problem = make_problem(seed, m=2, n=5, refused=0.2, timed=timed)
    least = optimum(problem, even)
    assign = RuinRecreate(even, RuinRecreateParams(rounds=2_000))
    if math.isinf(least):
        assert "split" in assign.unsupported(problem)[0]
    else:
        assert objective(problem, assign(problem, seed)).value == pytest.approx(least)


def test_larger_timed_problems_come_out_legal(make_problem):
    """Forty tasks, thirty of which wait for others: no circle, and less late than dealt out."""
    problem = make_problem(1, m=4, n=40, timed=30)
    few, many = (
        objective(problem, RuinRecreate(params=RuinRecreateParams(rounds=rounds))(problem, 0))
        for rounds in (0, 300)
    )
    assert many.value < 0.8 * few.value
    assert many.tardiness < few.tardiness


@pytest.mark.parametrize("split", ["even", "free"])
def test_large_fleets_come_near_the_known_values(split):
    """8 robots and 64 tasks in a tenth of the rounds: within 4 % of what is published."""
    entry = json.loads(SCALE.read_text())["instances"][0]
    headings = np.array(entry["task_headings"])
    problem = AssignmentProblem(
        robots=tuple(f"r{k}" for k in range(entry["robots"])),
        tasks=tuple(f"t{j}" for j in range(entry["tasks"])),
        start_to_task=np.array(entry["start_distance"]),
        task_to_task=np.array(entry["distance"]),
        start_turn=wrapped(headings - np.array(entry["start_headings"])[:, None]),
        task_turn=wrapped(headings - headings[:, None]),
    )
    assign = RuinRecreate(split == "even", RuinRecreateParams(rounds=25_000))
    value = objective(problem, assign(problem, 0)).value
    assert entry["known"][split]["lp"] <= value <= 1.04 * entry["known"][split]["ours"]


def test_even_routes_stay_even(make_problem):
    """Eleven tasks of four robots: nobody ever has more than three."""
    assign = RuinRecreate(even=True, params=RuinRecreateParams(rounds=500))
    for seed in range(5):
        assert max(map(len, assign(make_problem(seed, m=4, n=11), seed))) <= 3


def test_no_rounds_leave_legal_routes(make_problem):
    """What it begins with already keeps to who may do what and to the order."""
    assign = RuinRecreate(params=RuinRecreateParams(rounds=0))
    for seed in range(10):
        problem = make_problem(seed, m=3, n=9, refused=0.4, timed=6)
        assert math.isfinite(objective(problem, assign(problem, seed)).value)


@pytest.mark.parametrize(
    ("params", "told"),
    [
        ({"rounds": -1}, "rounds"),
        ({"removed": 0}, "removed"),
        ({"longest_string": 0}, "longest_string"),
        ({"blinks": 1.0}, "blinks"),
        ({"regret": math.nan}, "regret"),
        ({"first_temperature": 0.001}, "last_temperature"),
    ],
)
def test_parameters_are_checked(params, told):
    """Effort below zero, or places all overlooked, is an error where it is written."""
    with pytest.raises(ValueError, match=told):
        RuinRecreateParams(**params)
