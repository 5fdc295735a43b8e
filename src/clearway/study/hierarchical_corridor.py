"""Fig. 6 of system A's paper: fleets that cross to the middle, planned in several ways."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from clearway.protocols import Budget
from clearway.study import statistics
from clearway.study.experiment import Cell, Row, Scale, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.methods import ADAPTIVE, CORRIDOR, OPTIMAL, XI_ADAPTIVE, XI_ONE, words_of
from clearway.study.statistics import Estimate
from clearway.systems import HierarchicalSettings, hierarchical, make_plan
from clearway.validate import validate_plan
from clearway.world.corridor import random_corridor

ROBOTS, QUICK_ROBOTS = (2, 4, 6, 8, 12, 16), (4, 8, 16)
MANY = 8  # robots up to which all instances are tried by every method
# The paper, Sec. 4.2: at 8 robots adaptive xi costs so much more than xi = 1 (per cent), and
# saves so much of the time (per cent).
DEARER, FASTER = 3.2, 82.5
# Where a row tells the bound on the finite graph that was searched, and the graph's name.
BOUND, GRAPH = "discrete_bound_value", "discrete_bound_graph"


def cells(scale: Scale) -> Sequence[Cell]:
    """Return 30 instances for each number of robots and method; three in the quick version."""
    found = []
    seeds = scale.seeds(30, 3)
    for robots in QUICK_ROBOTS if scale.quick else ROBOTS:
        for label, method in CORRIDOR.items():
            own = (scale.quick and method.quick) or method.budget
            budget = own if scale.budget == Budget() else scale.budget
            effort = {"seconds": budget.seconds, "expansions": budget.expansions}
            found += [
                Cell({"robots": robots, "method": label, **effort}, seed)
                for seed in seeds[: method.few if robots > MANY else None]
            ]
    return found


def row(cell: Cell) -> Row:
    """Plan an instance and judge the plan; costs in m."""
    settings = cell.settings
    system = replace(
        hierarchical(HierarchicalSettings(objective="paper", park="never")),
        plan=CORRIDOR[settings["method"]].make(),
    )
    planned = make_plan(
        random_corridor(settings["robots"], cell.seed),
        system=system,
        seed=cell.seed,
        budget=Budget(settings["seconds"], settings["expansions"]),
        clock=time.process_time,
    )
    record = planned.record
    is_complete = bool(record.status)
    lengths = [path.distance for path in planned.plan.trajectories.values()]
    return {
        "status": record.status.value,
        "reason": record.reason,
        "clean": not validate_plan(record),
        "cost": record.cost if is_complete else None,
        "cost_lower_bound": record.cost_lower_bound,
        **{f"discrete_bound_{k}": v for k, v in (record.discrete_bound or {}).items()},
        "farthest": max(lengths, default=0.0) if is_complete else None,
        "sum_of_costs": record.sum_of_costs if is_complete else None,
        "makespan": record.makespan if is_complete else None,
        "plan_cpu_s": record.timings["plan_s"],
        "expansions_done": planned.plan.counters["expansions"],
    }


def summarise(rows: Sequence[Row]) -> Summary:
    """Return success, time and cost over the number of robots, and the paper's claims."""
    robots = sorted({row["robots"] for row in rows})
    return Summary((_table(rows, robots),), (_chart(rows, robots),), _findings(rows, robots))


def _cost_ratio(rows: Sequence[Row], row: Row) -> float:
    """Return cost by the best bound that any method has proven for the instance."""
    same = [r for r in rows if (r["robots"], r["seed"]) == (row["robots"], row["seed"])]
    return float(row["cost"] / max(_proven(each, row.get(GRAPH)) for each in same))


def _proven(row: Row, graph: str | None) -> float:
    """Return the least cost of any plan on a finite graph, as far as this row proves it.

    A bound for continuous motion holds on every graph, a bound on a graph on that one only.
    """
    on_graph = row.get(BOUND) if graph is not None and row.get(GRAPH) == graph else 0.0
    return float(max(row["cost_lower_bound"] or 0.0, on_graph or 0.0))


def _own_gap(row: Row) -> float:
    """Return by how many per cent a plan is dearer than what its own row proves."""
    return 100.0 * (float(row["cost"]) / _proven(row, row.get(GRAPH)) - 1.0)


def _is_optimal(row: Row) -> bool:
    """Whether the row proves its own plan to be the best one on its graph."""
    return row["status"] == "solved" and _own_gap(row) <= 1e-7


def _solved(rows: Sequence[Row], robots: int, method: str) -> tuple[list[Row], int]:
    """Return the complete plans of a method, and how many instances it was given."""
    all_of = [row for row in rows if (row["robots"], row["method"]) == (robots, method)]
    return [row for row in all_of if row["status"] == "solved"], len(all_of)


def _success(rows: Sequence[Row], robots: int, method: str) -> Estimate | None:
    solved, count = _solved(rows, robots, method)
    return statistics.share(len(solved), count) if count else None


def _seconds(rows: Sequence[Row], robots: int, method: str) -> Estimate | None:
    """Return the median of CPU seconds, of all instances: unsolved ones took theirs too."""
    spent = [
        row["plan_cpu_s"] for row in rows if (row["robots"], row["method"]) == (robots, method)
    ]
    return statistics.median(spent) if spent else None


def _ratio(rows: Sequence[Row], robots: int, method: str) -> Estimate | None:
    solved, _ = _solved(rows, robots, method)
    return statistics.median([_cost_ratio(rows, row) for row in solved]) if solved else None


def _farthest(rows: Sequence[Row], robots: int, method: str) -> Estimate | None:
    solved, _ = _solved(rows, robots, method)
    return statistics.mean([row["farthest"] for row in solved]) if solved else None


def _table(rows: Sequence[Row], robots: Sequence[int]) -> Table:
    lines = []
    for number in robots:
        for method in CORRIDOR:
            solved, count = _solved(rows, number, method)
            if not count:
                continue
            clean = sum(row["clean"] for row in solved)
            optimal = sum(_is_optimal(row) for row in solved)
            told = [
                "-" if value is None else str(value)
                for value in (
                    _seconds(rows, number, method),
                    _ratio(rows, number, method),
                    statistics.mean([row["cost"] for row in solved]) if solved else None,
                    _farthest(rows, number, method),
                )
            ]
            counted = (f"{len(solved)} of {count}", str(clean), str(optimal))
            lines.append((str(number), method, *counted, *told))
    return Table(
        "By robots and method",
        (
            "robots",
            "method",
            "solved",
            "judged clean",
            "proven optimal",
            "CPU s, median",
            "cost / best proven bound, median",
            "cost (m), mean",
            "farthest (m), mean",
        ),
        tuple(lines),
        "Seconds are of all instances, costs of the solved ones. The best bound on an instance "
        "is the highest that any method has proven for it, on the graph that the plan is from.",
    )


def _chart(rows: Sequence[Row], robots: Sequence[int]) -> Chart:
    def lines(of: Callable[[Sequence[Row], int, str], Estimate | None]) -> tuple[Series, ...]:
        series = []
        for colour, method in enumerate(CORRIDOR):
            known = [(float(n), each) for n in robots if (each := of(rows, n, method)) is not None]
            series.append(Series.of(method, known, colour=colour))
        return tuple(series)

    ticks = tuple((float(n), str(n)) for n in robots)
    panels = (
        Panel("robots", "instances solved (%)", lines(_success), "Success", ticks, from_zero=True),
        Panel("robots", "CPU time (s), median", lines(_seconds), "Time", ticks, log=True),
        Panel("robots", "cost / best proven bound, median", lines(_ratio), "Cost", ticks),
        Panel("robots", "farthest drive (m), mean", lines(_farthest), "Distance", ticks),
    )
    note = "Bars are 95 % intervals; medians of fewer than six instances have none."
    return Chart("corridor", "Crossing to the middle of the warehouse", panels, note, columns=2)


def _findings(rows: Sequence[Row], robots: Sequence[int]) -> tuple[Finding, ...]:
    """Compare with the paper's claims and with what we set out to reach."""
    found = []
    for number in (12, 16):
        solved, count = _solved(rows, number, XI_ONE)
        found.append(
            Finding(
                f"Paper, Sec. 4.2: xi = 1 solves no instance of {number} robots within 100 s",
                f"{XI_ONE}: {len(solved)} of {count} solved",
                not solved if count else None,
            )
        )
    return (*found, *_adaptive_against_one(rows), *_aims(rows))


def _aims(rows: Sequence[Row]) -> list[Finding]:
    solved, count = _solved(rows, 16, ADAPTIVE)
    told, holds = f"{len(solved)} of {count} solved", None if not count else False
    if solved:
        seconds = statistics.median([row["plan_cpu_s"] for row in solved])
        told += f", median {seconds} s of CPU"
        holds = len(solved) == count and seconds.value < 0.5
    ratio = _ratio(rows, 8, ADAPTIVE)
    above = None if ratio is None else 100.0 * (ratio.value - 1.0)
    return [
        Finding(
            f"Aim: {ADAPTIVE} solves all instances of 16 robots, median under 0.5 s", told, holds
        ),
        *(_proofs(rows, number, least) for number, least in ((4, 1.0), (8, 0.5))),
        Finding(
            f"Aim: at 8 robots {ADAPTIVE} costs at most {DEARER} % more than the best proven bound",
            "none solved" if above is None else f"median {statistics.figure(above)} % above",
            None if above is None else above <= DEARER,
        ),
    ]


def _proofs(rows: Sequence[Row], robots: int, least: float) -> Finding:
    """Tell whether the optimal mode proves at least this share of its plans optimal."""
    solved, count = _solved(rows, robots, OPTIMAL)
    proven = sum(_is_optimal(row) for row in solved)
    claim = f"Aim: {OPTIMAL} proves {100.0 * least:.0f} % of its plans of {robots} robots optimal"
    told = f"{proven} of {count} proven"
    gaps = [_own_gap(row) for row in solved if not _is_optimal(row)]
    if gaps:
        told += f"; the gap of the {len(gaps)} other plans: median {statistics.median(gaps)} %"
    return Finding(claim, told, proven >= least * count if count else None)


def _adaptive_against_one(rows: Sequence[Row]) -> list[Finding]:
    """Compare the two on the instances of 8 robots that both solve."""
    claims = (
        f"Paper, Sec. 4.2: at 8 robots adaptive xi costs {DEARER} % more than xi = 1",
        f"Paper, Sec. 4.2: at 8 robots adaptive xi saves {FASTER} % of the time of xi = 1",
    )
    theirs = {row["seed"]: row for row in _solved(rows, 8, XI_ONE)[0]}
    both = [
        (row, theirs[row["seed"]])
        for row in _solved(rows, 8, XI_ADAPTIVE)[0]
        if row["seed"] in theirs
    ]
    if len(both) < 2:
        return [Finding(claim, "fewer than two instances solved by both", None) for claim in claims]
    dearer = statistics.mean([100.0 * (a["cost"] / b["cost"] - 1.0) for a, b in both])
    faster = statistics.saving(
        [a["plan_cpu_s"] for a, _ in both], [b["plan_cpu_s"] for _, b in both]
    )
    return [
        Finding(
            claims[0],
            f"{dearer} % over {dearer.count} instances",
            dearer.low <= DEARER <= dearer.high,
        ),
        Finding(
            claims[1],
            f"{faster} % over {faster.count} instances",
            faster.low <= FASTER <= faster.high,
        ),
    ]


STUDY = Study(
    name="hierarchical-corridor",
    title="Crossing to the middle of the warehouse: Fig. 6 of system A's paper",
    version=1,
    setting=(
        "The warehouse of 100 m x 60 m; half of the robots start along its left wall, half along "
        "its right one, each with a target of its own on the middle line; traffic crosses "
        "through the aisles.",
        "Cost: the paper's eq. 21 (m, twice while turning, 3 per change of mode, 0.1 per second "
        "of waiting). Intervals are 95 %.",
        "Seconds are of one core, planning only.",
    ),
    parts=words_of(CORRIDOR),
    cells=cells,
    row=row,
    summarise=summarise,
)
