"""The lines of a trace file, the same for the same events."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from clearway.formats.atomic import FormatError
from clearway.formats.plan_dump import robot_json, robot_type_json, site_json
from clearway.model import Trace

TRACE_FORMAT = "clearway.trace/1"
SAMPLES = ("t", "x", "y", "theta")
DECIMALS = 6
# What a decision took is the only thing that differs between two equal runs.
TIMING = "cpu_s"


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not JSON serializable")


_ENCODER = json.JSONEncoder(allow_nan=False, ensure_ascii=False, default=_plain)


def header_line(trace: Trace) -> str:
    """Return the first line of a trace's file, without its line end.

    Raises
    ------
    FormatError
        If a number is not finite, or the parameters hold what JSON cannot.
    """
    return event_line(
        {
            "event": "header",
            "format": TRACE_FORMAT,
            "clearway": trace.version,
            "scenario": trace.scenario,
            "system": trace.system,
            "seed": trace.seed,
            "parameters": trace.parameters,
            "site": site_json(trace.site),
            "robot_types": {name: robot_type_json(t) for name, t in trace.robot_types.items()},
            "robots": [robot_json(robot, ()) for robot in trace.robots],
        }
    )


def event_line(event: Mapping[str, Any]) -> str:
    """Return an event as one line, without its line end; samples are rounded to 1e-6.

    Raises
    ------
    FormatError
        If a number is not finite, the arrays of a motion differ in length, or there is
        something that JSON cannot hold.
    """
    if event["event"] == "motion":
        event = _rounded(event)
    try:
        return _ENCODER.encode(event)
    except (TypeError, ValueError) as error:
        raise FormatError(
            f"cannot be written ({error})",
            key=f"event {event['event']} at {event.get('t')}",
            mend="give plain text and finite numbers",
        ) from None


def dump_trace(trace: Trace) -> str:
    """Return the text of a whole trace file."""
    return "\n".join([header_line(trace), *(event_line(event) for event in trace.events)]) + "\n"


def without_timings(lines: Iterable[str]) -> list[str]:
    """Return the lines of a trace file without CPU times: equal for equal runs.

    Lines that are no JSON object are kept as they are.
    """
    return [_untimed(line) if f'"{TIMING}"' in line else line for line in lines]


def _untimed(line: str) -> str:
    event = json.loads(line)
    event.pop(TIMING, None)
    return _ENCODER.encode(event)


def _rounded(event: Mapping[str, Any]) -> dict[str, Any]:
    try:
        table = np.array([event[name] for name in SAMPLES], dtype=np.float64)
    except ValueError:
        lengths = ", ".join(f"{name} {len(event[name])}" for name in SAMPLES)
        raise FormatError(
            f"the arrays of a motion of {event['robot']} differ in length ({lengths})",
            key="motion",
            mend="give all one length",
        ) from None
    # Adding 0 turns -0.0 into 0.0, so that equal poses are equal bytes.
    rows = (np.round(table, DECIMALS) + 0.0).tolist()
    return {**event, **dict(zip(SAMPLES, rows, strict=True))}
