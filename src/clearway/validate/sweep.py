"""Proof of how near two moving convex parts come, in continuous time.

Along a fixed direction the gap between two convex parts is at most their distance, and at
least minus their overlap depth. While both move linearly and turn by little, that gap stays
above the lesser of its values at the two ends, but for the bend of the corners' paths,
which is at most reach * turn^2 / 8. Where that does not settle a step, its halves are asked.
"""

from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from clearway.validate.shapes import Part
from clearway.validate.steps import Bools, Floats, Ints, Steps

# Overlaps are told apart from the tolerance down to this depth (m).
RESOLUTION = 1e-6
MAX_HALVINGS = 28
BATCH = 8192


@dataclass(frozen=True, eq=False)
class Side:
    """One of the two parts in each of many encounters.

    Parameters
    ----------
    points, normals
        Shapes ``(n, num_points, 2)`` and ``(n, num_normals, 2)``, in the part's frame;
        first length 1 where it is the same in all encounters.
    radius, reach
        Shape ``(n,)``, m; ``reach`` is how far the points are from the frame's origin.
    pose, change
        Shape ``(n, 3)``: the frame's pose where the encounter begins, and how it changes.
    """

    points: Floats
    normals: Floats
    radius: Floats
    reach: Floats
    pose: Floats
    change: Floats

    @classmethod
    def moving(cls, part: Part, steps: Steps) -> "Side":
        """Return a part that is carried along ``steps``."""
        n = len(steps)
        return cls(
            np.broadcast_to(part.points, (n, *part.points.shape)),
            np.broadcast_to(part.normals, (n, *part.normals.shape)),
            np.full(n, part.radius),
            np.full(n, part.reach - part.radius),
            steps.pose,
            steps.change,
        )

    @classmethod
    def fixed(cls, parts: list[Part], index: Ints) -> "Side":
        """Return parts that stand, ``parts[index[i]]`` in encounter i; all have equal shapes."""
        n = len(index)
        return cls(
            np.array([part.points for part in parts])[index],
            np.array([part.normals for part in parts])[index],
            np.array([part.radius for part in parts])[index],
            np.zeros(n),
            np.zeros((n, 3)),
            np.zeros((n, 3)),
        )

    def pick(self, index: Ints | Bools) -> "Side":
        """Return some of the encounters."""
        return Side(
            self.points[index],
            self.normals[index],
            self.radius[index],
            self.reach[index],
            self.pose[index],
            self.change[index],
        )

    def within(self, first: Floats, last: Floats) -> "Side":
        """Return the encounters from share ``first`` to share ``last`` of their time."""
        return replace(
            self,
            pose=self.pose + first[:, None] * self.change,
            change=(last - first)[:, None] * self.change,
        )

    def corners(self, share: float) -> Floats:
        """Return the points in the world at a share of the time."""
        pose = self.pose + share * self.change
        return _turned(self.points, pose[:, 2]) + pose[:, None, :2]

    def axes(self, share: float) -> Floats:
        """Return the normals in the world at a share of the time."""
        return _turned(self.normals, self.pose[:, 2] + share * self.change[:, 2])

    def outline(self, index: int, share: float) -> shapely.Polygon:
        """Return one part in the world as a Shapely polygon."""
        points = self.pick(np.array([index])).corners(share)[0]
        return Part(points, float(self.radius[index])).outline


def _turned(vectors: Floats, angle: Floats) -> Floats:
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def _directions(a: Side, b: Side, share: float) -> Floats:
    """Return directions from a to b among which the widest gap is, shape ``(n, m, 2)``."""
    found = [a.axes(share), -b.axes(share)]
    if a.radius.any() or b.radius.any():
        between = b.corners(share)[:, None, :, :] - a.corners(share)[:, :, None, :]
        between = between.reshape(len(between), -1, 2)
        length = np.hypot(between[..., 0], between[..., 1])[..., None]
        found.append(np.where(length > 1e-12, between / np.maximum(length, 1e-12), [1.0, 0.0]))
    return np.concatenate(found, axis=1)


def _gaps(directions: Floats, a: Floats, b: Floats) -> Floats:
    """Return the gap along each direction, shape ``(n, m)``; negative where they overlap."""
    u, v = directions[..., 0:1], directions[..., 1:2]
    near = (u * b[:, None, :, 0] + v * b[:, None, :, 1]).min(axis=2)
    far = (u * a[:, None, :, 0] + v * a[:, None, :, 1]).max(axis=2)
    return np.asarray(near - far)


def least_gap(a: Side, b: Side) -> Floats:
    """Return a lower bound on the signed gap (m) throughout each encounter, shape ``(n,)``."""
    directions = _directions(a, b, 0.5)
    begin = _gaps(directions, a.corners(0.0), b.corners(0.0))
    end = _gaps(directions, a.corners(1.0), b.corners(1.0))
    bend = (a.reach * a.change[:, 2] ** 2 + b.reach * b.change[:, 2] ** 2) / 8.0
    return np.asarray(np.minimum(begin, end).max(axis=1) - a.radius - b.radius - bend)


def gap_at(a: Side, b: Side, share: float) -> Floats:
    """Return the signed gap (m) at a share of the time: minus the depth where they overlap.

    Where they do not overlap it is at most their distance.
    """
    gaps = _gaps(_directions(a, b, share), a.corners(share), b.corners(share))
    return np.asarray(gaps.max(axis=1) - a.radius - b.radius)


def overlapping(a: Side, b: Side, tolerance: Floats) -> Bools:
    """Return which encounters come deeper into each other than ``tolerance`` (m)."""
    found = np.zeros(len(tolerance), dtype=bool)
    for low in range(0, len(tolerance), BATCH):
        batch = np.arange(low, min(low + BATCH, len(tolerance)))
        found[batch] = _overlapping(a.pick(batch), b.pick(batch), tolerance[batch])
    return found


def _overlapping(a: Side, b: Side, tolerance: Floats) -> Bools:
    found = np.zeros(len(tolerance), dtype=bool)
    item = np.arange(len(tolerance))
    first, last = np.zeros(len(item)), np.ones(len(item))
    for _ in range(MAX_HALVINGS):
        part_a = a.pick(item).within(first, last)
        part_b = b.pick(item).within(first, last)
        unsettled = least_gap(part_a, part_b) < -tolerance[item] - RESOLUTION
        part_a, part_b = part_a.pick(unsettled), part_b.pick(unsettled)
        item, first, last = item[unsettled], first[unsettled], last[unsettled]
        if not len(item):
            return found
        deep = gap_at(part_a, part_b, 0.5) < -tolerance[item] - 0.5 * RESOLUTION
        found[item[deep]] = True
        left = ~found[item]
        item, first, last = item[left], first[left], last[left]
        middle = 0.5 * (first + last)
        item = np.concatenate([item, item])
        first, last = np.concatenate([first, middle]), np.concatenate([middle, last])
    found[item] = True
    return found


def deepest(a: Side, b: Side) -> tuple[Floats, Floats]:
    """Return for each encounter the share of its time at which it is deepest, and the depth (m)."""
    centre, width = np.full(len(a.radius), 0.5), 0.5
    depth = np.zeros(len(centre))
    for _ in range(4):
        offsets: NDArray[np.float64] = np.linspace(-width, width, 9)
        shares = np.clip(centre[:, None] + offsets, 0.0, 1.0)
        gaps = np.stack([gap_at(a.within(s, s), b.within(s, s), 0.0) for s in shares.T], axis=1)
        best = gaps.argmin(axis=1)
        rows = np.arange(len(centre))
        centre, depth, width = shares[rows, best], -gaps[rows, best], width / 4.0
    return centre, depth
