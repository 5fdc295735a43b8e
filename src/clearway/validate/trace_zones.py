"""Bodies against zones that are closed while a trace goes on."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from clearway.model import Polygon, Robot, Site, Trace, Zone
from clearway.validate.statics import Surroundings
from clearway.validate.steps import Steps
from clearway.validate.violation import Violation


class Closure(NamedTuple):
    """A zone that is closed from second ``begin`` to ``end``."""

    name: str
    polygon: Polygon
    begin: float
    end: float


def closures_of(trace: Trace, end: float) -> Iterator[Closure]:
    """Yield what ``fault`` events close; ``end`` (s) for what is never opened again."""
    closed: dict[str, tuple[Polygon, float]] = {}
    for event in trace.of("fault"):
        name, t = event.get("zone"), float(event["t"])
        if name is None or event["state"] not in ("closed", "open"):
            continue
        if name in closed:
            polygon, begin = closed.pop(name)
            yield Closure(name, polygon, begin, t)
        if event["state"] == "closed":
            closed[name] = tuple((float(x), float(y)) for x, y in event["polygon"]), t
    for name, (polygon, begin) in closed.items():
        yield Closure(name, polygon, begin, end)


def judge_closures(
    trace: Trace, steps: dict[str, Steps], end: float, overlap: float
) -> list[Violation]:
    """Return who enters a zone while it is closed; who is in it when it closes may leave."""
    found: list[Violation] = []
    for closure in closures_of(trace, end):
        if closure.end <= closure.begin:
            continue
        zone = Zone(closure.name, "closed", closure.polygon)
        site = Site(trace.site.bounds, zones=(zone,), border="open")
        surroundings = Surroundings(site, overlap, 0.0, 1.0)
        for robot in trace.robots:
            found += _entries(surroundings, trace, robot, steps[robot.id], closure)
    return found


def _entries(
    surroundings: Surroundings, trace: Trace, robot: Robot, steps: Steps, closure: Closure
) -> list[Violation]:
    cut = steps.cut(np.array([closure.begin, closure.end]))
    during = cut.pick((cut.t0 >= closure.begin - 1e-9) & (cut.t1 <= closure.end + 1e-9))
    # Who is inside at second 0 of what is judged may leave.
    shifted = replace(during, t0=during.t0 - closure.begin, t1=during.t1 - closure.begin)
    kind = trace.robot_types[robot.type]
    return [
        replace(violation, time=violation.time + closure.begin)
        for violation in surroundings.judge(robot, kind, shifted)
    ]
