"""What each command does."""

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from clearway.cli.main import BAD_INPUT, DONE, INTERRUPTED, NO_ANSWER, WRONG, interrupted
from clearway.cli.progress import ProgressLine
from clearway.cli.run_folder import write_plan_first, write_rest
from clearway.formats.ready_made import scenario_folder
from clearway.formats.scenario_file import read_scenario
from clearway.model import Scenario
from clearway.protocols import Budget
from clearway.systems.solve import FEW_ROBOTS, Run, judge_plan, make_plan
from clearway.validate.finding import Finding


def _print_json(content: dict[str, Any]) -> None:
    print(json.dumps(content, allow_nan=False))


def _solve(arguments: argparse.Namespace, source: Path, scenario: Scenario) -> int:
    out = Path(arguments.out)
    with ProgressLine(quiet=arguments.quiet) as line:
        planned = make_plan(
            scenario,
            budget=Budget(arguments.budget, arguments.expansions),
            seed=arguments.seed,
            progress=line.planning,
            clock=time.process_time,
        )
        # The plan is kept before anything else is done with it.
        written = write_plan_first(planned, source, out)
        if planned.interrupted and len(scenario.robots) > FEW_ROBOTS:
            # Judging many takes longer than who presses Ctrl-C wants to wait.
            kept = f"the plan so far is in {written[0]}, not judged; run clearway validate {out}"
            return interrupted(arguments, kept)
        try:
            line.say("judging")
            run = judge_plan(planned, clock=time.process_time)
            line.say("writing the run folder")
            written += write_rest(run, out)
        except KeyboardInterrupt:
            return interrupted(arguments, f"the plan is in {out / 'plan.json'}")
    code = _exit_code(run)
    if arguments.json:
        _print_json({**_summary(run), "files": [str(path) for path in written]})
        return code
    if not arguments.quiet:
        print(_told(run))
    print(out / "report.html" if (out / "report.html") in written else out / "plan.json")
    return code


def _exit_code(run: Run) -> int:
    if run.interrupted:
        return INTERRUPTED
    if run.violations:
        return WRONG
    return DONE if run.plan else NO_ANSWER


def _summary(run: Run) -> dict[str, Any]:
    from clearway.metrics import to_json

    return {
        **to_json(run.metrics),
        "scenario": run.record.scenario,
        "seed": run.record.seed,
        "reason": run.record.reason,
        "concerned": list(run.plan.concerned),
        "violations": [str(violation) for violation in run.violations],
        "expansions": run.plan.counters["expansions"],
        "reassigned": run.plan.counters.get("reassigned", 0),
        "reassignment_gain_percent": run.plan.counters.get("reassignment_gain_permille", 0) / 10.0,
        "timings": dict(run.record.timings),
    }


def _told(run: Run) -> str:
    record, timings = run.record, run.record.timings
    lines = [f"{record.scenario}: {record.status.value}"]
    if record.reason:
        lines[0] += f" ({record.reason})"
    tasks = sum(len(done) for done in record.assignment.values())
    done = run.metrics.tasks_done
    lines.append(
        f"  {len(record.robots)} robots, {done} of {tasks} tasks done, "
        f"the last arrival after {record.makespan:.1f} s"
    )
    empty = -tasks % len(record.robots)
    if record.parameters.get("even") and empty:
        lines.append(
            f"  even split: padded with {empty} of no cost, so that all have as many tasks"
        )
    bound = f", lower bound {record.lower_bound:.1f} s" if record.lower_bound else ""
    lines.append(f"  sum of costs {record.sum_of_costs:.1f} s{bound}")
    if run.plan.counters.get("reassigned"):
        gain = run.plan.counters["reassignment_gain_permille"] / 10.0
        lines.append(f"  tasks shared out anew, for {gain:.1f} % less than at first")
    if run.metrics.tardiness is not None:
        lines.append(f"  finished after due times by {run.metrics.tardiness:.1f} s in all")
    least = run.metrics.least_separation
    if least:
        lines.append(f"  least separation {least.metres:.3f} m ({least.first} and {least.second})")
    lines.append(
        f"  planned in {timings['plan_s']:.2f} s CPU ({run.plan.counters['expansions']:,} "
        f"expansions), judged in {timings['judge_s']:.2f} s: "
        + (f"{len(run.violations)} violations" if run.violations else "nothing wrong")
    )
    lines += [f"  {violation}" for violation in run.violations[:20]]
    return "\n".join(lines)


def run_solve(arguments: argparse.Namespace) -> int:
    """Assign and plan a scenario file."""
    source = Path(arguments.scenario)
    return _solve(arguments, source, read_scenario(source))


def run_demo(arguments: argparse.Namespace) -> int:
    """Solve the warehouse with 8 robots and 24 tasks."""
    source = scenario_folder() / "warehouse-8x24.toml"
    code = _solve(arguments, source, read_scenario(source))
    if not arguments.json:
        print(arguments.out)
    return code


def run_check(arguments: argparse.Namespace) -> int:
    """Tell what is known of a scenario without solving it."""
    from clearway.validate.legality import check_scenario

    scenario = read_scenario(Path(arguments.scenario))
    legality = check_scenario(scenario)
    legality = replace(legality, findings=(*legality.findings, *_refused(scenario)))
    picture = None
    if arguments.out:
        from clearway.plot.picture import draw_site

        out = Path(arguments.out)
        out.mkdir(parents=True, exist_ok=True)
        picture = out / "site.png"
        marks = [
            (*finding.place, str(number))
            for number, finding in enumerate(legality.findings, start=1)
            if finding.place
        ]
        tasks = [order.task for order in scenario.orders]
        draw_site(scenario.site, scenario.robot_types, scenario.robots, tasks, picture, marks=marks)
    if arguments.json:
        _print_json(
            {
                "scenario": scenario.name,
                "legal": bool(legality),
                "findings": [
                    {
                        "kind": finding.kind,
                        "severity": finding.severity,
                        "key": finding.key,
                        "text": finding.text,
                        "robots": list(finding.robots),
                        "place": finding.place,
                        "depth": finding.depth,
                        "proof": finding.proof,
                    }
                    for finding in legality.findings
                ],
                "clearances": dict(legality.clearances),
                "reachable": {k: sorted(v) for k, v in legality.reachable.items()},
            }
        )
        return DONE if legality else BAD_INPUT
    if not arguments.quiet:
        num_tasks = len(scenario.orders)
        print(
            f"{scenario.name}: {len(scenario.robots)} robots, {num_tasks} tasks, "
            f"{len(scenario.site.obstacles)} obstacles, {len(scenario.site.zones)} zones"
        )
        tightest = sorted(legality.clearances.items(), key=lambda item: item[1])[:5]
        print("least clearances: " + ", ".join(f"{key} {gap:.3f} m" for key, gap in tightest))
        within = set().union(*legality.reachable.values())
        if num_tasks or not scenario.simulation.streams:
            print(
                f"{len(within)} of {num_tasks} tasks lie within reach of a robot that may do them"
            )
        for stream in scenario.simulation.streams:
            print(f"stream {stream.name}: orders come as the run goes on")
    for number, finding in enumerate(legality.findings, start=1):
        print(f"{number}. {finding.severity}: {finding.key}: {finding.text}")
    if legality and not arguments.quiet:
        print("nothing wrong is known of it")
    if picture:
        print(picture)
    return DONE if legality else BAD_INPUT


def _refused(scenario: Scenario) -> list[Finding]:
    """Return what the system of a scenario that runs through time cannot take.

    Raises
    ------
    SettingsError
        If the system or a setting does not exist.
    """
    from clearway.systems.choose import choose_lifelong
    from clearway.systems.simulate import unsupported
    from clearway.validate.endurance import runs_through_time

    system = choose_lifelong(scenario)
    reasons = unsupported(scenario, system) if runs_through_time(scenario) else ()
    return [Finding("unsupported", "error", "system", reason) for reason in reasons]


def run_validate(arguments: argparse.Namespace) -> int:
    """Judge a plan or a trace."""
    from clearway.cli.validate_command import run_validate

    return run_validate(arguments)


def run_schema(arguments: argparse.Namespace) -> int:
    """Print the JSON Schema of scenario files."""
    from clearway.formats.scenario_file import scenario_schema

    print(json.dumps(scenario_schema(), indent=None if arguments.json else 2))
    return DONE


def run_explain(arguments: argparse.Namespace) -> int:
    """Tell why a robot does what it does."""
    from clearway.cli.explain_command import run_explain

    return run_explain(arguments)


def run_bench(arguments: argparse.Namespace) -> int:
    """Plan a set of instances and write a row for each."""
    from clearway.study.bench import bench_warehouse
    from clearway.study.kinodynamic import bench_kinodynamic

    out, seed = Path(arguments.out), arguments.seed or 0
    budget = Budget(arguments.budget, arguments.expansions)
    files = [Path(file) for file in arguments.files]
    if arguments.name == "kinodynamic" and not files:
        raise ValueError("bench kinodynamic: no files are named; give .yaml or .toml instances")
    if arguments.name == "warehouse" and files:
        raise ValueError(f"bench warehouse makes its own sites; leave out {files[0]}")
    if arguments.jobs < 1:
        raise ValueError("--jobs: must be 1 or more, got 0")
    with ProgressLine(quiet=arguments.quiet) as line:
        if arguments.name == "kinodynamic":
            table = bench_kinodynamic(
                files,
                out,
                border=arguments.border,
                budget=budget,
                seed=seed,
                jobs=arguments.jobs,
                tell=line.say,
            )
        else:
            table = bench_warehouse(
                out,
                robots=arguments.robots,
                tasks=arguments.tasks,
                seeds=range(seed, seed + arguments.instances),
                budget=budget,
                tell=line.say,
            )
    if arguments.json:
        _print_json(table.summary)
    else:
        print(table.markdown)
    return INTERRUPTED if table.interrupted else DONE


def run_generate(arguments: argparse.Namespace) -> int:
    """Write seeded instances; all of them, or none where one cannot be made."""
    from clearway.formats.atomic import write_text
    from clearway.formats.scenario_dump import dump_scenario
    from clearway.world.generate import generate
    from clearway.world.sites import covered

    if arguments.count < 1:
        raise ValueError("count: must be 1 or more, got 0")
    out, (w, h) = Path(arguments.out), arguments.size
    made: dict[Path, str] = {}
    with ProgressLine(quiet=arguments.quiet) as line:
        for seed in range(arguments.seed, arguments.seed + arguments.count):
            line.say(f"instance {len(made) + 1} of {arguments.count}")
            scenario = generate(
                arguments.kind,
                robots=arguments.robots,
                size=(w, h),
                fleet=arguments.fleet,
                density=arguments.density,
                seed=seed,
            )
            made_by = (
                f"Made by: clearway generate {arguments.kind} --robots {arguments.robots} "
                f"--size {w:.12g} {h:.12g} --fleet {arguments.fleet} --seed {seed}"
            )
            if arguments.density is not None:
                made_by += f" --density {arguments.density:.12g}"
            share = f"Obstacles cover {100.0 * covered(scenario.site):.1f} % of the floor."
            made[out / f"{scenario.name}.toml"] = dump_scenario(scenario, f"{made_by}\n{share}")
    out.mkdir(parents=True, exist_ok=True)
    written: list[str] = []
    try:
        for path, text in made.items():
            write_text(path, text)
            written.append(str(path))
    except KeyboardInterrupt:
        return interrupted(arguments, f"{len(written)} of {len(made)} files are in {out}")
    if arguments.json:
        _print_json({"files": written})
    else:
        print("\n".join(written))
    return DONE


def run_study(arguments: argparse.Namespace) -> int:
    """Run a paper's experiment."""
    from clearway.cli.study_command import run_study

    return run_study(arguments)


def run_simulate(arguments: argparse.Namespace) -> int:
    """Run a scenario file through time."""
    from clearway.cli.simulate_command import run_simulate

    return run_simulate(arguments)


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "bench": run_bench,
    "check": run_check,
    "demo": run_demo,
    "explain": run_explain,
    "generate": run_generate,
    "schema": run_schema,
    "simulate": run_simulate,
    "solve": run_solve,
    "study": run_study,
    "validate": run_validate,
}
