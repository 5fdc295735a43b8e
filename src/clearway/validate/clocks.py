"""Whether samples are what a plan promises, whatever the robot."""

import numpy as np

from clearway.model import Robot, RobotType, Track
from clearway.validate.episodes import tell
from clearway.validate.steps import REST_STEP, moves, wrapped
from clearway.validate.violation import Violation

LONGEST_STEP = 0.1
START_POSITION = 1e-3
START_HEADING = 1e-3
# Beyond this (m, rad, s) the digits of a float no longer tell micrometres apart.
LARGEST_FIGURE = 1e8
# Times may be stored to 1e-6 s.
TIME_GRAIN = 2e-6


def judge_clock(robot: Robot, track: Track) -> list[Violation]:
    """Return what makes a track unreadable: times and numbers that are none."""
    arrays = (track.t, track.x, track.y, track.theta)
    place = (robot.start.x, robot.start.y)
    if not all((np.abs(array) <= LARGEST_FIGURE).all() for array in arrays):
        text = f"a sample holds a figure that is not finite or above {LARGEST_FIGURE:.0e}"
        return [Violation("clock", (robot.id,), 0.0, place, None, text)]
    if track.t[0] != 0.0:
        text = f"time starts at {track.t[0]:.6f} s, not at 0"
        return [Violation("clock", (robot.id,), float(track.t[0]), place, None, text)]
    falls = np.diff(track.t)
    return tell(
        "clock",
        robot.id,
        track,
        falls < 0.0,
        -falls,
        lambda i: f"time falls from {track.t[i]:.6f} s to {track.t[i + 1]:.6f} s",
    )


def judge_samples(robot: Robot, kind: RobotType, track: Track) -> list[Violation]:
    """Return steps too long in time or in turn, poses that jump, and a wrong start."""
    dt = np.diff(track.t)
    turn = np.abs(wrapped(np.diff(track.theta)))
    away = np.hypot(np.diff(track.x), np.diff(track.y))
    moving = moves(track)
    held = dt == 0.0
    leap = away >= REST_STEP
    if kind.limits.yaw_rate is not None:
        leap |= turn >= REST_STEP
    return [
        *_start(robot, track),
        *tell(
            "step",
            robot.id,
            track,
            moving & (dt > LONGEST_STEP + TIME_GRAIN),
            dt,
            lambda i: f"a moving step lasts {dt[i]:.6f} s, more than {LONGEST_STEP} s",
        ),
        *tell(
            "turn",
            robot.id,
            track,
            ~held & (turn >= np.pi - 1e-9),
            turn,
            lambda i: f"a step turns by {turn[i]:.6f} rad, not less than pi",
        ),
        *tell(
            "jump",
            robot.id,
            track,
            held & leap,
            away + turn,
            lambda i: f"two poses at one time, {away[i]:.6f} m and {turn[i]:.6f} rad apart",
        ),
    ]


def _start(robot: Robot, track: Track) -> list[Violation]:
    x, y, theta = float(track.x[0]), float(track.y[0]), float(track.theta[0])
    away = float(np.hypot(x - robot.start.x, y - robot.start.y))
    turn = abs(float(wrapped(np.array([theta - robot.start.theta]))[0]))
    if away <= START_POSITION + 1e-9 and turn <= START_HEADING + 1e-9:
        return []
    text = f"it begins {away * 1e3:.1f} mm and {turn * 1e3:.1f} mrad from its start"
    return [Violation("start", (robot.id,), 0.0, (x, y), None, text)]
