"""Arguments in, exit code out; every error is one line that names the mend."""

import argparse
import json
import math
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

DONE, WRONG, BAD_INPUT, NO_ANSWER, INTERRUPTED = 0, 1, 2, 3, 130


class _Parser(argparse.ArgumentParser):
    """Usage errors leave by exit code 2, as JSON where that was asked for."""

    asks_json = False

    def error(self, message: str) -> NoReturn:
        if _Parser.asks_json:
            told = {"code": BAD_INPUT, "kind": "usage", "message": message}
            print(json.dumps({"error": told}))
        else:
            self.print_usage(sys.stderr)
            print(f"clearway: error: {message}", file=sys.stderr)
        raise SystemExit(BAD_INPUT)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be a number of seconds above 0, got {text}")
    return value


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"must be a whole number, 0 or above, got {text}")
    return int(text)


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"must be a number, got {text}")
    return value


def _parser() -> argparse.ArgumentParser:
    from importlib.metadata import version

    parser = _Parser(
        prog="clearway",
        description="Assign work to a mixed robot fleet in a confined site, plan how all of it "
        "moves without conflict, judge the plan and show it.",
        epilog="exit codes: 0 done, 1 judged wrong, 2 bad input, 3 no complete answer, "
        "130 interrupted",
    )
    parser.add_argument("--version", action="version", version=f"clearway {version('clearway')}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    talk = _Parser(add_help=False)
    talk.add_argument("--json", action="store_true", help="one JSON object on stdout, nothing else")
    talk.add_argument("--quiet", action="store_true", help="no progress, no summary")
    search = _Parser(add_help=False)
    search.add_argument("--seed", type=_count, help="repeatable choices (default: the scenario's)")
    search.add_argument("--budget", type=_positive, metavar="SECONDS", help="stop after this long")
    search.add_argument(
        "--expansions", type=_count, metavar="N", help="stop after this much search; repeatable"
    )

    solve = commands.add_parser("solve", parents=[talk, search], help="assign and plan a scenario")
    solve.add_argument("scenario", metavar="SCENARIO.toml")
    solve.add_argument("--out", required=True, metavar="RUN/", help="folder for plan and report")
    simulate = commands.add_parser(
        "simulate", parents=[talk, search], help="run a scenario through time: orders that arrive"
    )
    simulate.add_argument("scenario", metavar="SCENARIO.toml")
    simulate.add_argument(
        "--out", required=True, metavar="RUN/", help="folder for trace and report"
    )
    demo = commands.add_parser("demo", parents=[talk, search], help="a warehouse with 8 robots")
    demo.add_argument("--out", default="demo-run", metavar="RUN/", help="default: demo-run")
    check = commands.add_parser(
        "check", parents=[talk], help="everything that can be known without solving"
    )
    check.add_argument("scenario", metavar="SCENARIO.toml")
    check.add_argument("--out", metavar="DIR/", help="draw the site into this folder")
    validate = commands.add_parser("validate", parents=[talk], help="judge a plan or a trace")
    validate.add_argument("path", metavar="RUN/, plan.json or trace.jsonl")
    explain = commands.add_parser("explain", parents=[talk], help="why a robot does what it does")
    explain.add_argument("path", metavar="RUN/ or trace.jsonl")
    explain.add_argument("--robot", required=True, metavar="ID")
    explain.add_argument(
        "--at", required=True, type=_number, metavar="T", help="seconds from the run's beginning"
    )
    commands.add_parser("schema", parents=[talk], help="JSON Schema of scenario files")
    bench = commands.add_parser(
        "bench", parents=[talk, search], help="a set of instances, one row each"
    )
    bench.add_argument(
        "name",
        choices=["warehouse", "kinodynamic"],
        help="warehouse: seeded sites of system A; kinodynamic: one goal per robot, from FILES",
    )
    bench.add_argument(
        "files",
        nargs="*",
        metavar="FILES",
        help="kinodynamic: CL-CBS instances (.yaml) and scenarios of `clearway generate` (.toml)",
    )
    bench.add_argument("--out", required=True, metavar="DIR/", help="folder for rows and plans")
    bench.add_argument(
        "--border",
        choices=["closed", "open"],
        default="closed",
        help="kinodynamic: whether bodies stay inside the map of a CL-CBS instance",
    )
    bench.add_argument(
        "--jobs", type=_count, default=1, metavar="N", help="kinodynamic: processes (default: 1)"
    )
    bench.add_argument("--robots", type=_count, default=16)
    bench.add_argument("--tasks", type=_count, default=48)
    bench.add_argument("--instances", type=_count, default=30, help="seeds 0 to N - 1")
    study = commands.add_parser(
        "study", parents=[talk, search], help="a paper's experiment, our figures beside its own"
    )
    study.add_argument("name", metavar="NAME", help="such as hierarchical-table2")
    study.add_argument("--out", required=True, metavar="DIR/", help="folder for rows and report")
    study.add_argument(
        "--quick", action="store_true", help="a small version: under two minutes on two cores"
    )
    study.add_argument(
        "--instances", type=_count, metavar="K", help="seeds S to S + K - 1 of each point"
    )
    study.add_argument(
        "--jobs", type=_count, metavar="N", help="processes (default: one per processor)"
    )
    study.add_argument(
        "--workers", metavar="ADDRESS", help="of a Dask cluster, such as tcp://10.0.0.1:8786"
    )
    generate = commands.add_parser("generate", parents=[talk], help="seeded instances for planners")
    generate.add_argument("kind", metavar="KIND", help="open, shelves, rooms, corridors or yards")
    generate.add_argument("--out", required=True, metavar="DIR/", help="folder for the scenarios")
    generate.add_argument("--robots", type=_count, default=25, metavar="N", help="default: 25")
    generate.add_argument(
        "--size",
        type=_number,
        nargs=2,
        default=(100.0, 100.0),
        metavar=("W", "H"),
        help="metres along x and y (default: 100 100)",
    )
    generate.add_argument(
        "--density",
        type=_number,
        metavar="D",
        help="share of the floor under obstacles (default: the kind's)",
    )
    generate.add_argument(
        "--fleet",
        default="cars",
        help="cars (default), carriers, forklifts, shuttles, differentials, holonomics or mixed",
    )
    generate.add_argument("--seed", type=_count, default=0, help="of the first one (default: 0)")
    generate.add_argument(
        "--count", type=_count, default=1, metavar="K", help="instances, of seeds S to S + K - 1"
    )
    return parser


def _fail(arguments: argparse.Namespace, code: int, error: dict[str, Any]) -> int:
    if arguments.json:
        print(json.dumps({"error": {"code": code, **error}}))
    else:
        print(f"clearway: {error['kind']}: {error['message']}", file=sys.stderr)
        for line in error.get("more", ()):
            print(f"  {line}", file=sys.stderr)
    return code


def interrupted(arguments: argparse.Namespace, kept: str) -> int:
    """Tell what an interrupt left; return its exit code."""
    return _fail(arguments, INTERRUPTED, {"kind": "interrupted", "message": kept})


def _described(error: Exception, file: str | None) -> dict[str, Any]:
    """Return what is known of an input error: file, key, value and mend where it has them."""
    told: dict[str, Any] = {"kind": "bad input", "message": str(error)}
    if file and getattr(error, "file", None) is None:
        told |= {"file": file, "message": f"{file}: {error}"}
    for name in ("file", "key", "mend"):
        if getattr(error, name, None) is not None:
            told[name] = getattr(error, name)
    if hasattr(error, "value") and type(error.value) is not object:
        told["value"] = repr(error.value)[:200]
    if hasattr(error, "findings"):
        told["findings"] = [finding.text for finding in error.findings]
        told["more"] = [f"{f.key}: {f.text}" for f in error.findings[1:20]]
    if hasattr(error, "problems"):
        told["problems"] = [str(problem) for problem in error.problems]
        told["more"] = told["problems"][1:20]
    return told


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit code."""
    given = sys.argv[1:] if argv is None else list(argv)
    _Parser.asks_json = "--json" in given
    arguments = _parser().parse_args(given)
    from clearway.cli import commands

    try:
        return commands.COMMANDS[arguments.command](arguments)
    except KeyboardInterrupt:
        return interrupted(arguments, "nothing is written")
    except BrokenPipeError:
        sys.stderr.close()
        return DONE
    except OSError as error:
        place = error.filename or ""
        message = f"{place}: {error.strerror or error}; check the path, its rights and free space"
        return _fail(arguments, BAD_INPUT, {"kind": "file", "message": message, "file": place})
    except ValueError as error:
        return _fail(arguments, BAD_INPUT, _described(error, getattr(arguments, "scenario", None)))
