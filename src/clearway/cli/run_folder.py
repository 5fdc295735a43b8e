"""A run's files, each written whole or not at all."""

import json
from pathlib import Path

from clearway.formats.atomic import write_bytes, write_text
from clearway.formats.plan_file import write_plan
from clearway.systems.solve import Run


def write_run(run: Run, source: Path, out: Path) -> list[Path]:
    """Write a run into ``out``; return the files.

    An interrupted run leaves its plan and scenario only, so that it ends at once.
    """
    from clearway.metrics import to_json

    plan, copy, metrics = out / "plan.json", out / "scenario.toml", out / "metrics.json"
    write_plan(run.record, plan)
    if source.resolve() != copy.resolve():
        write_bytes(copy, source.read_bytes())
    write_text(metrics, json.dumps(to_json(run.metrics), indent=2) + "\n")
    written = [plan, copy, metrics]
    if run.interrupted:
        return written
    from clearway.plot.picture import draw_plan
    from clearway.plot.report import write_report

    write_report(run.record, run.metrics, out / "report.html")
    draw_plan(run.record, out / "plan.png")
    return [*written, out / "report.html", out / "plan.png"]
