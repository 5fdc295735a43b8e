"""Expanded states a second, body checks included: eleven modes among shelves, and cars in the open.

Each row plans four seeded sites with an effort of so many expansions each: a first plan, and the
rest on improving it. Tables, distance fields and goal distances are made inside that time, and
every motion is tested with its true footprint against obstacles and all robots planned before.

    python benchmarks/expansions.py [EXPANSIONS]
"""

import sys
import time
from collections.abc import Callable
from functools import partial

from clearway.coordinate import plan_once
from clearway.model import Scenario
from clearway.protocols import Budget
from clearway.systems import choose_system
from clearway.world.generate import generate
from clearway.world.warehouse import random_warehouse

SEEDS = range(4)


def warehouse(robots: int, tasks: int, seed: int) -> Scenario:
    return random_warehouse(robots, tasks, seed)


def open_floor(robots: int, side: float, seed: int) -> Scenario:
    return generate("open", robots=robots, size=(side, side), density=0.01, seed=seed)


CASES: dict[str, Callable[[int], Scenario]] = {
    "11 modes, warehouse, 8 robots": partial(warehouse, 8, 24),
    "11 modes, warehouse, 16 robots": partial(warehouse, 16, 48),
    "cars, 100 m x 100 m, 10": partial(open_floor, 10, 100.0),
    "cars, 100 m x 100 m, 50": partial(open_floor, 50, 100.0),
    "cars, 100 m x 100 m, 100": partial(open_floor, 100, 100.0),
    "cars, 300 m x 300 m, 100": partial(open_floor, 100, 300.0),
}


def rate(made: Callable[[int], Scenario], limit: int) -> tuple[int, float]:
    """Return expansions and planning CPU seconds over all seeds."""
    expansions, seconds = 0, 0.0
    for seed in SEEDS:
        scenario = made(seed)
        begin = [0.0]

        def start(begin: list[float] = begin) -> None:
            begin[0] = time.process_time()

        budget = Budget(expansions=limit)
        plan = plan_once(scenario, choose_system(scenario), budget, seed, before_planning=start)
        seconds += time.process_time() - begin[0]
        expansions += plan.counters["expansions"]
    return expansions, seconds


def main() -> None:
    limit = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
    print("| robots | expansions | planning CPU s | a second |")
    print("|---|---|---|---|")
    for name, made in CASES.items():
        expansions, seconds = rate(made, limit)
        print(
            f"| {name} | {expansions:,} | {seconds:.2f} | {expansions / seconds:,.0f} |", flush=True
        )


if __name__ == "__main__":
    main()
