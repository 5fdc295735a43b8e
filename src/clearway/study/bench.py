"""The warehouse benchmark: seeded sites of system A, planned, judged and tabled."""

import json
import resource
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from clearway.formats.atomic import write_text
from clearway.formats.plan_file import write_plan
from clearway.model import PlanRecord
from clearway.protocols import Budget
from clearway.systems.solve import solve
from clearway.world.warehouse import random_warehouse


@dataclass(frozen=True)
class BenchTable:
    """Rows of a benchmark, their summary, and the summary as a Markdown table."""

    rows: tuple[dict[str, Any], ...]
    summary: dict[str, Any]
    markdown: str
    interrupted: bool = False


def bench_warehouse(
    out: Path,
    *,
    robots: int,
    tasks: int,
    seeds: Sequence[int],
    budget: Budget,
    tell: Callable[[str], None] = lambda text: None,
) -> BenchTable:
    """Plan one warehouse per seed; write ``rows.jsonl``, ``table.md`` and ``plans/`` into ``out``.

    A budget of expansions, or none reached, gives the same plans and rows each time but for
    the seconds.
    """
    (out / "plans").mkdir(parents=True, exist_ok=True)
    rows: list[dict[str, Any]] = []
    for seed in seeds:
        name = f"warehouse-{robots}x{tasks}-seed{seed}"
        tell(f"{name} ({len(rows) + 1} of {len(seeds)})")
        wall = time.monotonic()
        run = solve(
            random_warehouse(robots, tasks, seed),
            seed=seed,
            budget=budget,
            clock=time.process_time,
        )
        rows.append(_row(name, run.record, seed, time.monotonic() - wall, len(run.violations)))
        rows[-1]["expansions"] = run.plan.counters["expansions"]
        write_plan(run.record, out / "plans" / f"{name}.json")
        write_text(out / "rows.jsonl", "".join(json.dumps(row) + "\n" for row in rows))
        if run.interrupted:
            del rows[-1]  # it tells of the interrupt, not of the instance
            break
    summary = _summary(f"warehouse-{robots}x{tasks}", rows)
    markdown = _markdown(summary)
    write_text(out / "table.md", markdown + "\n")
    stopped = bool(rows) and len(rows) < len(seeds)
    return BenchTable(tuple(rows), summary, markdown, stopped)


def _row(name: str, record: PlanRecord, seed: int, wall: float, wrong: int) -> dict[str, Any]:
    return {
        "instance": name,
        "robots": len(record.robots),
        "status": record.status.value,
        "clean": wrong == 0,
        "cpu_s": record.timings["plan_s"],
        "wall_s": round(wall, 3),
        "sum_of_costs": record.sum_of_costs,
        "makespan": record.makespan,
        "lower_bound": record.lower_bound,
        "seed": seed,
        "assign_cpu_s": record.timings["assign_s"],
        "judge_cpu_s": record.timings["judge_s"],
    }


def _summary(name: str, rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    solved = [row for row in rows if row["status"] == "solved"]
    cpu = [row["cpu_s"] for row in rows] or [0.0]
    gaps = [row["sum_of_costs"] / row["lower_bound"] - 1.0 for row in solved] or [0.0]
    return {
        "set": name,
        "instances": len(rows),
        "solved": len(solved),
        "clean": sum(row["clean"] for row in rows),
        "plan_cpu_s_median": round(median(cpu), 3),
        "plan_cpu_s_max": round(max(cpu), 3),
        "expansions": sum(row["expansions"] for row in rows),
        "gap_median": round(median(gaps), 4),
        "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024,
    }


def _markdown(summary: dict[str, Any]) -> str:
    heads = {
        "set": "set",
        "solved": "solved",
        "clean": "judged clean",
        "plan_cpu_s_median": "planning CPU s, median",
        "plan_cpu_s_max": "max",
        "gap_median": "median gap to the lower bound",
        "peak_memory_mb": "peak memory MB",
    }
    cells = {key: str(summary[key]) for key in heads}
    for key in ("solved", "clean"):
        cells[key] = f"{summary[key]} of {summary['instances']}"
    cells["gap_median"] = f"{100.0 * summary['gap_median']:.1f} %"
    line = "| " + " | ".join(heads.values()) + " |"
    return "\n".join([line, "|" + "---|" * len(heads), "| " + " | ".join(cells.values()) + " |"])
