"""Public and generated instances with one goal per robot: planned, judged, tabled beside peers."""

import ctypes
import gc
import json
import resource
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

from clearway.formats.atomic import FormatError, write_text
from clearway.formats.kinodynamic import read_instance
from clearway.formats.plan_file import write_plan
from clearway.formats.scenario_file import read_scenario
from clearway.model import Scenario
from clearway.model.site import Border
from clearway.protocols import Budget
from clearway.study.bench import BenchTable
from clearway.study.workers import processes
from clearway.systems.solve import IllegalScenario, Planned, make_plan
from clearway.validate import Violation, validate_plan

Row = dict[str, Any]

# CL-CBS, measured once on two busy cores with 60 s of CPU: instances solved, clean ones among
# them, median user seconds, median sum of arrivals (s). Keys: side of the map (m), robots.
CL_CBS = {
    (50, 5): ("6/6", 3, 0.04, 146),
    (50, 10): ("5/6", 1, 0.28, 258),
    (50, 15): ("5/5", 1, 4.2, 453),
    (50, 20): ("3/5", 0, 3.5, 599),
    (100, 20): ("3/4", 2, 2.4, 989),
    (100, 30): ("4/4", 0, 1.7, 1533),
    (100, 40): ("2/4", 1, 6.7, 2024),
    (100, 50): ("2/4", 0, 3.4, 2446),
    (300, 50): ("2/3", 0, 10.3, 6434),
    (300, 100): ("2/3", 0, 36.5, 12643),
}


@dataclass(frozen=True)
class Instance:
    """A scenario with the set that its row belongs to."""

    scenario: Scenario
    set_name: str
    is_public: bool


def read_any(path: Path, border: Border) -> Instance:
    """Return a CL-CBS instance (``.yaml``), or a scenario file as ``clearway generate`` writes it.

    Raises
    ------
    FormatError
        If the file is neither; names file, place and mend.
    """
    if path.suffix in (".yaml", ".yml"):
        scenario = read_instance(path, border)
        return Instance(scenario, f"CL-CBS {_extent(scenario)}, {len(scenario.robots)}", True)
    if path.suffix != ".toml":
        raise FormatError(
            "neither a CL-CBS instance nor a scenario",
            file=path,
            mend="give .yaml files of the CL-CBS format or .toml scenarios",
        )
    scenario = read_scenario(path)
    return Instance(scenario, scenario.name.rpartition("-seed")[0] or scenario.name, False)


def bench_kinodynamic(
    files: Sequence[Path],
    out: Path,
    *,
    border: Border,
    budget: Budget,
    seed: int,
    jobs: int,
    tell: Callable[[str], None] = lambda text: None,
) -> BenchTable:
    """Plan each instance; write ``rows.jsonl``, ``table.md`` and ``plans/`` into ``out``.

    All files are read before the first one is planned. Rows come in the order of the files,
    with the same content but for seconds and memory on any number of processes.

    Raises
    ------
    FormatError
        If a file cannot be read, or two have the same stem.
    """
    seen: dict[str, Path] = {}
    for path in files:
        if path.stem in seen:
            raise FormatError(
                f"named like {seen[path.stem]}", file=path, mend="rows need stems of their own"
            )
        seen[path.stem] = path
        read_any(path, border)
    (out / "plans").mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    work = partial(bench_one, out=out, border=border, budget=budget, seed=seed)
    interrupted = False
    try:
        for row in _rows(work, files, jobs):
            if row["status"] == "interrupted":
                interrupted = True
                break
            rows.append(row)
            tell(f"{row['instance']}: {row['status']} ({len(rows)} of {len(files)})")
            write_text(out / "rows.jsonl", "".join(json.dumps(r) + "\n" for r in rows))
    except KeyboardInterrupt:
        interrupted = True
    sets = summarise(rows)
    markdown = table(sets)
    write_text(out / "table.md", markdown + "\n")
    return BenchTable(tuple(rows), {"sets": sets}, markdown, interrupted)


def bench_one(path: Path, *, out: Path, border: Border, budget: Budget, seed: int) -> Row:
    """Plan and judge one instance; write its plan and return its row."""
    instance = read_any(path, border)
    scenario = instance.scenario
    row: Row = {
        "instance": path.stem,
        "set": instance.set_name,
        "side": _side(scenario) if instance.is_public else None,
        "robots": len(scenario.robots),
        "seed": seed,
    }
    _reset_peak()
    wall = time.monotonic()
    try:
        planned = make_plan(scenario, seed=seed, budget=budget, clock=_user_seconds)
    except IllegalScenario as illegal:
        walled_in = all(finding.kind == "unreachable" for finding in illegal.findings)
        status = "infeasible" if walled_in else "illegal"
        robots = sorted({robot for f in illegal.findings for robot in f.robots})
        return row | {"status": status, "reason": str(illegal), "concerned": robots}
    if planned.interrupted:
        return row | {"status": "interrupted"}
    row |= {"wall_s": round(time.monotonic() - wall, 3), "memory_mb": _peak_mb()}
    write_plan(planned.record, out / "plans" / f"{path.stem}.json")
    return row | _figures(planned, validate_plan(planned.record))


def _figures(planned: Planned, violations: Sequence[Violation]) -> Row:
    record, counters = planned.record, planned.plan.counters
    return {
        "status": record.status.value,
        "reason": record.reason,
        "concerned": list(planned.plan.concerned),
        "clean": not violations,
        "violations": [str(violation) for violation in violations[:5]],
        "cpu_s": record.timings["plan_s"],
        "first_cpu_s": record.timings.get("first_plan_s"),
        "sum_of_costs": record.sum_of_costs,
        "first_sum_of_costs": counters["first_sum_of_costs_ms"] / 1000.0,
        "makespan": record.makespan,
        "expansions": counters["expansions"],
        "lower_bound": record.lower_bound,
    }


def _rows(work: Callable[[Path], Row], files: Sequence[Path], jobs: int) -> Iterator[Row]:
    if jobs == 1 or len(files) == 1:
        yield from map(work, files)
        return
    with processes(jobs) as pool:
        yield from pool.map(work, files)


def _user_seconds() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def _reset_peak() -> None:
    """Give back what earlier rows left and forget their peak, where the system can (Linux)."""
    gc.collect()
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")


def _peak_mb() -> float:
    """Return the peak of resident memory of this process (MB)."""
    with suppress(OSError):
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return round(int(line.split()[1]) / 1024.0, 1)
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0, 1)


def _side(scenario: Scenario) -> int:
    return round(max(x for x, _ in scenario.site.bounds))


def _extent(scenario: Scenario) -> str:
    return "x".join(f"{max(values):g}" for values in zip(*scenario.site.bounds, strict=True))


def summarise(rows: Sequence[Row]) -> list[Row]:
    """Return a summary of each set, in the order of first appearance."""
    return [
        _summary(name, [row for row in rows if row["set"] == name])
        for name in dict.fromkeys(row["set"] for row in rows)
    ]


def _summary(name: str, rows: Sequence[Row]) -> Row:
    legal = [row for row in rows if row["status"] not in ("illegal", "infeasible")]
    solved = [row for row in legal if row["status"] == "solved"]

    def middle(key: str) -> float | None:
        values = [row[key] for row in solved if row[key] is not None]
        return median(values) if values else None

    def most(key: str) -> float | None:
        return max((row[key] for row in legal if row[key] is not None), default=None)

    gaps = [row["sum_of_costs"] / row["lower_bound"] - 1.0 for row in solved if row["lower_bound"]]
    seconds = sum(row["cpu_s"] for row in legal)
    return {
        "set": name,
        "side": rows[0]["side"],
        "robots": rows[0]["robots"],
        "instances": len(rows),
        "illegal": sum(row["status"] == "illegal" for row in rows),
        "infeasible": sum(row["status"] == "infeasible" for row in rows),
        "legal": len(legal),
        "solved": len(solved),
        "clean": sum(row["clean"] for row in legal),
        "first_cpu_s_median": middle("first_cpu_s"),
        "first_cpu_s_max": most("first_cpu_s"),
        "cpu_s_median": middle("cpu_s"),
        "cpu_s_max": most("cpu_s"),
        "first_sum_of_costs_median": middle("first_sum_of_costs"),
        "sum_of_costs_median": middle("sum_of_costs"),
        "makespan_median": middle("makespan"),
        "gap_median": median(gaps) if gaps else None,
        "expansions_per_s": sum(row["expansions"] for row in legal) / seconds if seconds else None,
        "memory_mb_max": most("memory_mb"),
    }


def table(sets: Sequence[Row]) -> str:
    """Return the summaries as a Markdown table, with CL-CBS beside where it was measured."""
    heads = (
        "set",
        "legal of all",
        "solved, clean",
        "first plan: CPU s, median / max",
        "sum of costs",
        "all effort: CPU s",
        "sum of costs",
        "gap to the bound",
        "makespan s",
        "expansions/s",
        "peak MB",
        "CL-CBS: solved, clean, CPU s, sum of costs",
        "first sum / CL-CBS",
    )
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for each in sets:
        peer = CL_CBS.get((each["side"], each["robots"])) if each["side"] else None
        first = each["first_sum_of_costs_median"]
        cells = (
            each["set"],
            f"{each['legal']} of {each['instances']}",
            f"{each['solved']}, {each['clean']}",
            f"{_told(each['first_cpu_s_median'], 3)} / {_told(each['first_cpu_s_max'], 3)}",
            _told(first, 0),
            _told(each["cpu_s_median"], 3),
            _told(each["sum_of_costs_median"], 0),
            "-" if each["gap_median"] is None else f"{100.0 * each['gap_median']:.1f} %",
            _told(each["makespan_median"], 0),
            _told(each["expansions_per_s"], 0),
            _told(each["memory_mb_max"], 0),
            "{}, {}, {} s, {}".format(*peer) if peer else "-",
            f"{first / peer[3]:.2f}" if peer and first is not None else "-",
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _told(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:,.{digits}f}"
