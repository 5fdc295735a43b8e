"""Which steps of a track are rest, turning on the spot, or driving."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clearway.model import PlanRecord, Robot, Track

Floats = NDArray[np.float64]

REST = 0
TURN = 1
DRIVE = 2

# Below this, in metres and in radians, a step is rest (plan.json's promise).
REST_STEP = 5e-6
# A turn about a point this near to the reference point (m) is a turn on the spot.
SPOT = 5e-3


class Run(NamedTuple):
    """Neighbouring steps of one kind: from sample ``first`` to sample ``last``."""

    kind: int
    first: int
    last: int


def track_of(record: PlanRecord, robot: Robot) -> Track:
    """Return the robot's track; a robot without one stands at its start."""
    if robot.id in record.tracks:
        return record.tracks[robot.id]
    x, y, theta = (np.array([value]) for value in robot.start)
    return Track(np.zeros(1), x, y, theta, (robot.start_mode,))


def step_lengths(track: Track) -> Floats:
    """Return how far the reference point goes in each step, 0 at rest; shape ``(num_steps,)``."""
    length = np.hypot(np.diff(track.x), np.diff(track.y))
    return np.where(length < REST_STEP, 0.0, length)


def step_turns(track: Track) -> Floats:
    """Return how far each step turns, the short way (rad); shape ``(num_steps,)``."""
    turn = np.diff(track.theta)
    return np.asarray(turn - 2.0 * np.pi * np.round(turn / (2.0 * np.pi)))


def step_kinds(track: Track) -> NDArray[np.int8]:
    """Return ``REST``, ``TURN`` or ``DRIVE`` for each step; shape ``(num_steps,)``."""
    length = step_lengths(track)
    turn = np.abs(step_turns(track))
    on_the_spot = (turn >= REST_STEP) & (length <= SPOT * turn)
    kinds = np.where(on_the_spot, TURN, np.where(length > 0.0, DRIVE, REST))
    return kinds.astype(np.int8)


def arrival_sample(track: Track) -> int:
    """Return the first sample of the final rest."""
    moving = np.flatnonzero(step_kinds(track))
    return int(moving[-1]) + 1 if moving.size else 0


def runs(track: Track) -> list[Run]:
    """Return the runs of equal kind up to the final rest, which is left out."""
    kinds = step_kinds(track)[: arrival_sample(track)]
    if not kinds.size:
        return []
    cuts = np.flatnonzero(np.diff(kinds)) + 1
    firsts = [0, *cuts.tolist()]
    lasts = [*cuts.tolist(), len(kinds)]
    return [Run(int(kinds[a]), a, b) for a, b in zip(firsts, lasts, strict=True)]
