"""A trace from the lines of a trace file, refused by name where it is malformed."""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from clearway.formats.atomic import FormatError
from clearway.formats.json_node import Node, parse_json
from clearway.formats.plan_parse import free_of, robot_types_of, robots_of, text_or
from clearway.formats.plan_parts import site_of
from clearway.formats.trace_dump import TRACE_FORMAT
from clearway.formats.trace_events import event_of
from clearway.model import Trace

_MEND = "restore the file from a copy, or simulate again"


def read_trace(path: str | os.PathLike[str]) -> Trace:
    """Read a trace file, to its last full line where it was cut short.

    Raises
    ------
    FormatError
        If the file cannot be read or a line before the last is malformed; names file, line,
        key, value and the mend.
    """
    name = os.fspath(path)
    try:
        with open(path, "rb") as file:
            return parse_trace(file, name)
    except OSError as error:
        raise FormatError(
            f"cannot be read ({error.strerror})", file=name, mend="check the path"
        ) from None


def is_trace(path: str | os.PathLike[str]) -> bool:
    """Whether a file is meant as a trace: by its name, or by its first line."""
    if Path(path).suffix == ".jsonl":
        return True
    try:
        with Path(path).open("rb") as file:
            return b'"clearway.trace/' in file.readline(2**20)
    except OSError:
        return False


def parse_trace(lines: Iterable[bytes], file: str = "trace.jsonl") -> Trace:
    """Return the trace of a file's lines; ``file`` is named in errors.

    A last line that is no whole JSON object is left out. Sample arrays of ``motion`` events
    become NumPy arrays, everything else is as in the file.

    Raises
    ------
    FormatError
        If the header or any other line is malformed.
    """
    source = iter(lines)
    head = _header(next(source, b""), file)
    robots = {robot.id for robot in head.robots}
    events: list[dict[str, Any]] = []
    broken: FormatError | None = None
    for number, line in enumerate(source, start=2):
        if broken is not None:
            raise broken
        try:
            node = _node(line, f"{file}, line {number}")
        except FormatError as error:
            broken = error  # which is only how a cut file ends if no line follows
            continue
        events.append(event_of(node, robots))
    whole = broken is None and bool(events) and events[-1]["event"] == "end"
    return Trace(
        scenario=head.scenario,
        system=head.system,
        seed=head.seed,
        site=head.site,
        robot_types=head.robot_types,
        robots=head.robots,
        events=tuple(events),
        is_whole=whole,
        parameters=head.parameters,
        version=head.version,
    )


def _node(line: bytes, place: str) -> Node:
    try:
        node = parse_json(line.decode("utf-8"), place)
    except UnicodeDecodeError as error:
        raise FormatError(f"not UTF-8 text (byte {error.start})", file=place, mend=_MEND) from None
    except FormatError as error:
        raise FormatError(error.problem, file=place, key=error.key, mend=_MEND) from None
    if not isinstance(node.value, dict):
        raise FormatError("not a JSON object", file=place, value=node.value, mend=_MEND)
    return node


def _header(line: bytes, file: str) -> Trace:
    root = _node(line, f"{file}, line 1")
    form = root["format"]
    if form.value != TRACE_FORMAT:
        form.fail("not a trace file", f'trace files say "format": "{TRACE_FORMAT}"')
    types = robot_types_of(root["robot_types"])
    parameters = root["parameters"]
    return Trace(
        scenario=text_or(root["scenario"], ""),
        system=text_or(root["system"], ""),
        seed=root["seed"].integer() if root["seed"].given else 0,
        site=site_of(root["site"]),
        robot_types=types,
        robots=robots_of(root["robots"], types),
        events=(),
        is_whole=False,
        parameters=free_of(parameters) if parameters.given else {},
        version=text_or(root["clearway"], ""),
    )
