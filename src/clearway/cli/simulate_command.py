"""``clearway simulate``: run a scenario through time, write what happens as it happens."""

import argparse
import json
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from clearway.cli.interrupts import Interrupts
from clearway.cli.main import DONE, INTERRUPTED, NO_ANSWER, WRONG, interrupted
from clearway.cli.progress import ProgressLine
from clearway.formats.atomic import write_text
from clearway.formats.plan_file import write_plan
from clearway.formats.scenario_file import copy_scenario, read_scenario
from clearway.formats.trace_file import TraceWriter
from clearway.formats.trace_parse import read_trace
from clearway.formats.trace_plan import plan_of
from clearway.metrics.trace_metrics import trace_metrics, trace_to_json
from clearway.metrics.trace_table import told
from clearway.model import Scenario, Trace
from clearway.protocols import Budget
from clearway.simulation.events import Record
from clearway.systems.simulate import Simulated, simulate
from clearway.validate.finding import Finding
from clearway.validate.trace_judge import validate_trace
from clearway.validate.violation import Violation

CODES = {"done": DONE, "ended": DONE, "interrupted": INTERRUPTED}

# More are not read; `clearway check` tells them all.
MOST_WARNINGS = 20


def run_simulate(arguments: argparse.Namespace) -> int:
    """Simulate a scenario file and write the run folder."""
    source, out = Path(arguments.scenario), Path(arguments.out)
    scenario = read_scenario(source)
    out.mkdir(parents=True, exist_ok=True)
    trace_file = out / "trace.jsonl"
    warnings: list[Finding] = []
    has_begun = False
    with ProgressLine(quiet=arguments.quiet) as line, Interrupts() as ctrl_c, ExitStack() as stack:
        tell_line = line.running(scenario.simulation.until)

        def tell(second: float, done: int, left: int) -> None:
            ctrl_c.check()
            tell_line(second, done, left)

        def warn(finding: Finding) -> None:
            warnings.append(finding)
            if not arguments.json and len(warnings) <= MOST_WARNINGS:
                line.note(f"warning: {source}: {finding.key}: {finding.text}")

        def record(header: Trace) -> Record:
            # What an earlier run left here would belie this one.
            for name in ("plan.json", "metrics.json", "report.html", "plan.png"):
                (out / name).unlink(missing_ok=True)
            copy_scenario(source, out / "scenario.toml")
            nonlocal has_begun
            has_begun = True
            return stack.enter_context(TraceWriter(trace_file, header))

        try:
            run = simulate(
                scenario,
                seed=arguments.seed,
                budget=Budget(arguments.budget, arguments.expansions),
                record=record,
                tell=tell,
                warn=warn,
                clock=time.process_time,
                hold=ctrl_c.held,
            )
            stack.close()
            if run.status == "interrupted":
                return _told_interrupted(arguments, run, trace_file)
            line.say("judging")
            # What is judged is what was written.
            trace = read_trace(trace_file)
            violations = validate_trace(trace)
            line.say("writing the run folder")
            files = _write(trace, violations, out)
        except KeyboardInterrupt:
            if not has_begun:
                raise
            kept = f"the trace is in {trace_file}; clearway validate {trace_file} judges it"
            return interrupted(arguments, kept)
    code = WRONG if violations else CODES.get(run.status, NO_ANSWER)
    _tell(arguments, scenario, run, trace, violations, warnings, files)
    return code


def _write(trace: Trace, violations: list[Violation], out: Path) -> list[Path]:
    from clearway.plot.trace_picture import draw_trace
    from clearway.plot.trace_report import write_trace_report

    metrics = trace_metrics(trace)
    files = [out / "trace.jsonl", out / "scenario.toml"]
    files += [out / name for name in ("plan.json", "metrics.json", "report.html", "plan.png")]
    write_plan(plan_of(trace), out / "plan.json")
    figures = {**trace_to_json(metrics), "violations": len(violations)}
    write_text(out / "metrics.json", json.dumps(figures, indent=2) + "\n")
    write_trace_report(trace, metrics, out / "report.html", len(violations))
    draw_trace(trace, out / "plan.png")
    return files


def _tell(
    arguments: argparse.Namespace,
    scenario: Scenario,
    run: Simulated,
    trace: Trace,
    violations: list[Violation],
    warnings: list[Finding],
    files: list[Path],
) -> None:
    metrics = trace_metrics(trace)
    if arguments.json:
        summary: dict[str, Any] = {
            **trace_to_json(metrics),
            "scenario": scenario.name,
            "seed": trace.seed,
            "status": run.status,
            "violations": [str(violation) for violation in violations],
            "warnings": [f"{finding.key}: {finding.text}" for finding in warnings],
            "files": [str(path) for path in files],
        }
        print(json.dumps(summary, allow_nan=False))
        return
    if not arguments.quiet:
        print(f"{scenario.name}: {run.status}")
        print(told(metrics))
        found = f"{len(violations)} violations" if violations else "nothing wrong"
        print(f"judged over the whole trace: {found}")
        for violation in violations[:20]:
            print(f"  {violation}")
    print(next(path for path in files if path.name == "report.html"))


def _told_interrupted(arguments: argparse.Namespace, run: Simulated, file: Path) -> int:
    end = run.trace.events[-1]
    kept = (
        f"the trace up to {end['t']:.1f} s is in {file}, marked interrupted "
        f"({end['orders_done']} orders done); clearway validate {file} judges it"
    )
    return interrupted(arguments, kept)
