"""Expanded states a second among the warehouse's shelves, body checks included.

Plans seeded warehouses with plain A* weights (1.0), so that searches are large, up to a number
of expansions each, and prints expansions over planning CPU: tables, distance fields and goal
distances are made inside that time.

    python benchmarks/expansions.py [EXPANSIONS]
"""

import sys
import time

from clearway.coordinate import plan_once
from clearway.protocols import Budget
from clearway.systems import HierarchicalSettings, hierarchical
from clearway.world.warehouse import random_warehouse


def rate(robots: int, tasks: int, seeds: range, limit: int) -> tuple[int, float]:
    expansions, seconds = 0, 0.0
    for seed in seeds:
        system = hierarchical(HierarchicalSettings(weight=1.0))
        params = system.plan.params
        search = params.search
        search.tail_weight = 1.0
        params.search = search
        begin = [0.0]

        def start(begin: list[float] = begin) -> None:
            begin[0] = time.process_time()

        plan = plan_once(
            random_warehouse(robots, tasks, seed),
            system,
            Budget(expansions=limit),
            seed,
            before_planning=start,
        )
        seconds += time.process_time() - begin[0]
        expansions += plan.counters["expansions"]
    return expansions, seconds


def main() -> None:
    limit = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
    print("| robots | tasks | expansions | planning CPU s | a second |")
    print("|---|---|---|---|---|")
    for robots, tasks in ((1, 3), (8, 24), (16, 48)):
        expansions, seconds = rate(robots, tasks, range(4), limit)
        print(
            f"| {robots} | {tasks} | {expansions:,} | {seconds:.2f} | {expansions / seconds:,.0f} |"
        )


if __name__ == "__main__":
    main()
