"""What travel costs and reassignment buy: sums of costs and CPU side by side, in one run.

Warehouses of 4 robots and 12 tasks, and of 8 and 24, 20 seeds each; first plans, or with a budget
of expansions the best it allows.
``both`` is sum of costs and makespan together, which is what assigners with equal weights
minimise (but for turns); it is compared with that of grid distances and no round. ``better`` counts
seeds whose plan is not the first one; CPU seconds are those of assigning and planning, per seed.

    python benchmarks/travel.py [SEEDS [EXPANSIONS]]
"""

import sys
import time

from clearway.coordinate import plan_once
from clearway.protocols import Budget
from clearway.systems import HierarchicalSettings, hierarchical
from clearway.world.warehouse import random_warehouse

SIZES = ((4, 12), (8, 24))
ROUNDS = (0, 1, 3)


def main() -> None:
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    budget = Budget(expansions=int(sys.argv[2])) if len(sys.argv) > 2 else Budget()
    print(
        "| robots, tasks | travel | rounds | solved | sum s | makespan s | both | better | CPU s |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for robots, tasks in SIZES:
        sites = [random_warehouse(robots, tasks, seed) for seed in range(seeds)]
        base = 0.0
        for travel in ("grid", "curves", "planned"):
            for rounds in ROUNDS:
                system = hierarchical(HierarchicalSettings(travel=travel, rounds=rounds))
                sums, makespans, solved, better = [], [], 0, 0
                begin = time.process_time()
                for seed, site in enumerate(sites):
                    plan = plan_once(site, system, budget, seed)
                    ends = [path.end / 1000.0 for path in plan.trajectories.values()]
                    sums.append(sum(ends))
                    makespans.append(max(ends))
                    solved += bool(plan)
                    better += plan.counters.get("reassigned", 0) > 0
                seconds = (time.process_time() - begin) / seeds
                both = sum(sums) + sum(makespans)
                base = base or both
                print(
                    f"| {robots}, {tasks} | {travel} | {rounds} | {solved} of {seeds} "
                    f"| {sum(sums) / seeds:.1f} | {sum(makespans) / seeds:.1f} "
                    f"| {100.0 * (both / base - 1.0):+.2f} % | {better} | {seconds:.2f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
