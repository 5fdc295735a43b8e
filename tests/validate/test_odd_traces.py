"""Traces with odd values: refused by name, or judged; never a crash."""

import json

import pytest
from tests.data.bad_traces.make import SPILL, dump_trace, errand_story

from clearway.formats.atomic import FormatError
from clearway.formats.trace_file import parse_trace
from clearway.metrics import ending, trace_metrics, trace_to_json
from clearway.validate import validate_trace

ODD = (None, "x", -1, 1e9, 10**30, True, {}, [], [1], [[0.0, 0.0]])


def lines() -> list[str]:
    """A trace with an event of every kind."""
    story = errand_story()
    story.tell("wait", 0.0, robot="a", **{"for": ["location"]}, until=1.0, because="it is taken")
    story.tell("load", 1.0, robot="a", objects=["S1"])
    story.tell("energy", 1.0, robot="a", level=0.5)
    story.tell("fault", 0.5, kind="obstacle", zone="spill", polygon=SPILL, state="closed")
    return dump_trace(story.trace(status="ended")).splitlines()


KINDS = ("motion", "order", "visit", "wait", "load", "energy", "fault", "decision", "end")


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_may_hold_anything(kind: str) -> None:
    """With any value in any key of an event, backwards, or without the key, there is an answer."""
    text = lines()
    number = next(i for i, line in enumerate(text) if json.loads(line)["event"] == kind)
    event = json.loads(text[number])
    refused = judged = 0
    for key in event:
        changes = [{**event, key: value} for value in ODD]
        changes.append({name: value for name, value in event.items() if name != key})
        if isinstance(event[key], list):
            changes.append({**event, key: event[key][::-1]})
        for change in changes:
            changed = [*text[:number], json.dumps(change), *text[number + 1 :]]
            try:
                trace = parse_trace(f"{line}\n".encode() for line in changed)
            except FormatError as error:
                assert f"line {number + 1}" in str(error)
                refused += 1
                continue
            validate_trace(trace)
            json.dumps([trace_to_json(trace_metrics(trace)), ending(trace)], allow_nan=False)
            judged += 1
    assert refused
    assert judged
