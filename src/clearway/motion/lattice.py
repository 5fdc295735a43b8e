"""Motions whose ends fall onto one grid, so that unlike ways reach exactly the same poses."""

import math
from dataclasses import replace

from clearway.model import RobotType
from clearway.motion.model import Motion, MotionModel

# Quarter turns only: with any finer ones the poses lie everywhere.
LATTICE_HEADINGS = 4
# About how long a straight motion is (m); the radius of arcs is a whole number of them.
STEP = 1.0


def lattice_model(robot_type: RobotType, model: MotionModel, share: float = 1.0) -> MotionModel:
    """Return a model of four headings with its straight motions cut to the lattice's step.

    The step is the turning radius over a whole number, near 1 m (or half the body's length
    where that is less), or ``share`` of that; diagonal motions are longer by the root of two.
    Motions in other directions would leave the lattice and are left out.
    """
    radius = robot_type.limits.turning_radius
    step = share * min(STEP, robot_type.footprint.length / 2.0)
    if radius:
        step = radius / max(1, round(radius / step))
    motions = []
    for motion in model.motions:
        x, y, _ = motion.twist
        length = math.hypot(x, y)
        if motion.turn_steps or not length:
            motions.append(motion)
            continue
        diagonal = abs(abs(x) - abs(y)) < 1e-9 * length
        if min(abs(x), abs(y)) > 1e-9 * length and not diagonal:
            continue
        motions.append(_cut(motion, step * (math.sqrt(2.0) if diagonal else 1.0) / length))
    return replace(model, motions=tuple(dict.fromkeys(motions)))


def _cut(motion: Motion, share: float) -> Motion:
    x, y, _ = motion.twist
    return replace(motion, twist=(x * share, y * share, 0.0), duration=motion.duration * share)
