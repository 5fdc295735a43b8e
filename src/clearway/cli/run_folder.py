"""A run's files, each written whole or not at all."""

import json
from pathlib import Path

from clearway.formats.atomic import write_text
from clearway.formats.plan_file import write_plan
from clearway.formats.scenario_file import copy_scenario
from clearway.systems.solve import Planned, Run


def write_plan_first(planned: Planned, source: Path, out: Path) -> list[Path]:
    """Write the plan and a copy of its scenario into ``out``; return the files."""
    out.mkdir(parents=True, exist_ok=True)
    plan, copy = out / "plan.json", out / "scenario.toml"
    write_plan(planned.record, plan)
    copy_scenario(source, copy)
    return [plan, copy]


def write_rest(run: Run, out: Path) -> list[Path]:
    """Write all that is made from the plan into ``out``; return the files.

    An interrupted run leaves its figures only, so that it ends at once.
    """
    from clearway.metrics import to_json

    metrics = out / "metrics.json"
    write_plan(run.record, out / "plan.json")  # now with the judge's seconds
    write_text(metrics, json.dumps(to_json(run.metrics), indent=2) + "\n")
    if run.interrupted:
        return [metrics]
    from clearway.plot.picture import draw_plan
    from clearway.plot.report import write_report

    report, picture = out / "report.html", out / "plan.png"
    write_report(run.record, run.metrics, report)
    draw_plan(run.record, picture)
    return [metrics, report, picture]
