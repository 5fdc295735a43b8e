"""The row of the assignment studies: trials of an assigner on a site, one of them planned."""

import time
from collections.abc import Iterable, Sequence
from random import Random
from statistics import fmean

from clearway.assign import build
from clearway.protocols import Budget, objective
from clearway.study.experiment import Cell, Row, Scale
from clearway.study.methods import ASSIGNERS, PLANNER, system_of, words_of
from clearway.study.statistics import Estimate, mean
from clearway.systems import make_plan
from clearway.validate import validate_plan
from clearway.world.warehouse import random_warehouse

TRIALS, QUICK_TRIALS = 20, 3

PARTS = {**words_of(ASSIGNERS), "planner": PLANNER.words}
SITE = (
    "Sites: the warehouse of 100 m x 60 m with 18 shelves, seeded starts and tasks, 5 s of service "
    "at each task; the paper's own instances are not published, so its comparison is reproduced, "
    "not its numbers.",
    "Fitness: longest route + all routes + turns, on 1 m cells; even split but for ours.",
    "Cost: the paper's eq. 21 of the plan as driven (m, twice while turning, 3 per change of "
    "mode, 0.1 per second of waiting); robots whose last task would shut others in drive on to a "
    "parking bay, which is in the cost.",
    "Intervals are 95 %.",
)


def cells(
    fleets: Iterable[tuple[int, int]], methods: Iterable[str], scale: Scale, seeds: range
) -> list[Cell]:
    """Return a cell per number of robots and tasks, method and seed."""
    names = list(methods)
    shared = {
        "trials": QUICK_TRIALS if scale.quick else TRIALS,
        "seconds": scale.budget.seconds,
        "expansions": scale.budget.expansions,
    }
    return [
        Cell({"robots": robots, "tasks": tasks, "method": name, **shared}, seed)
        for robots, tasks in fleets
        for name in names
        for seed in seeds
    ]


def row(cell: Cell) -> Row:
    """Assign in each trial, plan one trial drawn at random, judge the plan; lengths in m."""
    settings, trials = cell.settings, cell.settings["trials"]
    scenario = random_warehouse(settings["robots"], settings["tasks"], cell.seed)
    system = system_of(settings["method"])
    problem = build(scenario)
    begin = time.process_time()
    routes = [system.assign(problem, trial) for trial in range(trials)]
    spent = time.process_time() - begin
    fitness = [objective(problem, each).value for each in routes]
    drawn = Random(cell.seed).randrange(trials)
    planned = make_plan(
        scenario,
        system=system,
        seed=drawn,
        budget=Budget(settings["seconds"], settings["expansions"]),
        clock=time.process_time,
    )
    record = planned.record
    driven = [
        planned.plan.trajectories[robot.id].distance if robot.id in record.tracks else 0.0
        for robot in scenario.robots
    ]
    is_complete = bool(record.status)
    return {
        "average_fitness": fmean(fitness),
        "best_fitness": min(fitness),
        "drawn_fitness": fitness[drawn],
        "assign_cpu_s": spent / trials,
        "status": record.status.value,
        "reason": record.reason,
        "clean": not validate_plan(record),
        "farthest": max(driven, default=0.0) if is_complete else None,
        "average_distance": fmean(driven) if is_complete else None,
        "total_distance": sum(driven) if is_complete else None,
        "total_cost": record.cost if is_complete else None,
        "makespan": record.makespan if is_complete else None,
        "plan_cpu_s": record.timings["plan_s"],
        "plan_expansions": planned.plan.counters["expansions"],
    }


def pick(rows: Sequence[Row], **wanted: object) -> list[Row]:
    """Return the complete rows that have these settings, in order."""
    return [
        row
        for row in rows
        if row["status"] == "solved" and all(row[name] == value for name, value in wanted.items())
    ]


def pairs(ours: Sequence[Row], theirs: Sequence[Row], name: str) -> tuple[list[float], list[float]]:
    """Return the values of rows on the same instances."""
    known = {(row["robots"], row["tasks"], row["seed"]): row[name] for row in theirs}
    both = [
        (row[name], known[place])
        for row in ours
        if (place := (row["robots"], row["tasks"], row["seed"])) in known
    ]
    return [a for a, _ in both], [b for _, b in both]


def means(rows: Sequence[Row], name: str, over: str) -> list[tuple[float, Estimate]]:
    """Return the mean of ``name`` for each value of ``over`` that rows have, with that value."""
    return [
        (float(place), mean([row[name] for row in rows if row[over] == place]))
        for place in sorted({row[over] for row in rows})
    ]


def completeness(rows: Sequence[Row]) -> str:
    """Return a sentence on how many rows are complete plans, and right ones."""
    solved = sum(row["status"] == "solved" for row in rows)
    clean = sum(row["clean"] for row in rows)
    return (
        f"{solved} of {len(rows)} plans are complete, {clean} of {len(rows)} are judged free of "
        "violations; figures are of the complete ones."
    )
