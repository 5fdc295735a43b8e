"""What a second of a robot's life costs, with ever more robots on a site enlarged in proportion.

    python benchmarks/lane_fleets.py

System B simulated, 12.5 orders a robot; the site grows upwards, with stations and shelves.
"""

import argparse
import time
from dataclasses import replace

from clearway.model import Layout
from clearway.systems.simulate import run_through_time
from clearway.world.shelf_batch import shelf_batch

BANDS_PER_ROBOT = 7 / 20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, nargs="+", default=[20, 50, 100, 200, 500])
    parser.add_argument("--rules", default="waiting", choices=["waiting", "search"])
    arguments = parser.parse_args()
    print("robots  bands  orders  CPU s  robot-seconds  us each  of that at 20  cells a trip")
    first = None
    for robots in arguments.robots:
        bands = round(BANDS_PER_ROBOT * robots)
        scenario = shelf_batch(
            Layout("bidirectional", bands=bands),
            robots,
            robots * 25 // 2,
            0,
            everywhere=True,
            settings={"rules": arguments.rules},
        )
        # Chargers stay at the upper wall, which is not in proportion.
        kinds = {name: replace(kind, battery=None) for name, kind in scenario.robot_types.items()}
        begin = time.process_time()
        run = run_through_time(replace(scenario, robot_types=kinds))
        spent = time.process_time() - begin
        end = run.trace.events[-1]
        lived = robots * end["t"]
        cost = 1e6 * spent / lived
        first = first or cost
        cells = end["distance"] / max(1, 3 * end["orders_done"])
        print(
            f"{robots:6d} {bands:6d} {end['orders_done']:7d} {spent:6.2f} {lived:14.0f} "
            f"{cost:8.1f} {cost / first:14.2f} {cells:13.1f}"
        )


if __name__ == "__main__":
    main()
