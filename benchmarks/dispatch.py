"""What looking ahead saves in system B, and how much is left: makespans side by side, paired seeds.

The points of Figs. 17 and 18 by default, all ways searched in space and time. ``saved`` is the mean
over seeds of how far looking ahead lies below nearest idle, with its 95 % interval; ``over bound``
is how far both lie above the lower bound; CPU seconds are those of a whole run.

    python benchmarks/dispatch.py [--seeds N] [--layout RULE] [--turn SECONDS]
        [--rules search|waiting] [--points ROBOTSxORDERS ...]
"""

import argparse
import time

from clearway.assign import makespan_bound
from clearway.model import Layout, Scenario
from clearway.study.statistics import mean, saving
from clearway.systems.simulate import run_through_time
from clearway.world.shelf_batch import shelf_batch

E17 = tuple(f"10x{orders}" for orders in (50, 100, 150, 200, 250))
E18 = tuple(f"{robots}x50" for robots in (5, 15, 20))


def makespan(scenario: Scenario) -> tuple[float, float]:
    """Return the makespan (s) and the CPU time (s) of a run."""
    begin = time.process_time()
    run = run_through_time(scenario)
    end = run.trace.events[-1]
    if run.status != "done":
        raise SystemExit(f"{scenario.name}, seed {scenario.seed}: {run.status}, {end}")
    return float(end["makespan"]), time.process_time() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--layout", default="bidirectional")
    parser.add_argument("--turn", type=float, default=0.0)
    parser.add_argument("--rules", default="search")
    parser.add_argument("--points", nargs="+", default=[*E17, *E18])
    given = parser.parse_args()
    print("| robots, orders | nearest s | ahead s | saved % | over bound % | CPU s |")
    print("|---|---|---|---|---|---|")
    for point in given.points:
        robots, orders = map(int, point.split("x"))
        spans: dict[str, list[float]] = {"nearest": [], "ahead": []}
        cpu = dict.fromkeys(spans, 0.0)
        bounds = []
        for seed in range(given.seeds):
            for dispatch, found in spans.items():
                scenario = shelf_batch(
                    Layout(given.layout),
                    robots,
                    orders,
                    seed,
                    turn_seconds=given.turn,
                    settings={"dispatch": dispatch, "rules": given.rules},
                )
                end, spent = makespan(scenario)
                found.append(end)
                cpu[dispatch] += spent / given.seeds
            bounds.append(makespan_bound(scenario))
            assert bounds[-1] <= min(spans["nearest"][-1], spans["ahead"][-1])
        saved = saving(spans["ahead"], spans["nearest"])
        over = [100.0 * (mean(found).value / mean(bounds).value - 1.0) for found in spans.values()]
        print(
            f"| {robots}, {orders} | {mean(spans['nearest']).value:.0f} "
            f"| {mean(spans['ahead']).value:.0f} | {saved} | {over[0]:.0f}, {over[1]:.0f} "
            f"| {cpu['nearest']:.2f}, {cpu['ahead']:.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
