"""How many orders an hour a fleet serves for ever, and what planning costs.

    python benchmarks/lifelong.py --robots 10 20 40 --minutes 30

The loop here is the smallest there is: who has served an order gets another one; who is refused asks
again after a while, with more effort. `--choose nearest` takes the nearest of the open orders, and
avoids aisles in which others have picks to make.
"""

import argparse
import random
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from clearway.model import Commitment, Pose, Scenario, Trip, Visit, Zone, to_seconds
from clearway.plan.tail_trips import TailTrips, TailTripsParams
from clearway.protocols import Refusal
from clearway.world.lifelong import lifelong_warehouse

RETRY, MOST_RETRY = 1000, 8000  # ticks after which a refused robot asks again, doubled each time
MOST_EFFORT = 16  # doubled each time, too
AISLE_PENALTY = 30.0  # m for each other robot that has picks to make in the same aisle


@dataclass
class Job:
    pick: Zone
    station: Zone


@dataclass
class Tally:
    done: int = 0
    ratios: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    refused: int = 0
    expansions: list[int] = field(default_factory=list)
    waiting: int = 0
    driving: int = 0
    longest: int = 0
    unserved: int = 0


Chooser = Callable[[list[Job], Pose, list[Job]], int]


def first(open_jobs: list[Job], pose: Pose, taken: list[Job]) -> int:
    return 0


def nearest(open_jobs: list[Job], pose: Pose, taken: list[Job]) -> int:
    def score(job: Job) -> float:
        same = sum(aisle(other) == aisle(job) for other in taken)
        return pose_of(job.pick).distance(pose) + AISLE_PENALTY * same

    return min(range(len(open_jobs)), key=lambda i: score(open_jobs[i]))


def aisle(job: Job) -> tuple[bool, int]:
    pose = pose_of(job.pick)
    return pose.x > 50.0, int(pose.y // 6.0)


def pose_of(zone: Zone) -> Pose:
    assert zone.pose is not None
    return zone.pose


def run(scenario: Scenario, params: TailTripsParams, choose: Chooser) -> tuple[Tally, float]:
    rng = random.Random(scenario.seed)
    zones = scenario.site
    picks, stations = zones.zones_of("shelf"), zones.zones_of("station")
    bays = tuple(zone.name for zone in zones.zones_of("parking"))
    begin = time.process_time()
    trips = TailTrips(scenario, params)
    tally = Tally()
    service = scenario.simulation.streams[0].draws[0].service
    open_jobs = [Job(rng.choice(picks), rng.choice(stations)) for _ in range(10)]
    ids = [robot.id for robot in scenario.robots]
    wanted: dict[str, Job] = {}
    since = dict.fromkeys(ids, 0)
    asks = dict.fromkeys(ids, 0)
    tries = dict.fromkeys(ids, 0)
    busy: dict[str, tuple[Job, int, float, int]] = {}
    last_end = dict.fromkeys(ids, 0)
    end = int(1000 * (scenario.simulation.until or 1800.0))
    now = 0
    while now < end:
        for robot in list(busy):
            job, begun, lone, until = busy[robot]
            if until <= now:
                del busy[robot]
                tally.done += 1
                tally.ratios.append((until - begun) / lone)
                since[robot], asks[robot], tries[robot] = until, now, 0
                last_end[robot] = until
        idle = sorted((r for r in ids if r not in busy and asks[r] <= now), key=lambda r: since[r])
        for robot in idle:
            at = trips.commitment(robot)
            pose = position(at, now)
            if robot not in wanted or choose is not first:
                if robot in wanted:
                    open_jobs.append(wanted.pop(robot))
                chosen = choose(open_jobs, pose, [b[0] for b in busy.values()])
                wanted[robot] = open_jobs.pop(chosen)
            job = wanted[robot]
            visits = (
                Visit(None, pose_of(job.pick), service),
                Visit(None, pose_of(job.station), service),
            )
            trip = Trip(robot, visits, "order", None, (job.pick.name, job.station.name), bays)
            clock = time.process_time()
            answer = trips.plan(trip, now, min(2 ** tries[robot], MOST_EFFORT))
            tally.cpu.append(time.process_time() - clock)
            pause = min(RETRY * 2 ** tries[robot], MOST_RETRY)
            tries[robot] += 1
            if isinstance(answer, Refusal):
                tally.refused += 1
                tally.expansions.append(answer.expansions)
                asks[robot] = now + pause
                continue
            tally.longest = max(tally.longest, now - since[robot])
            del wanted[robot]
            open_jobs.append(Job(rng.choice(picks), rng.choice(stations)))
            while len(open_jobs) < 10:
                open_jobs.append(Job(rng.choice(picks), rng.choice(stations)))
            lone = lone_ticks(trips, trip, pose)
            busy[robot] = (job, since[robot], lone, answer.served)
            tally.waiting += sum((w.end or w.begin) - w.begin for w in answer.waits)
            tally.driving += answer.served - now
        times = [b[3] for b in busy.values()] + [asks[r] for r in ids if r not in busy]
        now = max(now + 1, min(times))
    tally.unserved = sum(end - last_end[r] > 300_000 for r in ids)
    return tally, time.process_time() - begin


LONE: dict[tuple[str, Pose, Pose, Pose], float] = {}
LONE_CPU = [0.0]


def lone_ticks(trips: TailTrips, trip: Trip, pose: Pose) -> float:
    clock = time.process_time()
    found = trips.lone(trip, pose)
    LONE_CPU[0] += time.process_time() - clock
    return float(found)


def position(commitment: Commitment, now: int) -> Pose:
    trajectory = commitment.trajectory
    pose = trajectory.start
    for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
        if begin >= now:
            break
        pose = piece.at(min(1.0, (now - begin) / (end - begin)))
    return pose


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 20, 40])
    parser.add_argument("--fleet", default="cars")
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--choose", choices=("first", "nearest"), default="first")
    parser.add_argument("--limit", type=int)
    parser.add_argument("--rests", type=int)
    parser.add_argument("--effort", type=int)
    parser.add_argument("--search", nargs="*", default=[])
    options = parser.parse_args()
    given = {
        "search_limit": options.limit,
        "most_rests": options.rests,
        "most_effort": options.effort,
    }
    params = TailTripsParams(**{key: value for key, value in given.items() if value is not None})
    for pair in options.search:
        key, value = pair.split("=")
        setattr(params.core.search, key, type(getattr(params.core.search, key))(float(value)))
    chooser = first if options.choose == "first" else nearest
    for robots in options.robots:
        for seed in options.seeds:
            scenario = lifelong_warehouse(
                robots, seed, fleet=options.fleet, minutes=options.minutes
            )
            LONE_CPU[0] = 0.0
            tally, cpu = run(scenario, params, chooser)
            ms = 1000.0 * np.array(tally.cpu)
            print(
                f"{robots} {options.fleet} seed {seed}: {tally.done * 60.0 / options.minutes:.0f} orders/h, "
                f"ratio {statistics.fmean(tally.ratios or [0]):.2f}, "
                f"waiting {tally.waiting / max(1, tally.driving):.1%}, replans {len(ms)} "
                f"({tally.refused} refused), {np.median(ms):.1f} / {np.percentile(ms, 99):.1f} ms, "
                f"CPU {cpu - LONE_CPU[0]:.1f} s (lone {LONE_CPU[0]:.1f}), longest refusal {to_seconds(tally.longest):.0f} s, "
                f"unserved {tally.unserved}",
                flush=True,
            )


if __name__ == "__main__":
    main()
