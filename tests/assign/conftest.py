"""Assignment problems to try: random ones, and those with proven optima."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from clearway.protocols import AssignmentProblem, Weights

ORACLES = Path(__file__).parents[1] / "data" / "oracles" / "assignment.json"


def random_problem(seed, m=3, n=5, refused=0.0, weights=None, timed=None):
    """Robots that each drive in their own way, there otherwise than back.

    Where ``timed``, some tasks are due too soon, and as many pairs as it says must wait.
    """
    rng = np.random.default_rng(seed)
    allowed = rng.random((m, n)) >= refused
    allowed[rng.integers(m, size=n), np.arange(n)] = True
    return AssignmentProblem(
        robots=tuple(f"r{k}" for k in range(m)),
        tasks=tuple(f"t{j}" for j in range(n)),
        start_to_task=rng.uniform(0.0, 50.0, (m, n)),
        task_to_task=rng.uniform(0.0, 50.0, (m, n, n)),
        start_turn=rng.uniform(0.0, math.pi, (m, n)),
        task_turn=rng.uniform(0.0, math.pi, (n, n)),
        inner=rng.uniform(0.0, 20.0, (m, n)),
        allowed=allowed,
        weights=weights or Weights(*rng.uniform(0.0, 2.0, 3)),
        **({} if timed is None else times(seed, n, timed)),
    )


def times(seed, n, pairs):
    """Speed, service, due times and order of a random timed problem."""
    rng = np.random.default_rng((seed, n))
    rank = rng.permutation(n)
    drawn = (rng.choice(n, 2, replace=False) for _ in range(pairs))
    return {
        "speed": float(rng.uniform(0.5, 2.0)),
        "service": rng.uniform(0.0, 10.0, n),
        "due": np.where(rng.random(n) < 0.7, rng.uniform(20.0, 120.0, n), np.inf),
        "before": tuple(tuple(int(i) for i in sorted(pair, key=rank.item)) for pair in drawn),
    }


def proven_instances():
    """Yield pairs of problem and published answer, named, from the file of proven optima."""
    for entry in json.loads(ORACLES.read_text())["instances"]:
        quarter = math.pi / 2.0
        problem = AssignmentProblem(
            robots=tuple(f"r{k}" for k in range(entry["robots"])),
            tasks=tuple(f"t{j}" for j in range(entry["tasks"])),
            start_to_task=np.array(entry["start_to_task_dist"]),
            task_to_task=np.array(entry["task_to_task_dist"]),
            start_turn=quarter * np.array(entry["start_to_task_turn_quarter_turns"]),
            task_turn=quarter * np.array(entry["task_to_task_turn_quarter_turns"]),
            weights=Weights(*entry["weights"]),
        )
        for split in ("even", "free"):
            yield pytest.param(problem, split, entry[split], id=f"{entry['name']}-{split}")


def pytest_generate_tests(metafunc):
    if "proven" in metafunc.fixturenames:
        params = [pytest.param(p.values, id=p.id) for p in proven_instances()]
        metafunc.parametrize("proven", params)


@pytest.fixture
def make_problem():
    return random_problem
