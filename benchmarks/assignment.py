"""Assigners side by side in one run: large fleets at equal processor time, optima of 16 tasks.

    pip install 'clearway[baselines]'
    python benchmarks/assignment.py

Three instances on the reference site (8 robots and 64 tasks, 16 and 128, 32 and 256), even and
free split: ruin and recreate with its default effort, then OR-Tools and PyVRP with as much
processor time as that took. Then the times of the exact solver on the proven instances of 16
tasks, and how many of 20 seeds of the memetic swarm hit each proven optimum of an even split.
"""

import json
import math
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from clearway.assign import ExactAssigner, MemeticApsga, MemeticParams, RuinRecreate
from clearway.assign.ortools_routing import OrToolsRouting
from clearway.assign.pyvrp_routing import PyVrpRouting
from clearway.protocols import Assigner, AssignmentProblem, Weights, objective

ORACLES = Path(__file__).parents[1] / "tests" / "data" / "oracles"
SEEDS = 3


def instances(name: str, build: Callable[[Any], AssignmentProblem]) -> Iterator[tuple[Any, Any]]:
    for entry in json.loads((ORACLES / name).read_text())["instances"]:
        yield entry, build(entry)


def large(entry: Any) -> AssignmentProblem:
    starts, tasks = np.array(entry["start_headings"]), np.array(entry["task_headings"])
    return AssignmentProblem(
        robots=tuple(f"r{k}" for k in range(entry["robots"])),
        tasks=tuple(f"t{j}" for j in range(entry["tasks"])),
        start_to_task=np.array(entry["start_distance"]),
        task_to_task=np.array(entry["distance"]),
        start_turn=_wrapped(tasks - starts[:, None]),
        task_turn=_wrapped(tasks - tasks[:, None]),
    )


def proven(entry: Any) -> AssignmentProblem:
    quarter = math.pi / 2.0
    return AssignmentProblem(
        robots=tuple(f"r{k}" for k in range(entry["robots"])),
        tasks=tuple(f"t{j}" for j in range(entry["tasks"])),
        start_to_task=np.array(entry["start_to_task_dist"]),
        task_to_task=np.array(entry["task_to_task_dist"]),
        start_turn=quarter * np.array(entry["start_to_task_turn_quarter_turns"]),
        task_turn=quarter * np.array(entry["task_to_task_turn_quarter_turns"]),
        weights=Weights(*entry["weights"]),
    )


def _wrapped(angle: Any) -> Any:
    turn = np.abs(angle) % (2.0 * math.pi)
    return np.minimum(turn, 2.0 * math.pi - turn)


def timed(assign: Assigner, problem: AssignmentProblem, seed: int) -> tuple[float, float]:
    begin = time.process_time()
    routes = assign(problem, seed)
    return objective(problem, routes).value, time.process_time() - begin


def fleets() -> None:
    print(f"| instance | split | ruin and recreate, {SEEDS} seeds | CPU s | OR-Tools | PyVRP |")
    print("|---|---|---|---|---|---|")
    for entry, problem in instances("assignment_scale.json", large):
        for even in (True, False):
            ours = [timed(RuinRecreate(even), problem, seed) for seed in range(SEEDS)]
            values = [value for value, _ in ours]
            seconds = statistics.mean(cpu for _, cpu in ours)
            partners = [
                timed(partner(even, seconds), problem, 0)[0]
                for partner in (OrToolsRouting, PyVrpRouting)
            ]
            told = f"{statistics.mean(values):.1f} ({min(values):.1f} to {max(values):.1f})"
            print(
                f"| {entry['name']} | {'even' if even else 'free'} | {told} | {seconds:.2f} "
                f"| {partners[0]:.1f} | {partners[1]:.1f} |",
                flush=True,
            )


def optima() -> None:
    print("\n| instance | exact, even: CPU ms | free: CPU ms | memetic hits, T = 5 | T = 20 |")
    print("|---|---|---|---|---|")
    for entry, problem in instances("assignment.json", proven):
        exact = []
        for split in ("even", "free"):
            runs = [timed(ExactAssigner(split == "even"), problem, seed) for seed in range(5)]
            assert all(abs(value - entry[split]["F"]) < 1e-5 for value, _ in runs)
            cpu = [1000.0 * seconds for _, seconds in runs]
            exact.append(f"{statistics.median(cpu):.1f} (at most {max(cpu):.1f})")
        hits = []
        for iterations in (5, 20):
            swarm = MemeticApsga(MemeticParams(iterations=iterations))
            found = [timed(swarm, problem, seed)[0] for seed in range(20)]
            hits.append(f"{sum(value < entry['even']['F'] + 1e-5 for value in found)} of 20")
        print(f"| {entry['name']} | {' | '.join(exact)} | {' | '.join(hits)} |", flush=True)


if __name__ == "__main__":
    fleets()
    optima()
