"""The command that judges plans and traces."""

import argparse
import json
from pathlib import Path
from typing import Any

from clearway.cli.main import DONE, WRONG
from clearway.formats.plan_file import read_plan
from clearway.formats.trace_file import is_trace, read_trace
from clearway.validate import Violation, validate_plan, validate_trace


def run_validate(arguments: argparse.Namespace) -> int:
    """Judge a plan or a trace file, or those of a run folder."""
    files = _files(Path(arguments.path))
    found: list[tuple[Path, list[Violation]]] = []
    whole = True
    for file in files:
        if is_trace(file):
            trace = read_trace(file)
            whole = whole and trace.is_whole
            found.append((file, validate_trace(trace)))
        else:
            found.append((file, validate_plan(read_plan(file))))
    right = not any(violations for _, violations in found)
    if arguments.json:
        print(json.dumps(_json(found, right, whole), allow_nan=False))
        return DONE if right else WRONG
    for file, violations in found:
        for violation in violations:
            print(violation)
        if not arguments.quiet:
            verdict = f"{len(violations)} wrong" if violations else "nothing wrong"
            cut = is_trace(file) and not whole
            print(f"{file}: {verdict}" + (", up to where it was cut short" if cut else ""))
    return DONE if right else WRONG


def _files(path: Path) -> list[Path]:
    if not path.is_dir():
        return [path]
    there = [path / name for name in ("trace.jsonl", "plan.json") if (path / name).exists()]
    return there or [path / "plan.json"]


def _json(found: list[tuple[Path, list[Violation]]], right: bool, whole: bool) -> dict[str, Any]:
    return {
        "file": str(found[0][0]),
        "files": [str(file) for file, _ in found],
        "right": right,
        "whole": whole,
        "violations": [
            {
                "file": str(file),
                "kind": v.kind,
                "robots": list(v.robots),
                "time": v.time,
                "place": list(v.place),
                "depth": v.depth,
                "text": v.text,
            }
            for file, violations in found
            for v in violations
        ],
    }
