"""Fig. 8 of system A's paper: the same tasks for more and more robots."""

from collections.abc import Sequence

from clearway.study import assigned, statistics
from clearway.study.assigned import completeness, means, pick
from clearway.study.experiment import Cell, Row, Scale, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.methods import APSGA, NTA, OURS
from clearway.study.statistics import Estimate

TASKS = (8, 16)
ROBOTS, QUICK_ROBOTS = (2, 4, 6, 8, 12, 16), (2, 4, 8, 16)
METHODS = (NTA, APSGA, OURS)
MEASURES = {
    "total_cost": "total cost (m)",
    "average_distance": "average distance (m)",
    "makespan": "last arrival (s)",
}


def cells(scale: Scale) -> Sequence[Cell]:
    """Return 30 instances for each fleet and method; three in the quick version.

    Where the tasks do not divide by the robots, some robots have one less; with fewer tasks
    than robots some stay where they are.
    """
    robots = QUICK_ROBOTS if scale.quick else ROBOTS
    fleets = [(number, tasks) for tasks in TASKS for number in robots]
    return assigned.cells(fleets, METHODS, scale, scale.seeds(30, 3))


def summarise(rows: Sequence[Row]) -> Summary:
    """Return cost, distance and makespan over the number of robots."""
    return Summary((_table(rows),), (_chart(rows),), _findings(rows))


def _table(rows: Sequence[Row]) -> Table:
    lines = []
    for tasks in TASKS:
        for robots in sorted({row["robots"] for row in rows}):
            for method in METHODS:
                found = pick(rows, tasks=tasks, robots=robots, method=method)
                if found:
                    told = (statistics.mean([row[name] for row in found]) for name in MEASURES)
                    lines.append((str(tasks), str(robots), method, *map(str, told)))
    return Table(
        "Tasks shared by more and more robots",
        ("tasks", "robots", "method", *MEASURES.values()),
        tuple(lines),
        f"Means over instances. {completeness(rows)}",
    )


def _chart(rows: Sequence[Row]) -> Chart:
    ticks = tuple((float(n), str(n)) for n in sorted({row["robots"] for row in rows}))
    panels = tuple(
        Panel(
            "robots",
            words,
            tuple(
                Series.of(
                    method,
                    means(pick(rows, tasks=tasks, method=method), name, "robots"),
                    colour=colour,
                )
                for colour, method in enumerate(METHODS)
            ),
            f"{tasks} tasks",
            ticks,
            from_zero=True,
        )
        for tasks in TASKS
        for name, words in MEASURES.items()
    )
    note = "Means over instances; bars are 95 % intervals."
    return Chart("robots", "The same tasks for more and more robots", panels, note, columns=3)


def _findings(rows: Sequence[Row]) -> tuple[Finding, ...]:
    fewer = _change(rows, 8, 2, 4)
    same = _change(rows, 16, 4, 8)
    return (
        Finding(
            "Paper, Sec. 4.4: more robots reduce the total cost of few tasks (8 tasks, 4 robots "
            "against 2, APSGA)",
            _told(fewer),
            None if fewer is None or not fewer.excludes_zero else fewer.high < 0.0,
        ),
        Finding(
            "Paper, Sec. 4.4: 8 robots with 16 tasks cost about what 4 do, by congestion (APSGA)",
            _told(same),
            None if same is None else same.low <= 0.0 <= same.high,
        ),
        *(_turning_point(rows, tasks) for tasks in TASKS),
    )


def _change(rows: Sequence[Row], tasks: int, few: int, many: int) -> Estimate | None:
    """Return by how many per cent APSGA's cost grows from few robots to many, same tasks."""
    costs = [
        {row["seed"]: row["total_cost"] for row in pick(rows, tasks=tasks, robots=n, method=APSGA)}
        for n in (few, many)
    ]
    both = [
        100.0 * (costs[1][seed] / costs[0][seed] - 1.0) for seed in costs[0] if seed in costs[1]
    ]
    return statistics.mean(both) if len(both) > 1 else None


def _told(change: Estimate | None) -> str:
    if change is None:
        return "fewer than two pairs of complete plans"
    return f"the cost changes by {change} % over {change.count} pairs"


def _turning_point(rows: Sequence[Row], tasks: int) -> Finding:
    """Tell at how many robots the mean cost is least, and whether more of them cost more."""
    claim = f"Paper, Sec. 4.4: robots beyond some number do not help ({tasks} tasks, our default)"
    costs = means(pick(rows, tasks=tasks, method=OURS), "total_cost", "robots")
    if len(costs) < 2:
        return Finding(claim, "too few complete plans", None)
    best, most = min(costs, key=lambda each: each[1].value), costs[-1]
    told = f"least with {best[0]:.0f} robots ({best[1]} m); with {most[0]:.0f}: {most[1]} m"
    return Finding(claim, told, best[0] < most[0])


STUDY = Study(
    name="hierarchical-fig8",
    title="The same tasks, more and more robots: Fig. 8 of system A's paper",
    version=1,
    setting=(
        "8 and 16 tasks for 2 to 16 robots, the tasks of an instance being the same for all "
        "fleets; each assigner has 20 trials (3 in the quick version) on each instance, one of "
        "which, drawn at random, is planned.",
        *assigned.SITE,
    ),
    parts=assigned.PARTS,
    cells=cells,
    row=assigned.row,
    summarise=summarise,
)
