"""Overlaps found step by step, told as one per time of contact."""

from typing import NamedTuple

import numpy as np
import shapely

from clearway.validate.steps import Ints, Steps
from clearway.validate.sweep import Side, deepest


class Overlap(NamedTuple):
    """The worst moment of an overlap: time (s), place (m) and depth (m)."""

    time: float
    place: tuple[float, float]
    depth: float


class Encounters(NamedTuple):
    """Steps in which two parts overlap, ``owner`` saying whose other part it is."""

    owner: Ints
    steps: Steps
    a: Side
    b: Side


def overlaps(found: list[Encounters]) -> list[tuple[int, float, Overlap]]:
    """Return owner, begin (s) and worst moment of each unbroken time of overlap."""
    records: list[tuple[int, float, float, float, float, int, int]] = []
    for group, encounters in enumerate(found):
        share, depth = deepest(encounters.a, encounters.b)
        steps = encounters.steps
        moment = steps.t0 + share * (steps.t1 - steps.t0)
        for i in range(len(depth)):
            records.append(
                (
                    int(encounters.owner[i]),
                    float(steps.t0[i]),
                    float(steps.t1[i]),
                    float(depth[i]),
                    float(moment[i]),
                    group,
                    i,
                )
            )
    records.sort()
    runs: list[list[tuple[int, float, float, float, float, int, int]]] = []
    end = -np.inf
    for row in records:
        if not runs or runs[-1][0][0] != row[0] or row[1] > end + 1e-9:
            runs.append([])
            end = -np.inf
        runs[-1].append(row)
        end = max(end, row[2])
    return [(run[0][0], run[0][1], _worst(found, max(run, key=lambda r: r[3]))) for run in runs]


def _worst(
    found: list[Encounters], row: tuple[int, float, float, float, float, int, int]
) -> Overlap:
    _, begin, end, depth, moment, group, i = row
    share = (moment - begin) / (end - begin)
    one, other = (side.outline(i, share) for side in (found[group].a, found[group].b))
    common = one.intersection(other)
    centre = shapely.centroid(common if not common.is_empty else one)
    return Overlap(moment, (float(centre.x), float(centre.y)), depth)
