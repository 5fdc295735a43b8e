"""Whether mean speeds of neighbouring windows keep the limits on acceleration."""

import numpy as np

from clearway.model import Robot, RobotType, Track
from clearway.validate.displacement import Displacement
from clearway.validate.episodes import episodes
from clearway.validate.steps import Floats, moves
from clearway.validate.violation import Violation

WINDOW = 0.2
SLACK = 1.15
# What positions stored to 1e-6 m can feign (m/s^2).
GRAIN = 1e-6 * 4.0 / WINDOW**2


def judge_acceleration(
    robot: Robot, kind: RobotType, track: Track, motion: Displacement
) -> list[Violation]:
    """Return where the mean speed changes faster than its limits from one 0.2 s to the next.

    Speeds are along the path for holonomic robots; for all others they have a direction in
    the body frame, so that a car that goes over from driving to reversing must brake.
    """
    limits = kind.limits
    if not limits.has_ramps:
        return []
    # The difference of two means is linear between the moments at which a window's end
    # passes a sample, so that it is greatest at one of them.
    moments = np.unique(np.concatenate([track.t - WINDOW, track.t, track.t + WINDOW]))
    way = _way(robot, kind, track, motion)
    before = (way(moments) - way(moments - WINDOW)) / WINDOW
    after = (way(moments + WINDOW) - way(moments)) / WINDOW
    change = np.hypot(*(after - before).T) / WINDOW
    up = np.inf if limits.acceleration is None else limits.acceleration
    down = np.inf if limits.deceleration is None else limits.deceleration
    gains = np.hypot(*after.T) > np.hypot(*before.T)
    limit = np.where(gains, up, down)
    limit = np.where((before * after).sum(axis=1) < 0.0, max(up, down), limit)
    over = change - SLACK * limit
    return [
        Violation(
            "acceleration" if gains[i] else "deceleration",
            (robot.id,),
            float(max(moments[i], 0.0)),
            (
                float(np.interp(moments[i], track.t, track.x)),
                float(np.interp(moments[i], track.t, track.y)),
            ),
            None,
            f"mean speeds of neighbouring {WINDOW} s differ by {change[i]:.3f} m/s^2, "
            f"limit {limit[i]:.3f} m/s^2",
        )
        for i in episodes(over > GRAIN, over)
    ]


class _Way:
    """The way gone up to a moment in the body frame (m), with what was before the start."""

    def __init__(self, t: Floats, steps: Floats, start_velocity: Floats) -> None:
        self._t = t
        self._sum = np.vstack([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
        self._start_velocity = start_velocity

    def __call__(self, moments: Floats) -> Floats:
        gone = np.column_stack([np.interp(moments, self._t, self._sum[:, k]) for k in (0, 1)])
        return np.asarray(gone + np.minimum(moments, 0.0)[:, None] * self._start_velocity)


def _way(robot: Robot, kind: RobotType, track: Track, motion: Displacement) -> _Way:
    moving = moves(track)[:, None]
    if kind.kinematics == "holonomic":
        steps = np.column_stack([motion.length, np.zeros(len(moving))])
    else:
        steps = np.column_stack([motion.along, motion.across])
    mode = robot.start_mode or ""
    direction = {"lateral-left": (0.0, 1.0), "lateral-right": (0.0, -1.0)}.get(mode, (1.0, 0.0))
    sign = -1.0 if mode.startswith("reverse") and kind.kinematics != "holonomic" else 1.0
    velocity = sign * robot.start_speed * np.array(direction)
    return _Way(track.t, np.where(moving, steps, 0.0), velocity)
