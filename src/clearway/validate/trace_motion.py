"""Whether the pieces of motion in a trace are one motion for each robot."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from clearway.model import Pose, Robot, Trace
from clearway.validate.clocks import LARGEST_FIGURE, START_HEADING, START_POSITION, TIME_GRAIN
from clearway.validate.steps import REST_STEP, Bools, Floats, wrapped
from clearway.validate.violation import Violation


def judge_pieces(trace: Trace) -> list[Violation]:
    """Return pieces that begin before the one before ended, or elsewhere."""
    pieces: dict[str, list[Mapping[str, Any]]] = {robot.id: [] for robot in trace.robots}
    for piece in trace.of("motion"):
        pieces[piece["robot"]].append(piece)
    found: list[Violation] = []
    for robot in trace.robots:
        if pieces[robot.id]:
            turns_at_once = trace.robot_types[robot.type].limits.yaw_rate is None
            found += _of_robot(robot, pieces[robot.id], turns_at_once)
    return found


def _of_robot(
    robot: Robot, pieces: list[Mapping[str, Any]], turns_at_once: bool
) -> list[Violation]:
    t, x, y, theta = (
        np.concatenate([p[name] for p in pieces]) for name in ("t", "x", "y", "theta")
    )
    if not all((np.abs(array) <= LARGEST_FIGURE).all() for array in (t, x, y, theta)):
        text = f"a sample holds a figure that is not finite or above {LARGEST_FIGURE:.0e}"
        return [Violation("clock", (robot.id,), 0.0, robot.start[:2], None, text)]
    joint = np.zeros(len(t) - 1, dtype=bool)
    joint[np.cumsum([len(piece["t"]) for piece in pieces])[:-1] - 1] = True
    return [
        *_start(robot, float(t[0]), Pose(float(x[0]), float(y[0]), float(theta[0]))),
        *_falls(robot, joint, t, x, y),
        *_gaps(robot, joint, t, x, y, theta, turns_at_once),
    ]


def _start(robot: Robot, t: float, pose: Pose) -> list[Violation]:
    away = float(np.hypot(pose.x - robot.start.x, pose.y - robot.start.y))
    turn = abs(float(wrapped(np.array([pose.theta - robot.start.theta]))[0]))
    if away <= START_POSITION + 1e-9 and turn <= START_HEADING + 1e-9:
        return []
    text = f"motion begins {away * 1e3:.1f} mm and {turn * 1e3:.1f} mrad from its start"
    return [Violation("start", (robot.id,), t, pose[:2], None, text)]


def _falls(robot: Robot, joint: Bools, t: Floats, x: Floats, y: Floats) -> list[Violation]:
    return [
        Violation(
            "clock",
            (robot.id,),
            float(t[i]),
            (float(x[i]), float(y[i])),
            None,
            f"time falls from {t[i]:.6f} s to {t[i + 1]:.6f} s "
            + ("between two pieces of motion" if joint[i] else "within a piece of motion"),
        )
        for i in np.flatnonzero(np.diff(t) < np.where(joint, -TIME_GRAIN, 0.0))
    ]


def _gaps(
    robot: Robot,
    joint: Bools,
    t: Floats,
    x: Floats,
    y: Floats,
    theta: Floats,
    turns_at_once: bool,
) -> list[Violation]:
    away = np.hypot(np.diff(x), np.diff(y))
    turn = np.abs(wrapped(np.diff(theta)))
    apart = away > REST_STEP
    if not turns_at_once:
        apart |= turn > REST_STEP
    return [
        Violation(
            "gap",
            (robot.id,),
            float(t[i + 1]),
            (float(x[i + 1]), float(y[i + 1])),
            None,
            f"motion goes on {away[i] * 1e3:.3f} mm and {turn[i] * 1e3:.3f} mrad from where the "
            f"piece before ended",
        )
        for i in np.flatnonzero(joint & apart)
    ]
