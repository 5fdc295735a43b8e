"""Conflict-based search on the corridor: what each part gains, what is proven in which time.

python benchmarks/conflicts.py [SEEDS [SECONDS]]: instances of each size (default 10), and seconds
for each proof (default 60).
"""

import sys
import time
from statistics import median

from clearway.model import Problem
from clearway.plan import ConflictBasedSearch, ConflictParams
from clearway.protocols import Budget
from clearway.world.corridor import random_corridor


def problem_of(robots, seed):
    scenario = random_corridor(robots, seed)
    tours = {order.task.robot: order.task.visits for order in scenario.orders}
    return Problem(scenario.site, scenario.robot_types, scenario.robots, tours)


def run(robots, seeds, seconds, **choices):
    """Return CPU seconds, plans, of all instances."""
    found = []
    for seed in range(seeds):
        problem = problem_of(robots, seed)
        begin = time.process_time()
        plan = ConflictBasedSearch(ConflictParams(**choices))(problem, Budget(seconds=seconds), 0)
        found.append((time.process_time() - begin, plan))
    return found


def told(label, found):
    cpu = [seconds for seconds, _ in found]
    plans = [plan for _, plan in found]
    proven = sum(plan.counters["proven"] for plan in plans)
    factors = [p.discrete_bound.get("factor") for p in plans if p]
    gaps = [100.0 * (factor - 1.0) for factor in factors if factor]
    print(
        f"{label:44} solved {sum(map(bool, plans)):2} of {len(plans)}, proven {proven:2}, "
        f"CPU s median {median(cpu):6.2f} max {max(cpu):6.2f}, "
        f"expansions median {median(p.counters['expansions'] for p in plans):9,.0f}"
        + (f", gap % median {median(gaps):.2f} max {max(gaps):.2f}" if gaps else ""),
        flush=True,
    )


def main(seeds=10, seconds=60.0):
    print("Look back from the goals (second frontier) against the bound without it, optimal, time")
    for robots in (2, 4):
        for heuristic in ("bound", "look_back"):
            choices = {"mode": "optimal", "paper_cost": False, "heuristic": heuristic}
            told(f"{robots} robots, {heuristic}", run(robots, seeds, seconds, **choices))
    print("Proofs")
    for paper_cost in (False, True):
        for robots in (2, 4, 6, 8):
            choices = {"mode": "optimal", "paper_cost": paper_cost}
            label = f"{robots} robots, {'paper cost' if paper_cost else 'time'}"
            told(label, run(robots, seeds, seconds, **choices))
    print("Adaptive, paper cost")
    for robots in (8, 16):
        told(f"{robots} robots", run(robots, seeds, 100.0))


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:2]), *(float(word) for word in sys.argv[2:3]))
