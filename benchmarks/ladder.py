"""How far the ladder of assigners ends from the best known, in both readings of the paper.

Random tasks and starts in the warehouse, as many as in the paper's Table 2, split evenly.

    python benchmarks/ladder.py [--instances 5] [--seeds 20] [--rounds 1000]

The best known is the least of three runs of insertion with local search, ``--rounds`` each, and of
all runs in the table: not a proven optimum. Gaps are means over all runs, with 95 % intervals over
the instances; CPU seconds are those of a run.
"""

import argparse
import time

import numpy as np
from scipy import stats

from clearway.assign import (
    LITERAL,
    Apsga,
    ApsgaParams,
    Ga,
    InsertionLocalSearch,
    InsertionParams,
    Psga,
    PsgaParams,
    Pso,
    RandomAssigner,
    build,
)
from clearway.protocols import Assigner, AssignmentProblem, objective
from clearway.world.warehouse import random_warehouse

SIZES = ((4, 12), (4, 16), (8, 16))
LADDER: dict[str, Assigner] = {
    "NTA": RandomAssigner(),
    "PSO": Pso(),
    "GA": Ga(),
    "PSGA": Psga(),
    "APSGA": Apsga(),
    "PSGA, literal": Psga(PsgaParams(breeding=LITERAL)),
    "APSGA, literal": Apsga(ApsgaParams(breeding=LITERAL)),
}
DIFFERENCES = (("APSGA", "PSGA"), ("APSGA, literal", "PSGA, literal"))


def values(assign: Assigner, problem: AssignmentProblem, seeds: int) -> list[float]:
    return [objective(problem, assign(problem, seed)).value for seed in range(seeds)]


def interval(means: np.ndarray) -> str:
    """Return mean and 95 % interval of per-instance means, in percent."""
    half = 0.0
    if len(means) > 1:
        half = stats.t.ppf(0.975, len(means) - 1) * stats.sem(means)
    return f"{100.0 * means.mean():.1f} ± {100.0 * half:.1f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--instances", type=int, default=5)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--rounds", type=int, default=1000)
    options = parser.parse_args()
    long = InsertionLocalSearch(InsertionParams(options.rounds, 10**12, even=True))
    seconds = dict.fromkeys(LADDER, 0.0)
    columns: dict[str, list[str]] = {name: [] for name in (*LADDER, *DIFFERENCES)}
    for robots, tasks in SIZES:
        gaps = np.zeros((len(LADDER), options.instances))
        for instance in range(options.instances):
            problem = build(random_warehouse(robots, tasks, instance))
            found = []
            for name, assign in LADDER.items():
                begin = time.process_time()
                found.append(values(assign, problem, options.seeds))
                seconds[name] += time.process_time() - begin
            best = min(np.min(found), *values(long, problem, 3))
            gaps[:, instance] = np.mean(found, axis=1) / best - 1.0
        mean = dict(zip(LADDER, gaps, strict=True))
        for name in LADDER:
            columns[name].append(interval(mean[name]))
        for one, other in DIFFERENCES:
            columns[one, other].append(interval(mean[one] - mean[other]))
    runs = len(SIZES) * options.instances * options.seeds
    print("| gap in % |", " | ".join(f"{m}-{n}" for m, n in SIZES), "| CPU s |")
    print("|---" * (len(SIZES) + 2) + "|")
    for name in LADDER:
        print("|", name, "|", " | ".join(columns[name]), f"| {seconds[name] / runs:.3f} |")
    for one, other in DIFFERENCES:
        print("|", f"{one} minus {other}", "|", " | ".join(columns[one, other]), "| |")


if __name__ == "__main__":
    main()
