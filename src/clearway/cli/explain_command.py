"""The command that tells why a robot does what it does."""

import argparse
import json
from pathlib import Path

from clearway.cli.main import DONE
from clearway.formats.atomic import FormatError
from clearway.formats.trace_file import read_trace
from clearway.plot.chronicle import chronicle
from clearway.plot.explain import as_json, as_text, explain


def run_explain(arguments: argparse.Namespace) -> int:
    """Print the chain of causes of one robot at one moment."""
    path = _trace_in(Path(arguments.path))
    trace = read_trace(path)
    happened = chronicle(trace)
    try:
        chain = explain(happened, arguments.robot, arguments.at)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if arguments.json:
        told = {**as_json(chain, arguments.at), "whole": trace.is_whole}
        print(json.dumps(told, allow_nan=False))
    else:
        print(as_text(chain, arguments.at))
        if not trace.is_whole:
            # Motions are written once they are over.
            print(f"The trace is cut short at {happened.duration:g} s: what went on is not in it.")
    return DONE


def _trace_in(path: Path) -> Path:
    """Return the trace file of a run folder, or the file itself."""
    if not path.is_dir():
        return path
    trace = path / "trace.jsonl"
    if not trace.exists():
        raise FormatError(
            "holds no trace.jsonl",
            file=path,
            mend="give the folder of a run that `clearway simulate` wrote; plans have no trace",
        )
    return trace
