"""Named points, some of them present, found by distance."""

from collections.abc import Callable, Collection, Iterable, Mapping

import numpy as np

from clearway.model import Pose
from clearway.protocols import Alternative


class Nearby:
    """Named points of which those that are present can be asked for by distance.

    Ties go to the point named first.

    Parameters
    ----------
    points
        All that may ever be present, in their order.
    present
        Names of those that are, at first.
    """

    def __init__(self, points: Mapping[str, Pose], present: Iterable[str] = ()) -> None:
        self._names = tuple(points)
        self._number = {name: k for k, name in enumerate(self._names)}
        self._xy = np.array([(p.x, p.y) for p in points.values()], dtype=np.float64).reshape(-1, 2)
        self._mask = np.zeros(len(self._names), dtype=np.bool_)
        self._count = 0
        for name in present:
            self.add(name)

    def __len__(self) -> int:
        return self._count

    def __contains__(self, name: str) -> bool:
        number = self._number.get(name)
        return number is not None and bool(self._mask[number])

    def names(self) -> list[str]:
        """Return who is present, in order."""
        return [self._names[k] for k in np.flatnonzero(self._mask)]

    def add(self, name: str, pose: Pose | None = None) -> None:
        """Let a point be present, at another pose if one is given."""
        number = self._number[name]
        if pose is not None:
            self._xy[number] = pose.x, pose.y
        self._count += not self._mask[number]
        self._mask[number] = True

    def discard(self, name: str) -> None:
        """Let a point be absent."""
        number = self._number[name]
        self._count -= bool(self._mask[number])
        self._mask[number] = False

    def nearest(
        self,
        pose: Pose,
        count: int = 1,
        distance: Callable[[str], float] | None = None,
        without: Collection[str] = (),
    ) -> list[Alternative]:
        """Return the nearest points that are present, nearest first, with their distances (m).

        Parameters
        ----------
        count
            How many at most.
        distance
            Distance of a point (m), never below the Manhattan distance, which holds without it.
        without
            Points that are not asked for.
        """
        numbers = np.flatnonzero(self._mask)
        if without:
            numbers = np.array([k for k in numbers if self._names[k] not in without], np.int64)
        if not len(numbers):
            return []
        far = np.abs(self._xy[numbers] - (pose.x, pose.y)).sum(axis=1)
        if distance is None:
            last = np.partition(far, count - 1)[count - 1] if count < len(far) else np.inf
            some = np.flatnonzero(far <= last)
            order = some[np.argsort(far[some], kind="stable")][:count]
            return [Alternative(self._names[numbers[k]], float(far[k])) for k in order]
        found: list[Alternative] = []
        for k in np.argsort(far, kind="stable"):
            if len(found) >= count and far[k] > found[count - 1].score:
                break  # all others are farther still
            name = self._names[numbers[k]]
            found.append(Alternative(name, distance(name)))
            found.sort(key=lambda one: (one.score, self._number[one.name]))
        return found[:count]
