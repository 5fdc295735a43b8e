"""Table 2 of system A's paper: six ways to assign, planned and compared."""

from collections.abc import Sequence

from clearway.study import assigned, statistics
from clearway.study.assigned import completeness, pairs, pick
from clearway.study.experiment import Cell, Row, Scale, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.methods import APSGA, ASSIGNERS, OURS
from clearway.study.savings import saving_finding
from clearway.study.statistics import mean

FLEETS = ((4, 12), (4, 16), (8, 16))

# Table 2 by robots, tasks and method: average and best fitness, farthest, average and total
# distance (m), total cost (m).
MEASURES = (
    "average_fitness",
    "best_fitness",
    "farthest",
    "average_distance",
    "total_distance",
    "total_cost",
)
PAPER: dict[tuple[int, int, str], tuple[float | None, ...]] = {
    (4, 12, "NTA"): (None, None, 189.63, 164.77, 659.08, 1526.28),
    (4, 12, "PSO"): (587.25, 549.56, 124.92, 119.24, 476.98, 801.03),
    (4, 12, "GA"): (620.10, 556.56, 122.61, 118.58, 474.32, 789.90),
    (4, 12, "PSGA"): (560.47, 546.56, 134.93, 120.21, 480.85, 749.83),
    (4, 12, "APSGA"): (557.14, 546.56, 132.24, 112.21, 448.82, 713.57),
    (4, 16, "NTA"): (None, None, 262.97, 220.14, 880.55, 1767.01),
    (4, 16, "PSO"): (833.02, 784.84, 184.40, 157.61, 630.45, 1249.32),
    (4, 16, "GA"): (858.72, 820.56, 196.06, 185.92, 743.66, 1409.43),
    (4, 16, "PSGA"): (752.03, 699.57, 164.35, 158.02, 632.10, 1267.73),
    (4, 16, "APSGA"): (746.10, 699.57, 170.41, 144.69, 578.76, 934.59),
    (8, 16, "NTA"): (None, None, 148.92, 99.33, 794.64, 1642.44),
    (8, 16, "PSO"): (728.20, 629.85, 96.76, 76.65, 613.20, 1200.89),
    (8, 16, "GA"): (745.98, 659.85, 100.52, 77.34, 618.72, 1287.89),
    (8, 16, "PSGA"): (642.60, 599.85, 88.10, 70.87, 566.96, 960.95),
    (8, 16, "APSGA"): (632.63, 599.85, 78.40, 67.40, 539.20, 941.61),
}
# By how many per cent APSGA's is said to be lower: total cost, average fitness.
CLAIMED_COST = {"NTA": 47.7, "PSO": 19.2, "GA": 23.4, "PSGA": 11.0}
CLAIMED_FITNESS = {"PSO": 9.6, "GA": 12.8, "PSGA": 1.0}


def cells(scale: Scale) -> Sequence[Cell]:
    """Return 30 instances of each scenario for each method; three in the quick version."""
    return assigned.cells(FLEETS, ASSIGNERS, scale, scale.seeds(30, 3))


def summarise(rows: Sequence[Row]) -> Summary:
    """Return Table 2 with ours beside the paper's, savings and paired differences."""
    tables = (
        _measures(rows, "Cost and distances (m)", MEASURES[:1:-1]),
        _measures(rows, "Fitness over the trials", MEASURES[:2]),
        _savings(rows),
        _differences(rows),
    )
    return Summary(tables, (_cost_chart(rows), _saving_chart(rows)), _findings(rows))


def _measures(rows: Sequence[Row], title: str, names: Sequence[str]) -> Table:
    heads = ["robots-tasks", "method"]
    for name in names:
        heads += [name.replace("_", " "), "paper"]
    lines = []
    for robots, tasks in FLEETS:
        for method in ASSIGNERS:
            found = pick(rows, robots=robots, tasks=tasks, method=method)
            line = [f"{robots}-{tasks}", method]
            printed = PAPER.get((robots, tasks, method), (None,) * len(MEASURES))
            for name in names:
                theirs = printed[MEASURES.index(name)]
                line.append(str(mean([row[name] for row in found])) if found else "-")
                line.append("-" if theirs is None else f"{theirs:,.2f}")
            lines.append(tuple(line))
    note = f"Means over instances. {completeness(rows)}" if title.startswith("Cost") else ""
    return Table(title, tuple(heads), tuple(lines), note)


def _savings(rows: Sequence[Row]) -> Table:
    lines = []
    for other, claimed in CLAIMED_COST.items():
        line = [other, f"{claimed} %"]
        for method in (APSGA, OURS):
            ours, theirs = pairs(pick(rows, method=method), pick(rows, method=other), "total_cost")
            line.append(f"{statistics.saving(ours, theirs)} %" if ours else "-")
        lines.append(tuple(line))
    return Table(
        "Total cost saved, over all three scenarios",
        ("against", "the paper's APSGA", "APSGA here", "our default here"),
        tuple(lines),
        "Mean over instances of 1 - cost / cost of the other method on the same instance.",
    )


def _differences(rows: Sequence[Row]) -> Table:
    lines = []
    for robots, tasks in FLEETS:
        for other in ASSIGNERS:
            ours, theirs = _both(rows, robots, tasks, other)
            if other != OURS and ours:
                lines.append(
                    (
                        f"{robots}-{tasks}",
                        other,
                        str(statistics.difference(ours, theirs)),
                        f"{statistics.saving(ours, theirs)} %",
                        str(len(ours)),
                    )
                )
    return Table(
        "Our default against each: paired differences of total cost",
        ("robots-tasks", "against", "difference (m)", "saved", "pairs"),
        tuple(lines),
        "Below 0: ours costs less on the same instances.",
    )


def _both(
    rows: Sequence[Row], robots: int, tasks: int, other: str
) -> tuple[list[float], list[float]]:
    fleet = {"robots": robots, "tasks": tasks}
    return pairs(pick(rows, method=OURS, **fleet), pick(rows, method=other, **fleet), "total_cost")


def _cost_chart(rows: Sequence[Row]) -> Chart:
    panels = []
    ticks = tuple((float(i), method) for i, method in enumerate(ASSIGNERS))
    for robots, tasks in FLEETS:
        found = [pick(rows, robots=robots, tasks=tasks, method=method) for method in ASSIGNERS]
        costs = [
            (float(i), mean([row["total_cost"] for row in some]))
            for i, some in enumerate(found)
            if some
        ]
        printed = [
            (float(i), PAPER[robots, tasks, method][-1])
            for i, method in enumerate(ASSIGNERS)
            if (robots, tasks, method) in PAPER
        ]
        series = (
            Series.of("ours, mean and 95 % interval", costs, "points"),
            Series(
                "paper, one run",
                tuple(x for x, _ in printed),
                tuple(y for _, y in printed if y is not None),
                style="paper",
            ),
        )
        panels.append(
            Panel(
                "method",
                "total cost (m)",
                series,
                f"{robots} robots, {tasks} tasks",
                ticks,
                from_zero=True,
            )
        )
    note = "The paper's instances are others than ours: compare the order of the methods."
    return Chart("total_cost", "Total cost of plans by assigner", tuple(panels), note, columns=3)


def _saving_chart(rows: Sequence[Row]) -> Chart:
    series = []
    for colour, (method, name) in enumerate(((APSGA, "APSGA here"), (OURS, "our default here"))):
        points = []
        for i, other in enumerate(CLAIMED_COST):
            ours, theirs = pairs(pick(rows, method=method), pick(rows, method=other), "total_cost")
            if ours:
                points.append((float(i), statistics.saving(ours, theirs)))
        series.append(Series.of(name, points, "points", colour))
    claimed = tuple(CLAIMED_COST.values())
    places = tuple(float(i) for i in range(len(claimed)))
    series.append(Series("claimed by the paper", places, claimed, style="paper"))
    ticks = tuple(zip(places, CLAIMED_COST, strict=True))
    panel = Panel("against", "total cost saved (%)", tuple(series), ticks=ticks)
    return Chart("savings", "Total cost saved by the better assignment", (panel,))


def _findings(rows: Sequence[Row]) -> tuple[Finding, ...]:
    found = []
    for name, claims in (("total_cost", CLAIMED_COST), ("average_fitness", CLAIMED_FITNESS)):
        for other, claimed in claims.items():
            values = pairs(pick(rows, method=APSGA), pick(rows, method=other), name)
            claim = (
                f"Paper, Sec. 4.3: APSGA's {name.replace('_', ' ')} is {claimed} % below {other}'s"
            )
            found.append(saving_finding(claim, claimed, *values))
    for robots, tasks in FLEETS:
        ours, theirs = _both(rows, robots, tasks, APSGA)
        if len(ours) > 1:
            gain = statistics.difference(ours, theirs)
            told, holds = f"{gain} m over {gain.count} pairs", gain.high < 0.0
        else:
            told, holds = "fewer than two pairs of complete plans", None
        claim = (
            f"Aim: our default's total cost is below APSGA's, interval and all, {robots}-{tasks}"
        )
        found.append(Finding(claim, told, holds))
    return tuple(found)


STUDY = Study(
    name="hierarchical-table2",
    title="Who does what: Table 2 of system A's paper",
    version=1,
    setting=(
        "Scenarios of 4 robots and 12 tasks, 4 and 16, 8 and 16; each assigner has 20 trials "
        "(3 in the quick version) on each instance, one of which, drawn at random, is planned.",
        *assigned.SITE,
    ),
    parts=assigned.PARTS,
    cells=cells,
    row=assigned.row,
    summarise=summarise,
)
