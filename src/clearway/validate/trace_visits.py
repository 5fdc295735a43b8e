"""Whether robots stand where their visits say, for as long as they say."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from clearway.model import Pose, Trace, Track
from clearway.validate.steps import wrapped
from clearway.validate.violation import Violation
from clearway.validate.visits import HEADING, POSITION, TIME


def judge_stays(trace: Trace, tracks: dict[str, Track], end: float) -> list[Violation]:
    """Return visits away from their pose, too short, or without beginning or end.

    A visit that is still going on when the trace ends (at ``end``, s) is judged up to there.
    """
    found: list[Violation] = []
    open_visits: dict[str, Mapping[str, Any]] = {}

    def wrong(kind: str, event: Mapping[str, Any], text: str) -> None:
        where = event.get("pose") or (0.0, 0.0)
        place = (float(where[0]), float(where[1]))
        t = float(event["t"])
        found.append(Violation(kind, (event["robot"],), t, place, None, text))

    for event in trace.of("visit"):
        robot = event["robot"]
        if event["state"] == "arrived":
            if robot in open_visits:
                wrong("visit", event, "it arrives though it has not left its visit before")
            open_visits[robot] = event
            continue
        if robot not in open_visits:
            wrong("visit", event, "it leaves a visit at which it has not arrived")
            continue
        arrived = open_visits.pop(robot)
        stay = float(event["t"]) - float(arrived["t"])
        if stay < arrived["service"] - TIME:
            wrong("service", arrived, f"it stays {stay:.3f} s of {arrived['service']:.3f} s")
        found += _away(tracks[robot], arrived, float(event["t"]))
    for robot, arrived in open_visits.items():
        found += _away(tracks[robot], arrived, end)
        ending = trace.of("end")
        if ending and ending[-1]["status"] == "done":
            wrong("visit", arrived, "all is done, but it has not left this visit")
    return found


def _away(track: Track, arrived: Mapping[str, Any], left: float) -> list[Violation]:
    """Return whether the robot is off the pose at any time up to ``left``.

    Between samples all is linear, so it is farthest at one of them or at an end.
    """
    pose, begin = Pose(*arrived["pose"]), float(arrived["t"])
    first, last = np.searchsorted(track.t, [begin, left])
    moments = np.concatenate([[begin], track.t[first:last], [max(begin, left)]])
    near = slice(max(int(first) - 1, 0), int(last) + 1)
    heading = np.unwrap(track.theta[near])
    x, y, theta = (
        np.interp(moments, track.t[near], c) for c in (track.x[near], track.y[near], heading)
    )
    away = np.hypot(x - pose.x, y - pose.y)
    turn = np.abs(wrapped(theta - pose.theta))
    over = np.maximum(away / POSITION, turn / HEADING)
    worst = int(over.argmax())
    if over[worst] <= 1.0 + 1e-6:
        return []
    text = (
        f"at a visit it is {away[worst] * 1e3:.1f} mm and {np.degrees(turn[worst]):.2f} degrees "
        "off the pose, more than 10 mm or 1 degree"
    )
    moment, place = float(moments[worst]), (float(x[worst]), float(y[worst]))
    return [Violation("visit", (arrived["robot"],), moment, place, None, text)]
