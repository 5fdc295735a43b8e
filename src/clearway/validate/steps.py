"""A track as steps between samples, each linear in time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.model import PlanRecord, Robot, Track

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]
Bools = NDArray[np.bool_]

# Below this, in metres and in radians, a step is rest (plan.json's promise).
REST_STEP = 5e-6


def track_of(record: PlanRecord, robot: Robot) -> Track:
    """Return the robot's track; a robot without one stands at its start."""
    if robot.id in record.tracks:
        return record.tracks[robot.id]
    x, y, theta = (np.array([value]) for value in robot.start)
    return Track(np.zeros(1), x, y, theta, (None,))


def wrapped(angle: Floats) -> Floats:
    """Wrap angles (rad) into [-pi, pi]."""
    return np.asarray(angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)))


def moves(track: Track) -> Bools:
    """Return for each step whether it is more than rest; shape ``(num_samples - 1,)``."""
    largest = np.maximum(np.abs(np.diff(track.x)), np.abs(np.diff(track.y)))
    return np.asarray(np.maximum(largest, np.abs(wrapped(np.diff(track.theta)))) >= REST_STEP)


def last_arrival(track: Track) -> float:
    """Return the time (s) of the first sample of the final rest."""
    moving = np.flatnonzero(moves(track))
    return float(track.t[moving[-1] + 1]) if len(moving) else 0.0


@dataclass(frozen=True, eq=False)
class Steps:
    """Motion from ``pose`` by ``change``, evenly from ``t0`` to ``t1``; heading is not wrapped.

    Parameters
    ----------
    t0, t1
        Shape ``(num_steps,)``, s; every step lasts, and one follows on the other.
    pose, change
        Shape ``(num_steps, 3)``, m, m, rad.
    loaded
        Shape ``(num_steps,)``.
    """

    t0: Floats
    t1: Floats
    pose: Floats
    change: Floats
    loaded: Bools

    @classmethod
    def from_track(
        cls, track: Track, horizon: float, loads: tuple[tuple[float, bool], ...] = ()
    ) -> "Steps":
        """Return the steps of a track that then stands until ``horizon`` (s).

        ``loads`` are moments (s) at which the robot gets (``True``) or loses its load.
        """
        pose = np.column_stack([track.x, track.y, track.theta])
        change = np.diff(pose, axis=0)
        change[:, 2] = wrapped(change[:, 2])
        lasts = np.diff(track.t) > 0.0
        t0 = np.append(track.t[:-1][lasts], track.t[-1])
        t1 = np.append(track.t[1:][lasts], max(horizon, float(track.t[-1]) + 1.0))
        pose = np.vstack([pose[:-1][lasts], pose[-1:]])
        change = np.vstack([change[lasts], np.zeros((1, 3))])
        steps = cls(t0, t1, pose, change, np.zeros(len(t0), dtype=bool))
        if not loads:
            return steps
        cut = steps.cut(np.array([time for time, _ in loads]))
        for time, loaded in loads:
            cut.loaded[cut.t0 >= time - 1e-9] = loaded
        return cut

    def cut(self, times: Floats) -> "Steps":
        """Return the same motion with steps that also begin at ``times`` (s)."""
        inside = times[(times > self.t0[0]) & (times < self.t1[-1])]
        grid = np.unique(np.concatenate([self.t0, self.t1[-1:], inside]))
        return self.over(grid[:-1], grid[1:])

    def over(self, low: Floats, high: Floats) -> "Steps":
        """Return the motion over intervals (s), each of which lies within one step."""
        index = np.searchsorted(self.t0, 0.5 * (low + high), side="right") - 1
        duration = self.t1[index] - self.t0[index]
        first = ((low - self.t0[index]) / duration)[:, None]
        share = ((high - low) / duration)[:, None]
        change = self.change[index]
        return Steps(
            low, high, self.pose[index] + first * change, share * change, self.loaded[index]
        )

    def pick(self, index: Ints | Bools) -> "Steps":
        """Return some of the steps."""
        return Steps(
            self.t0[index], self.t1[index], self.pose[index], self.change[index], self.loaded[index]
        )

    def where_loaded(self, loaded: float, empty: float) -> Floats:
        """Return one of two figures for each step, by whether the robot is loaded in it."""
        return np.where(self.loaded, loaded, empty)

    def __len__(self) -> int:
        """Return the number of steps."""
        return len(self.t0)
