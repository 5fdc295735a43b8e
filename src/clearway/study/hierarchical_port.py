"""The port of system A's paper: how near robots come, and who slows for whom."""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from clearway.formats.ready_made import scenario_folder
from clearway.formats.scenario_file import read_scenario
from clearway.metrics.motion import step_lengths, track_of
from clearway.model import PlanRecord, Robot
from clearway.protocols import Budget
from clearway.study.alignment import alignments
from clearway.study.experiment import Cell, Row, Scale, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Span, Summary, Table
from clearway.study.statistics import figure
from clearway.study.yielding import lone_records, yieldings
from clearway.systems import choose_system, make_plan
from clearway.validate import gaps_over_time, separations, validate_plan

SCENARIO = "port"
# Seconds between the moments that are drawn.
STEP = 0.25
# The paper's "least separations" (m): along one axis where the other coordinate coincides.
PAPER = (45.84, 10.69, 57.90, 13.23)


def cells(scale: Scale) -> Sequence[Cell]:
    """Return one plan of the port, or as many seeds as are asked for."""
    budget = {"seconds": scale.budget.seconds, "expansions": scale.budget.expansions}
    return [Cell({"scenario": SCENARIO, **budget}, seed) for seed in scale.seeds(1, 1)]


def row(cell: Cell) -> Row:
    """Plan a scenario that comes with Clearway; tell gaps, speeds and yielding over time."""
    scenario = read_scenario(scenario_folder() / f"{cell.settings['scenario']}.toml")
    system = choose_system(scenario)
    planned = make_plan(
        scenario,
        system=system,
        seed=cell.seed,
        budget=Budget(cell.settings["seconds"], cell.settings["expansions"]),
        clock=time.process_time,
    )
    record = planned.record
    violations = validate_plan(record)
    alone = lone_records(record, system.plan, cell.seed)
    return {
        "status": record.status.value,
        "reason": record.reason,
        "violations": len(violations),
        "kinds": ", ".join(sorted({each.kind for each in violations})),
        "makespan": record.makespan,
        "sum_of_costs": record.sum_of_costs,
        "lone_sum_of_costs": sum(
            float(track_of(each, each.robots[0]).t[-1]) for each in alone.values()
        ),
        "plan_cpu_s": record.timings["plan_s"],
        **told_over_time(record),
        "yielding": [each._asdict() for each in yieldings(record, alone)],
    }


def told_over_time(record: PlanRecord) -> dict[str, Any]:
    """Return gaps, speeds and alignments of any plan, plain JSON; m, s and m/s."""
    times = np.arange(0.0, record.makespan + STEP, STEP)
    return {
        "times": times.round(3).tolist(),
        "gaps": {
            f"{a} and {b}": values.round(3).tolist()
            for (a, b), values in gaps_over_time(record, times).items()
        },
        "least": [
            {"pair": f"{a} and {b}", "metres": round(gap, 3), "time": round(when, 2)}
            for a, b, gap, when in separations(record)
        ],
        "speeds": {
            robot.id: _speeds(record, robot, times).round(3).tolist() for robot in record.robots
        },
        "alignments": [
            {
                "pair": f"{each.first} and {each.second}",
                "time": round(each.time, 2),
                "along": each.along,
                "metres": round(each.distance, 2),
            }
            for each in alignments(record)
        ],
    }


def _speeds(
    record: PlanRecord, robot: Robot, times: "np.ndarray[Any, Any]"
) -> "np.ndarray[Any, Any]":
    """Return how fast the reference point drives at each moment."""
    track = track_of(record, robot)
    lasts = np.diff(track.t) > 0.0
    if not lasts.any():
        return np.zeros(len(times))
    ends = track.t[1:][lasts]
    speeds = step_lengths(track)[lasts] / np.diff(track.t)[lasts]
    step = np.searchsorted(ends, times, side="right")
    return np.append(speeds, 0.0)[step]


def summarise(rows: Sequence[Row]) -> Summary:
    """Return tables, charts and findings of the first plan; the others repeat it by seed."""
    if not rows:
        return Summary((), (), ())
    first = rows[0]
    tables = (_least_table(first), _yielding_table(first), _plans_table(rows))
    charts = (_gap_chart(first), _alignment_chart(first), _speed_chart(first))
    return Summary(tables, charts, _findings(rows))


def _least_table(row: Row) -> Table:
    lines = []
    for each in sorted(row["least"], key=lambda found: found["metres"]):
        met = [found for found in row["alignments"] if found["pair"] == each["pair"]]
        line = [each["pair"], f"{each['metres']:.2f} at {each['time']:.1f} s"]
        for along in ("x", "y"):
            some = [found for found in met if found["along"] == along]
            nearest = min(some, key=lambda found: found["metres"], default=None)
            line.append(
                f"{nearest['metres']:.2f} at {nearest['time']:.1f} s" if nearest else "never"
            )
        lines.append(tuple(line))
    return Table(
        "Least distances (m)",
        ("pair", "between the bodies", "along x where y coincides", "along y where x coincides"),
        tuple(lines),
        "Between the bodies: of the true shapes, at any time. Along an axis: of the reference "
        f"points; the paper's {', '.join(f'{each:.2f}' for each in PAPER)} m are such distances, "
        "not gaps between bodies.",
    )


def _yielding_table(row: Row) -> Table:
    lines = tuple(
        (
            each["robot"],
            f"{each['begin']:.1f} to {each['end']:.1f}",
            each["kind"],
            f"{each['lost']:.1f}",
            f"({each['place'][0]:.1f}, {each['place'][1]:.1f})",
            "nobody it would meet soon" if each["partner"] is None else str(each["partner"]),
            "-" if each["meeting"] is None else f"{each['meeting']:.1f}",
        )
        for each in row["yielding"]
    )
    return Table(
        "Who slowed for whom",
        ("robot", "from, to (s)", "how", "time lost (s)", "where", "for", "would have met at (s)"),
        lines,
        "Beside each robot's plan by the same planner with nobody else on the site. The partner "
        "is the one that it would have met first, within half a minute, going on as if it were "
        "alone; without one it drives another way than alone.",
    )


def _plans_table(rows: Sequence[Row]) -> Table:
    return Table(
        "Plans",
        ("seed", "status", "violations", "last arrival (s)", "sum of arrivals (s)", "alone (s)"),
        tuple(
            (
                str(row["seed"]),
                row["status"],
                f"{row['violations']} {row['kinds']}".strip(),
                figure(row["makespan"]),
                figure(row["sum_of_costs"]),
                figure(row["lone_sum_of_costs"]),
            )
            for row in rows
        ),
        "Charts and other tables are of the first one.",
    )


def _gap_chart(row: Row) -> Chart:
    times = tuple(row["times"])
    series = tuple(
        Series(pair, times, tuple(gaps), colour=colour)
        for colour, (pair, gaps) in enumerate(row["gaps"].items())
    )
    panel = Panel("time (s)", "gap between the bodies (m)", series, from_zero=True)
    return Chart(
        "separation",
        "True separation over time",
        (panel,),
        "Between the true shapes of the bodies, every quarter of a second.",
    )


def _alignment_chart(row: Row) -> Chart:
    panels = []
    for along, other in (("x", "y"), ("y", "x")):
        series = []
        for colour, pair in enumerate(row["gaps"]):
            met = [
                each for each in row["alignments"] if (each["pair"], each["along"]) == (pair, along)
            ]
            series.append(
                Series(
                    pair,
                    tuple(each["time"] for each in met),
                    tuple(each["metres"] for each in met),
                    style="points",
                    colour=colour,
                )
            )
        label = f"distance along {along} (m)"
        panels.append(
            Panel("time (s)", label, tuple(series), f"Where {other} coincides", from_zero=True)
        )
    return Chart(
        "alignment",
        "Distance along one axis where the other coordinate coincides",
        tuple(panels),
        "This is what the paper calls least separation; it says little of how near bodies come.",
        columns=2,
    )


def _speed_chart(row: Row) -> Chart:
    times = tuple(row["times"])
    panels = tuple(
        Panel(
            "time (s)",
            "speed (m/s)",
            (Series(robot, times, tuple(speeds), colour=colour),),
            robot,
            spans=tuple(
                Span(each["begin"], each["end"], _yields(each))
                for each in row["yielding"]
                if each["robot"] == robot
            ),
            from_zero=True,
        )
        for colour, (robot, speeds) in enumerate(row["speeds"].items())
    )
    return Chart(
        "speed",
        "Speeds over time",
        panels,
        "Shaded: slower than the robot would be alone, with the robot that it would have met.",
        columns=1 if len(panels) <= 3 else 2,
    )


def _least_speeds(row: Row, some: Sequence[dict[str, Any]]) -> list[str]:
    """Return each robot's least speed while it yields to somebody."""
    least: dict[str, float] = {}
    for each in some:
        speeds = [
            speed
            for time, speed in zip(row["times"], row["speeds"][each["robot"]], strict=True)
            if each["begin"] <= time <= each["end"]
        ]
        least[each["robot"]] = min([least.get(each["robot"], np.inf), *speeds])
    return [f"{robot} {speed:.1f} m/s" for robot, speed in sorted(least.items())]


def _yields(each: dict[str, Any]) -> str:
    return f"{each['kind']} for {each['partner']}" if each["partner"] else str(each["kind"])


def _findings(rows: Sequence[Row]) -> tuple[Finding, ...]:
    first = rows[0]
    complete = sum(row["status"] == "solved" for row in rows)
    clean = sum(not row["violations"] for row in rows)
    least = min((each["metres"] for each in first["least"]), default=None)
    told = "fewer than two robots" if least is None else f"the bodies come to {least:.2f} m"
    partners = [each for each in first["yielding"] if each["partner"] is not None]
    slowed = sorted({each["robot"] for each in partners})
    return (
        Finding(
            "Paper, Sec. 5: all robots do their work without conflict or deadlock",
            f"{complete} of {len(rows)} plans complete, {clean} judged free of violations "
            "(accelerations included)",
            complete == clean == len(rows),
        ),
        Finding(
            "Paper, Sec. 5: separation is kept throughout",
            told,
            None if least is None else least > 0.0,
        ),
        Finding(
            "Paper, Sec. 5: two robots slow down at a narrow junction (there to 0.8 m/s)",
            f"{len(partners)} times for a robot that can be named ({', '.join(slowed) or '-'}); "
            f"least speeds then: {', '.join(_least_speeds(first, partners)) or 'none'}",
            len(slowed) >= 2,
        ),
    )


STUDY = Study(
    name="hierarchical-port",
    title="Three robots in a port: Sec. 5 of system A's paper",
    version=1,
    setting=(
        "The scenario `port` that comes with Clearway, drawn by us since the paper gives no "
        "geometry: three robots of 6 m x 3 m carry cars between two yards with one narrow "
        "junction, with limits on acceleration.",
        "Distances between bodies are of their true shapes, measured by the judge.",
    ),
    parts={"scenario": "scenarios/port.toml as it comes with Clearway"},
    cells=cells,
    row=row,
    summarise=summarise,
)
