"""What the weights of the search buy: planning CPU and sums of costs side by side, in one run.

Warehouses of 16 robots and 48 tasks, seeds 0 to 5, each combination of the weight on the current
leg's heuristic and on the legs after it.

    python benchmarks/weights.py
"""

import time

from clearway.coordinate import plan_once
from clearway.protocols import Budget
from clearway.systems import HierarchicalSettings, hierarchical
from clearway.world.warehouse import random_warehouse

CHOICES = ((1.1, 1.1), (1.1, 1.5), (1.1, 2.0), (1.3, 2.0), (1.0, 2.0))


def main() -> None:
    sites = [random_warehouse(16, 48, seed) for seed in range(6)]
    print("| weight | on later legs | solved | planning CPU s | expansions | sum of costs s |")
    print("|---|---|---|---|---|---|")
    for weight, tail in CHOICES:
        seconds, expansions, total, solved = 0.0, 0, 0.0, 0
        for seed, site in enumerate(sites):
            system = hierarchical(HierarchicalSettings(weight=weight))
            params = system.plan.params
            search = params.search
            search.tail_weight = tail
            params.search = search
            begin = [0.0]

            def start(begin: list[float] = begin) -> None:
                begin[0] = time.process_time()

            plan = plan_once(site, system, Budget(), seed, before_planning=start)
            seconds += time.process_time() - begin[0]
            expansions += plan.counters["expansions"]
            total += sum(path.end for path in plan.trajectories.values()) / 1000.0
            solved += bool(plan)
        print(
            f"| {weight} | {tail} | {solved} of {len(sites)} | {seconds:.2f} | {expansions:,} "
            f"| {total:.1f} |"
        )


if __name__ == "__main__":
    main()
