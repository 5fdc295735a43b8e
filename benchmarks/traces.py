"""What traces cost: CPU seconds to write, read, judge and tell the figures of long runs.

Square robots of 0.7 m drive to and fro for 2000 s at 1 m/s, in pairs on lanes 0.75 m apart, between
rows of 38 shelves; each piece of motion is 1 m in 10 steps, each trip 30 m and a visit of 5 s.

    python benchmarks/traces.py [ROBOTS ...]
"""

import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from clearway.formats.trace_file import TraceWriter, read_trace
from clearway.metrics import ending, trace_metrics
from clearway.model import Footprint, Limits, Obstacle, Pose, Robot, RobotType, Site, Trace
from clearway.validate import validate_trace

SECONDS, LENGTH, TRIP = 2000.0, 40, 30
CART = RobotType("cart", Footprint.rectangle(0.7, 0.7), "differential", Limits(1.0, yaw_rate=1.5))
Event = dict[str, Any]


def shuttle(robot: Robot) -> Iterator[Event]:
    """Yield what a robot does; order ids are its own with a number."""
    t, x, y, step = 0.0, robot.start.x, robot.start.y, 1.0
    number = 0
    while t + TRIP + 5.0 < SECONDS:
        number += 1
        order = {"order": f"{robot.id}-{number}", "robot": robot.id}
        yield {"event": "order", "t": t, "order": order["order"], "state": "released"}
        choice = {"kind": "robot", "outcome": "committed", "arrive": [t + TRIP], "cpu_s": 0.001}
        yield {"event": "decision", "t": t, **order, "purpose": "order", **choice}
        for state in ("assigned", "started"):
            yield {"event": "order", "t": t, **order, "state": state}
        for _ in range(TRIP):
            if not 0.0 <= x + step <= LENGTH:
                step = -step
            share = np.linspace(0.0, 1.0, 11)
            level = {"y": np.full(11, y), "theta": np.zeros(11)}
            yield {
                "event": "motion",
                "robot": robot.id,
                "t": t + share,
                "x": x + step * share,
                **level,
            }
            t, x = t + 1.0, x + step
        visit = {"event": "visit", **order, "task": order["order"]}
        yield {**visit, "t": t, "state": "arrived", "pose": [x, y, 0.0], "service": 5.0}
        t += 5.0
        yield {**visit, "t": t, "state": "left"}
        yield {"event": "order", "t": t, **order, "state": "done"}


def run(robots: int) -> Trace:
    """Return a right trace."""
    lanes = (robots + 1) // 2
    shelves = tuple(
        Obstacle(polygon=((x, y), (x + 0.9, y), (x + 0.9, y + 0.9), (x, y + 0.9)))
        for x in range(1, LENGTH - 1)
        for y in (3.0 * lane + 1.3 for lane in range(lanes))
    )
    bounds = ((-1.0, -1.0), (LENGTH + 1.0, -1.0), (LENGTH + 1.0, 3.0 * lanes), (-1.0, 3.0 * lanes))
    fleet = tuple(
        Robot(f"r{i}", "cart", Pose(float(7 * i % LENGTH), 3.0 * (i // 2) + 0.75 * (i % 2), 0.0))
        for i in range(robots)
    )
    events = [event for robot in fleet for event in shuttle(robot)]
    events.sort(key=lambda event: float(np.max(event["t"])))
    site = Site(bounds, shelves)
    trace = Trace("traces", "", 0, site, {"cart": CART}, fleet, tuple(events), False, {})
    end = {"event": "end", "t": float(np.max(events[-1]["t"])), "status": "done", **ending(trace)}
    return Trace("traces", "", 0, site, {"cart": CART}, fleet, (*events, end), True, {})


def main() -> None:
    print("| robots | samples | MB | write s | read s | judge s | figures s |")
    print("|---|---|---|---|---|---|---|")
    for robots in [int(word) for word in sys.argv[1:]] or [20, 100]:
        trace = run(robots)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "trace.jsonl"
            clock = [time.process_time()]
            with TraceWriter(path, trace) as record:
                for event in trace.events:
                    record(event)
            clock.append(time.process_time())
            again = read_trace(path)
            clock.append(time.process_time())
            wrong = validate_trace(again)
            clock.append(time.process_time())
            trace_metrics(again)
            clock.append(time.process_time())
            size = path.stat().st_size / 1e6
        if wrong:
            raise SystemExit(f"the trace is wrong: {wrong[0]}")
        samples = sum(len(piece["t"]) for piece in trace.of("motion"))
        taken = " | ".join(f"{seconds:.2f}" for seconds in np.diff(clock))
        print(f"| {robots} | {samples} | {size:.1f} | {taken} |", flush=True)


if __name__ == "__main__":
    main()
