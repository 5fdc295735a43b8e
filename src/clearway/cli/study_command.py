"""The command that runs a paper's experiment."""

import argparse
import json
import os
import shlex
from pathlib import Path
from typing import Any

from clearway.cli.main import DONE, interrupted
from clearway.cli.progress import ProgressLine
from clearway.protocols import Budget
from clearway.study.conduct import Conducted, conduct, find_study
from clearway.study.experiment import Scale
from clearway.study.rows_file import rows_on_disk
from clearway.study.tables import findings_table
from clearway.study.workers import Workers, cluster, local


def run_study(arguments: argparse.Namespace) -> int:
    """Run a study, or go on with it; what it found, its rows tell."""
    study = find_study(arguments.name)
    scale = Scale(
        quick=arguments.quick,
        first_seed=arguments.seed or 0,
        instances=arguments.instances,
        budget=Budget(arguments.budget, arguments.expansions),
    )
    out, workers = Path(arguments.out), _workers(arguments)
    notes: list[str] = []
    total = 0
    with ProgressLine(quiet=arguments.quiet) as line:

        def progress(done: int, of: int) -> None:
            nonlocal total
            total = of
            line.rows(done, of)

        def warn(text: str) -> None:
            notes.append(text)
            line.note(text)

        try:
            done = conduct(
                study, scale, out, workers, _command(arguments), progress=progress, warn=warn
            )
        except KeyboardInterrupt:
            # The interrupt may have come between a row's being written and its being counted.
            rows = out / "rows.jsonl"
            kept = f"{rows_on_disk(rows)} of {total} rows are in {rows}"
            return interrupted(arguments, f"{kept}; run the same command again to go on")
    if arguments.json:
        print(json.dumps(_summary(study.name, done, notes), allow_nan=False))
    elif not arguments.quiet:
        for finding in findings_table(done.summary.findings).lines:
            print(f"{finding[0]}\n  {finding[1]} [holds: {finding[2]}]")
        if done.failed:
            print(f"{len(done.failed)} rows failed; run the same command again to try them anew")
    if not arguments.json:
        print(out / "report.html")
    return DONE


def _workers(arguments: argparse.Namespace) -> Workers:
    if arguments.workers is None:
        return local(os.cpu_count() or 1 if arguments.jobs is None else arguments.jobs)
    if arguments.jobs is not None:
        raise ValueError("jobs: a cluster has its own number of workers; leave --jobs out")
    return cluster(arguments.workers)


def _command(arguments: argparse.Namespace) -> str:
    """Return the command that gives the same rows."""
    words = ["clearway", "study", arguments.name]
    if arguments.quick:
        words.append("--quick")
    for name in ("seed", "instances", "budget", "expansions"):
        value = getattr(arguments, name)
        if value is not None:
            words += [f"--{name}", f"{value:g}" if isinstance(value, float) else str(value)]
    return shlex.join([*words, "--out", "DIR"])


def _summary(name: str, done: Conducted, notes: list[str]) -> dict[str, Any]:
    return {
        "study": name,
        "rows": len(done.rows),
        "failed": [row["cell"] for row in done.failed],
        "findings": [
            {"claim": each.claim, "ours": each.ours, "holds": each.holds}
            for each in done.summary.findings
        ],
        "notes": notes,
        "files": [str(path) for path in done.files],
    }
