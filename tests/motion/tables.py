"""What holds for every motion model: limits, headings, and curves that end at their goals."""

import math

import numpy as np
from tests.motion.wheels import apart

from clearway import _core
from clearway.model import Limits, Piece, Pose, to_seconds
from clearway.motion import MotionModel
from clearway.motion.native import native_table

STARTS = [Pose(0.0, 0.0, 0.0), Pose(-4.0, 7.0, 2.5)]


def length_of(motion) -> float:
    """Length of a motion's way (m)."""
    return math.hypot(*motion.twist[:2])


def check_limits(model: MotionModel, limits: Limits) -> None:
    """Each motion, and each step of 200 random curves, keeps the limits given."""
    moves = [(motion.twist, motion.duration) for motion in model.motions]
    for start, goal in zip(random_poses(200, 6), random_poses(200, 7), strict=True):
        moves += [(piece.twist, seconds) for piece, seconds in connect(model, start, goal)]
    for (a, b, c), seconds in moves:
        length = math.hypot(a, b)
        assert length <= limits.speed * seconds + 1e-9
        # The part that goes backwards.
        assert -a <= limits.speed_backwards * seconds + 1e-9
        if limits.yaw_rate is not None:
            assert abs(c) <= limits.yaw_rate * seconds + 1e-9
        if limits.turning_radius is not None:
            assert abs(c) * limits.turning_radius <= length + 1e-9


def check_curves(model: MotionModel, all_reached: bool = True) -> None:
    """From anywhere to anywhere within 12 m, in the model's own modes, whatever is minimised."""
    for time in (True, False):
        reached = 0
        for start, goal in zip(random_poses(200, 2), random_poses(200, 3), strict=True):
            pieces = connect(model, start, goal, time)
            if pieces:
                reached += 1
                assert apart(pieces[-1][0].end, goal) < 1e-6
        assert reached == 200 or not all_reached
        assert reached > 50


def connect(model: MotionModel, start: Pose, goal: Pose, time: bool = True):
    """Steps of the best curve as pieces with their durations (s)."""
    objective = _core.Objective()
    objective.time = time
    names = [mode.name for mode in model.modes]
    steps = _core.connect(native_table(model), objective, _core.Pose(*start), _core.Pose(*goal))
    pieces, at = [], start
    for step in steps:
        twist = (step.twist.a, step.twist.b, step.twist.c)
        pieces.append((Piece(len(pieces), names[step.mode], at, twist), to_seconds(step.duration)))
        at = pieces[-1][0].end
    return pieces


def random_poses(count, seed, reach=12.0):
    rng = np.random.default_rng(seed)
    for row in rng.uniform(-1.0, 1.0, (count, 3)):
        yield Pose(reach * row[0], reach * row[1], math.pi * row[2])
