"""Trace files: what happens is there at once, cut files are read, broken ones are named."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from clearway.formats.atomic import FormatError
from clearway.formats.trace_file import (
    TraceWriter,
    dump_trace,
    is_trace,
    parse_trace,
    read_trace,
    without_timings,
)


def lines_of(trace) -> list[bytes]:
    return dump_trace(trace).encode().splitlines(keepends=True)


def write(trace, path: Path) -> None:
    with TraceWriter(path, trace) as record:
        for event in trace.events:
            record(event)


def test_what_is_written_is_read_again(traces, tmp_path: Path) -> None:
    """Reading gives the same header and events, writing what was read the same bytes."""
    path = tmp_path / "trace.jsonl"
    trace = traces.right()
    write(trace, path)
    again = read_trace(path)
    assert again.is_whole
    assert (again.site, again.robot_types, again.robots) == (
        trace.site,
        dict(trace.robot_types),
        trace.robots,
    )
    assert (again.scenario, again.system, again.seed) == ("by hand", "by hand", 7)
    assert (again.parameters, again.version) == ({"rules": "by hand"}, "0.1.0")
    assert [e["event"] for e in again.events] == [e["event"] for e in trace.events]
    assert dump_trace(again).encode() == path.read_bytes() == dump_trace(trace).encode()
    assert isinstance(again.of("motion")[0]["x"], np.ndarray)


def test_the_first_line_is_the_promised_header(traces) -> None:
    """Outsiders find format, site, types, robots, scenario and seed in the first line."""
    header = json.loads(lines_of(traces.right())[0])
    assert header["event"] == "header"
    assert header["format"] == "clearway.trace/1"
    assert header["robots"][0] == {"id": "a", "type": "cart", "start": [2, 2, 0], "visits": []}
    assert {"site", "robot_types", "scenario", "seed", "system"} <= set(header)


def test_each_event_is_in_the_file_at_once(traces, tmp_path: Path) -> None:
    """While the run goes on, another reader sees everything up to now."""
    path = tmp_path / "trace.jsonl"
    trace = traces.right()
    with TraceWriter(path, trace) as record:
        for count, event in enumerate(trace.events, start=1):
            record(event)
            seen = read_trace(path)
            assert len(seen.events) == count
            assert seen.is_whole == (count == len(trace.events))


def test_a_run_that_fails_leaves_a_readable_file(traces, tmp_path: Path) -> None:
    """What happened before an error is kept, without the closing event."""
    path = tmp_path / "trace.jsonl"
    trace = traces.right()
    with pytest.raises(KeyboardInterrupt), TraceWriter(path, trace) as record:
        record(trace.events[0])
        raise KeyboardInterrupt
    seen = read_trace(path)
    assert len(seen.events) == 1
    assert not seen.is_whole


@pytest.mark.parametrize("kept", [1, 5, 20, -1])
def test_a_cut_file_is_read_to_its_last_full_line(traces, kept: int) -> None:
    """Wherever the last line breaks off, all lines before it are there."""
    lines = lines_of(traces.right())
    line = lines[9]
    trace = parse_trace([*lines[:9], line[:kept]])
    assert len(trace.events) == 8 + (kept == -1)  # without its line end a line is still whole
    assert not trace.is_whole


def test_a_file_cut_within_its_last_line_is_not_whole(traces) -> None:
    """The closing event counts only if all of it is there."""
    *lines, last = lines_of(traces.right())
    assert parse_trace([*lines, last]).is_whole
    assert not parse_trace([*lines, last[:-3]]).is_whole


def test_a_character_cut_in_two_is_a_cut_line(traces) -> None:
    """A file may end within a letter of several bytes."""
    lines = lines_of(traces.right())
    event = '{"event": "order", "t": 99.0, "order": "Süd"}'.encode()
    assert len(parse_trace([*lines[:3], event[: event.index(b"\xc3") + 1]]).events) == 2


def test_a_broken_line_in_the_middle_is_named(traces) -> None:
    """Nothing is passed over in silence: line and mend are told."""
    lines = lines_of(traces.right())
    lines[4] = lines[4][:15] + b"\n"
    with pytest.raises(FormatError, match=r"t\.jsonl, line 5: .*restore the file") as caught:
        parse_trace(lines, "t.jsonl")
    assert caught.value.mend


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ('{"t": 1.0}', "line 2: event"),
        ('{"event": "energy", "robot": "a", "level": 1.0}', "line 2: t"),
        ('{"event": "energy", "t": -1.0, "robot": "a", "level": 1.0}', "line 2: t"),
        ('{"event": "energy", "t": 1.0, "robot": "z", "level": 1.0}', "line 2: robot"),
        ('{"event": "energy", "t": 1.0, "robot": "a", "level": "full"}', "line 2: level"),
        ('{"event": "order", "t": 1.0, "order": "o", "state": "lost"}', "line 2: state"),
        ('{"event": "visit", "t": 1.0, "robot": "a", "state": "arrived"}', "line 2: pose"),
        ('{"event": "wait", "t": 1.0, "robot": "a", "for": "b"}', "line 2: for"),
        ('{"event": "load", "t": 1.0, "robot": "a", "objects": [1]}', r"line 2: objects\[0\]"),
        ('{"event": "fault", "t": 1, "kind": "k", "state": "closed", "zone": "z"}', "polygon"),
        ('{"event": "decision", "t": 1.0}', "line 2: kind"),
        ('{"event": "end", "t": 1.0, "status": "fine"}', "line 2: status"),
        ('{"event": "motion", "robot": "a", "t": [], "x": [], "y": [], "theta": []}', "line 2: t"),
        ('{"event": "motion", "robot": "a", "t": [0], "x": [], "y": [0], "theta": [0]}', "2: x"),
        ('{"event": "motion", "robot": "a", "t": [NaN], "x": [0], "y": [0], "theta": [0]}', "t"),
    ],
)
def test_a_malformed_event_is_named_by_line_and_key(traces, line: str, place: str) -> None:
    """Each kind of event has its keys; what is missing or of the wrong type is told."""
    first, *rest = lines_of(traces.right())
    with pytest.raises(FormatError, match=place):
        parse_trace([first, line.encode() + b"\n", *rest])


def test_events_of_a_kind_not_known_are_kept(traces) -> None:
    """The format may grow: what we do not know we hand on."""
    first, *rest = lines_of(traces.right())
    trace = parse_trace([first, b'{"event": "weather", "t": 0.0, "rain": true}\n', *rest])
    assert trace.of("weather") == ({"event": "weather", "t": 0.0, "rain": True},)


def test_a_file_that_is_no_trace_is_refused(tmp_path: Path) -> None:
    """A plan, an empty file and a missing one are told apart from traces."""
    with pytest.raises(FormatError, match=r"format: not a trace file.*clearway\.trace/1"):
        parse_trace([b'{"event": "header", "format": "clearway.plan/1"}\n'])
    with pytest.raises(FormatError, match="line 1"):
        parse_trace([])
    with pytest.raises(FormatError, match="cannot be read"):
        read_trace(tmp_path / "nothing.jsonl")


def test_traces_are_known_by_name_or_by_their_first_line(traces, tmp_path: Path) -> None:
    """Whoever gives a file need not say which kind it is."""
    renamed = tmp_path / "kept.json"
    renamed.write_bytes(b"".join(lines_of(traces.right())))
    plan = tmp_path / "plan.json"
    plan.write_text('{\n"format": "clearway.plan/1"}')
    assert is_trace(tmp_path / "trace.jsonl")
    assert is_trace(renamed)
    assert not is_trace(plan)


def test_what_a_trace_cannot_hold_is_refused_before_it_is_written(traces, tmp_path: Path) -> None:
    """An event that cannot be written leaves the file as it was."""
    path = tmp_path / "trace.jsonl"
    motion = {"event": "motion", "robot": "a", "t": [0.0], "x": [0.0], "y": [0.0]}
    with TraceWriter(path, traces.right()) as record:
        for event in (
            {"event": "energy", "t": 1.0, "robot": "a", "level": math.nan},
            {"event": "energy", "t": 1.0, "robot": "a", "level": object()},
            {**motion, "theta": [math.inf]},
            {**motion, "theta": [0.0, 1.0]},
        ):
            with pytest.raises(FormatError, match=r"motion|energy"):
                record(event)
    assert read_trace(path).events == ()


def test_samples_are_rounded_to_micrometres(traces, tmp_path: Path) -> None:
    """Arrays are written to 1e-6, without minus zeros; NumPy numbers are plain numbers."""
    path = tmp_path / "trace.jsonl"
    with TraceWriter(path, traces.right()) as record:
        x = np.array([1.0 / 3.0, -1e-9])
        record({"event": "motion", "robot": "a", "t": (0, 0.1), "x": x, "y": x, "theta": x})
        record(
            {"event": "load", "t": np.float64(0.5), "robot": "a", "objects": [], "n": np.int64(3)}
        )
    _, motion, load = path.read_text().splitlines()
    samples = '"x": [0.333333, 0.0], "y": [0.333333, 0.0], "theta": [0.333333, 0.0]'
    assert motion == f'{{"event": "motion", "robot": "a", "t": [0.0, 0.1], {samples}}}'
    assert load == '{"event": "load", "t": 0.5, "robot": "a", "objects": [], "n": 3}'


def test_runs_that_differ_in_cpu_time_only_are_equal_without_it(traces) -> None:
    """What a decision took is left out; everything else is compared to the byte."""
    trace = traces.right()
    slower = traces.with_events(
        trace, *({**e, "cpu_s": 9.0} if "cpu_s" in e else e for e in trace.events)
    )
    other = traces.right(distance=32.5)
    text = dump_trace(trace)
    assert dump_trace(slower) != text
    assert without_timings(dump_trace(slower).splitlines()) == without_timings(text.splitlines())
    assert without_timings(dump_trace(other).splitlines()) != without_timings(text.splitlines())
