"""A small event kernel: what is to happen, by tick, in a repeatable order."""

import heapq
from itertools import count
from typing import Generic, TypeVar

Item = TypeVar("Item")


class Kernel(Generic[Item]):
    """Things that are to happen; those of one tick happen in the order in which they were given."""

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Item]] = []
        self._count = count()

    def at(self, tick: int, item: Item) -> None:
        """Let something happen at a tick."""
        heapq.heappush(self._heap, (tick, next(self._count), item))

    def next_tick(self) -> int | None:
        """Return when something happens next."""
        return self._heap[0][0] if self._heap else None

    def first(self) -> Item | None:
        """Return what happens next, if anything does."""
        return self._heap[0][2] if self._heap else None

    def pop(self, now: int) -> Item | None:
        """Return the next thing that happens up to tick ``now``, or nothing."""
        if self._heap and self._heap[0][0] <= now:
            return heapq.heappop(self._heap)[2]
        return None
