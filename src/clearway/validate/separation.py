"""How near each two bodies come."""

import numpy as np

from clearway.validate.pairs import Meeting, Timetable
from clearway.validate.steps import Floats
from clearway.validate.sweep import Side, gap_at, least_gap

# Splitting stops where the least gap is known to this (m).
ACCURACY = 1e-3
SPLIT = 6
MAX_SPLITS = 8


def least_separation(
    timetable: Timetable, one: int, other: int, within: float
) -> tuple[float, float] | None:
    """Return the least gap (m, minus the depth where they overlap) and its time (s).

    The gap found is one that occurs, and at most 1 mm above the least; ``None`` where it is
    not below ``within``.
    """
    bounds = timetable.box_gaps(one, other)
    if bounds.min() >= within:
        return None
    first = bounds <= bounds.min()
    best, time = _nearest(timetable.meeting(one, other, first), within, 0.0)
    rest = ~first & (bounds < best - ACCURACY)
    if rest.any():
        best, time = _nearest(timetable.meeting(one, other, rest), best, time)
    return (best, time) if best < within else None


def gaps(meeting: Meeting) -> Floats:
    """Return the exact gap (m) at the beginning of each step; minus the depth of an overlap."""
    found = np.full(len(meeting.a), np.inf)
    for chosen, a, b in meeting.sides():
        found[chosen] = np.minimum(found[chosen], distance(a, b, 0.0))
    return found


def _nearest(meeting: Meeting, best: float, time: float) -> tuple[float, float]:
    """Return the least gap and its time, or those given where they are less."""
    circles = meeting.least_reference_gap
    nearest = (circles <= circles.min()) & (circles < best)
    best, time = _closest(meeting.pick(nearest), best, time)
    return _closest(meeting.pick(circles < best - ACCURACY), best, time)


def _closest(meeting: Meeting, best: float, time: float) -> tuple[float, float]:
    for chosen, a, b in meeting.sides():
        steps = meeting.a.pick(chosen)
        item = np.arange(len(a.radius))
        first, last = np.zeros(len(item)), np.ones(len(item))
        for _ in range(MAX_SPLITS):
            if not len(item):
                break
            part_a, part_b = a.pick(item).within(first, last), b.pick(item).within(first, last)
            gaps = distance(part_a, part_b, 0.5)
            nearest = int(gaps.argmin())
            if gaps[nearest] < best:
                share = 0.5 * (first[nearest] + last[nearest])
                best = float(gaps[nearest])
                duration = steps.t1[item[nearest]] - steps.t0[item[nearest]]
                time = float(steps.t0[item[nearest]] + share * duration)
            lower = np.maximum(least_gap(part_a, part_b), gaps - 0.5 * _travel(part_a, part_b))
            left = lower < best - ACCURACY
            item, first, last = item[left], first[left], last[left]
            item, first = np.repeat(item, SPLIT), np.repeat(first, SPLIT)
            width = np.repeat((last - first[::SPLIT]) / SPLIT, SPLIT)
            first = first + np.tile(np.arange(SPLIT), len(last)) * width
            last = first + width
    return best, time


def _travel(a: Side, b: Side) -> Floats:
    """Return by how much the gap can change in each encounter (m)."""
    change = b.change - a.change
    turns = a.reach * np.abs(a.change[:, 2]) + b.reach * np.abs(b.change[:, 2])
    return np.asarray(np.hypot(change[:, 0], change[:, 1]) + turns)


def distance(a: Side, b: Side, share: float) -> Floats:
    """Return the exact gap (m) at a share of the time; minus the depth where they overlap."""
    gap = gap_at(a, b, share)
    apart = gap > 0.0
    if apart.any():
        corners_a, corners_b = a.pick(apart).corners(share), b.pick(apart).corners(share)
        points = np.minimum(_to_edges(corners_a, corners_b), _to_edges(corners_b, corners_a))
        gap[apart] = np.maximum(gap[apart], points - (a.radius + b.radius)[apart])
    return gap


def _to_edges(points: Floats, outline: Floats) -> Floats:
    """Return the least distance from any point to any edge of the outline, shape ``(n,)``."""
    begin = outline[:, None, :, :]
    edge = np.roll(outline, -1, axis=1)[:, None, :, :] - begin
    offset = points[:, :, None, :] - begin
    square = (edge**2).sum(axis=3)
    share = (offset * edge).sum(axis=3) / np.where(square > 0.0, square, 1.0)
    away = offset - np.clip(share, 0.0, 1.0)[..., None] * edge
    return np.asarray(np.sqrt((away**2).sum(axis=3)).min(axis=(1, 2)))
