"""How many orders an hour system A serves for ever, and what planning costs.

    python benchmarks/lifelong.py --robots 10 20 40 --minutes 30 --dispatch nearest --judge

Ratio: from the end of an order to the end of the robot's next one, over what the same visits take
with nobody else on the site. Seconds are of the processor, of planning alone.
"""

import argparse
import statistics
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from clearway.model import Commitment, Scenario, Trip, to_seconds, to_ticks
from clearway.plan.tail_trips import TailTrips, TailTripsParams
from clearway.protocols import Refusal
from clearway.systems.choose import choose_lifelong
from clearway.systems.simulate import run_through_time
from clearway.validate.trace_judge import validate_trace
from clearway.world.lifelong import lifelong_warehouse

UNSERVED = 300.0  # s


class Timed(TailTrips):
    """Keeps count of what is asked of it."""

    def __init__(self, scenario: Scenario, params: TailTripsParams) -> None:
        begin = time.process_time()
        super().__init__(scenario, params)
        self.setup = time.process_time() - begin
        self.end = to_ticks(scenario.simulation.until or 0.0)
        self.seconds: list[float] = []
        self.ratios: list[float] = []
        self.waiting = self.lasting = self.done = 0
        self.served: dict[str, list[int]] = {robot.id: [0] for robot in scenario.robots}

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        old = self.commitment(trip.robot)
        pose = old.trajectory.at(max(now, old.served))
        begin = time.process_time()
        answer = super().plan(trip, now, effort, lead)
        self.seconds.append(time.process_time() - begin)
        if isinstance(answer, Commitment) and answer.served <= self.end:
            last = self.served[trip.robot][-1]
            # Orders are released at moments that mean nothing to who begins at 0.
            free = tuple(replace(visit, not_before=0.0) for visit in trip.visits)
            lone = self.lone(replace(trip, visits=free), pose)
            self.served[trip.robot].append(answer.served)
            self.done += 1
            if lone:
                self.ratios.append((answer.served - last) / lone)
            self.lasting += answer.served - last
            stood = (min(w.end or 0, answer.served) - w.begin for w in answer.waits)
            self.waiting += sum(max(0, ticks) for ticks in stood)
            self.waiting += max(0, now - last)
        return answer

    def unserved(self) -> int:
        """Robots that have gone without the end of an order for long."""
        gaps = [np.diff([*ticks, self.end]).max() for ticks in self.served.values()]
        return sum(gap > to_ticks(UNSERVED) for gap in gaps)


def measure(scenario: Scenario, params: TailTripsParams, judge: bool) -> str:
    made: list[Timed] = []

    def trips(given: Scenario) -> Timed:
        made.append(Timed(given, params))
        return made[0]

    system = replace(choose_lifelong(scenario), trips=trips)
    run = run_through_time(scenario, system)
    timed = made[0]
    ms = 1000.0 * np.array(timed.seconds)
    hours = to_seconds(timed.end) / 3600.0
    told = [
        f"{timed.done / hours:.0f} orders/h",
        f"ratio {statistics.fmean(timed.ratios):.2f}",
        f"waiting {timed.waiting / timed.lasting:.1%}",
        f"{len(ms)} replans ({timed.counters['refused']} searches in vain, "
        f"{timed.counters['last_resorts']} last resorts)",
        f"{np.median(ms):.1f} / {np.percentile(ms, 99):.1f} ms",
        f"{ms.sum() / 1000.0 + timed.setup:.1f} s",
        f"over {UNSERVED:.0f} s unserved {timed.unserved()}",
        f"ended as {run.status}",
    ]
    if judge:
        told.append(f"violations {len(validate_trace(run.trace))}")
    return ", ".join(told)


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 20, 40])
    parser.add_argument("--fleet", default="cars", choices=("cars", "carriers"))
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--dispatch", default="oldest", choices=("oldest", "nearest"))
    parser.add_argument("--judge", action="store_true", help="judge what was driven")
    for name in ("search_limit", "most_effort", "most_rests"):
        parser.add_argument(f"--{name}", type=int)
    options = parser.parse_args(arguments)
    given = {name: getattr(options, name) for name in ("search_limit", "most_effort", "most_rests")}
    params = TailTripsParams(**{name: value for name, value in given.items() if value is not None})
    for robots in options.robots:
        for seed in options.seeds:
            scenario = lifelong_warehouse(
                robots, seed, fleet=options.fleet, minutes=options.minutes
            )
            scenario = replace(scenario, settings={"dispatch": options.dispatch})
            result = measure(scenario, params, options.judge)
            print(
                f"{robots} {options.fleet}, {options.dispatch}, seed {seed}: {result}", flush=True
            )


if __name__ == "__main__":
    main()
