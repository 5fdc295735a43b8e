"""Fig. 7 of system A's paper: the same four robots with more and more tasks."""

from collections.abc import Sequence

from clearway.study import assigned, statistics
from clearway.study.assigned import completeness, means, pairs, pick
from clearway.study.experiment import Cell, Row, Scale, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.methods import APSGA, ASSIGNERS, NTA, OURS
from clearway.study.savings import saving_finding
from clearway.study.statistics import Estimate, saving

ROBOTS = 4
TASKS = (4, 8, 12, 16)
# By how many per cent the total cost with APSGA is said to be below that without assignment.
CLAIMED = {4: 36.3, 16: 47.1}


def cells(scale: Scale) -> Sequence[Cell]:
    """Return 30 instances for each number of tasks and method; three in the quick version."""
    fleets = [(ROBOTS, tasks) for tasks in TASKS]
    return assigned.cells(fleets, ASSIGNERS, scale, scale.seeds(30, 3))


def summarise(rows: Sequence[Row]) -> Summary:
    """Return cost and distance over the number of tasks, and what assignment saves."""
    return Summary((_table(rows),), (_chart(rows), _saving_chart(rows)), _findings(rows))


def _both(rows: Sequence[Row], tasks: int, method: str) -> tuple[list[float], list[float]]:
    """Return total costs of a method and of no assignment on the same instances."""
    return pairs(
        pick(rows, tasks=tasks, method=method), pick(rows, tasks=tasks, method=NTA), "total_cost"
    )


def _savings(rows: Sequence[Row], method: str) -> list[tuple[float, Estimate]]:
    both = [(tasks, *_both(rows, tasks, method)) for tasks in TASKS]
    return [(float(tasks), saving(ours, theirs)) for tasks, ours, theirs in both if ours]


def _table(rows: Sequence[Row]) -> Table:
    lines = []
    for tasks in TASKS:
        for method in ASSIGNERS:
            found = pick(rows, tasks=tasks, method=method)
            if found:
                saved = "-" if method == NTA else f"{saving(*_both(rows, tasks, method))} %"
                printed = CLAIMED.get(tasks) if method == APSGA else None
                lines.append(
                    (
                        str(tasks),
                        method,
                        str(statistics.mean([row["average_distance"] for row in found])),
                        str(statistics.mean([row["total_cost"] for row in found])),
                        saved,
                        "-" if printed is None else f"{printed} %",
                    )
                )
    return Table(
        "Four robots",
        ("tasks", "method", "average distance (m)", "total cost (m)", "saved over NTA", "paper"),
        tuple(lines),
        f"Means over instances. {completeness(rows)}",
    )


def _chart(rows: Sequence[Row]) -> Chart:
    ticks = tuple((float(tasks), str(tasks)) for tasks in TASKS)
    panels = tuple(
        Panel(
            "tasks",
            f"{name.replace('_', ' ')} (m)",
            tuple(
                Series.of(method, means(pick(rows, method=method), name, "tasks"), colour=colour)
                for colour, method in enumerate(ASSIGNERS)
            ),
            ticks=ticks,
            from_zero=True,
        )
        for name in ("average_distance", "total_cost")
    )
    note = "Means over instances; bars are 95 % intervals."
    return Chart("tasks", "Four robots with more and more tasks", panels, note, columns=2)


def _saving_chart(rows: Sequence[Row]) -> Chart:
    series = (
        Series.of("APSGA here", _savings(rows, APSGA)),
        Series.of("our default here", _savings(rows, OURS), colour=1),
        Series(
            "APSGA in the paper",
            tuple(float(tasks) for tasks in CLAIMED),
            tuple(CLAIMED.values()),
            style="paper",
        ),
    )
    ticks = tuple((float(tasks), str(tasks)) for tasks in TASKS)
    panel = Panel("tasks", "total cost saved (%)", series, ticks=ticks)
    return Chart("saving", "What assignment saves over none (NTA)", (panel,))


def _findings(rows: Sequence[Row]) -> tuple[Finding, ...]:
    found = [
        saving_finding(
            f"Paper, Sec. 4.4: with {tasks} tasks APSGA's total cost is {claimed} % below NTA's",
            claimed,
            *_both(rows, tasks, APSGA),
        )
        for tasks, claimed in CLAIMED.items()
    ]
    few, many = (
        [100.0 * (1.0 - a / b) for a, b in zip(*_both(rows, tasks, APSGA), strict=True)]
        for tasks in (min(TASKS), max(TASKS))
    )
    claim = "Paper, Sec. 4.4: APSGA saves more when tasks are more"
    if min(len(few), len(many)) < 2:
        return (*found, Finding(claim, "fewer than two pairs of complete plans", None))
    grown = statistics.unpaired(many, few)
    told = f"{grown} percentage points more with {max(TASKS)} tasks than with {min(TASKS)}"
    return (*found, Finding(claim, told, grown.low > 0.0 if grown.excludes_zero else None))


STUDY = Study(
    name="hierarchical-fig7",
    title="Four robots, more and more tasks: Fig. 7 of system A's paper",
    version=1,
    setting=(
        "4 robots with 4, 8, 12 and 16 tasks; each assigner has 20 trials (3 in the quick "
        "version) on each instance, one of which, drawn at random, is planned.",
        *assigned.SITE,
    ),
    parts=assigned.PARTS,
    cells=cells,
    row=assigned.row,
    summarise=summarise,
)
