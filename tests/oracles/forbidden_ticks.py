"""Slow, obvious search for pairs of ticks at which two robots are in each other."""

import math

import numpy as np
import shapely

from clearway.execute.course import Course


def samples(commitment, footprint, step):
    """Ticks along a motion, no point of the body moving more than ``step`` (m) between two.

    Returns the ticks, and the bodies at them as polygons; a stand is sampled at both its ends.
    """
    radius = footprint.circumradius
    ticks = [0]
    for stretch in Course(commitment.trajectory).stretches[:-1]:
        count = 1
        if stretch.piece is not None:
            a, b, c = stretch.piece.twist
            count = max(1, math.ceil((math.hypot(a, b) + abs(c) * radius) / step))
        ticks += [stretch.begin + stretch.duration * k // count for k in range(1, count + 1)]
    ticks = sorted(set(ticks))
    return np.array(ticks), np.array([placed(commitment.trajectory, footprint, t) for t in ticks])


def placed(trajectory, footprint, tick):
    """The body at a tick, looked up piece by piece."""
    pose = trajectory.start
    for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
        if tick >= begin:
            pose = piece.at(min(1.0, (tick - begin) / (end - begin)))
    if footprint.radius:
        return shapely.Point(pose.x, pose.y).buffer(footprint.radius)
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    parts = [
        shapely.Polygon([(pose.x + c * x - s * y, pose.y + s * x + c * y) for x, y in part])
        for part in footprint.parts
    ]
    return shapely.union_all(parts)


def touching(one, other, shapes, step=0.05, depth=2e-3):
    """Pairs of sampled ticks, shape ``(num_pairs, 2)``, at which bodies are in each other.

    ``shapes`` are both footprints. Bodies are eroded by ``depth`` (m) in all, so what is
    found is no rounding.
    """
    ticks_a, bodies_a = samples(one, shapes[0], step)
    ticks_b, bodies_b = samples(other, shapes[1], step)
    eroded = shapely.buffer(bodies_a, -depth, join_style="mitre")
    pairs = shapely.STRtree(eroded).query(bodies_b, predicate="intersects")
    return np.column_stack([ticks_a[pairs[1]], ticks_b[pairs[0]]])


def allowed(ticks, first, second):
    """Which pairs of ticks precedences let happen: none is beyond what it must wait for.

    A robot at its tick ``at`` itself has not gone beyond it.
    """
    free = np.ones(len(ticks), dtype=bool)
    for step in first:
        free &= (ticks[:, 0] <= step.at) | (ticks[:, 1] >= step.passed)
    for step in second:
        free &= (ticks[:, 1] <= step.at) | (ticks[:, 0] >= step.passed)
    return ticks[free]
