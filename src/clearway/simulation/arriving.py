"""The joint to where orders come from."""

from collections.abc import Sequence
from typing import Protocol

from clearway.model import Order


class Arriving(Protocol):
    """Orders in the order of their arrival."""

    def next_tick(self) -> int | None:
        """Return when the next one comes, if one does."""
        ...

    def pop(self, now: int) -> Sequence[Order]:
        """Return those that have come by now."""
        ...

    def taken(self, order: str, now: int) -> None:
        """Learn that an order has been taken up."""
        ...

    @property
    def exhausted(self) -> bool:
        """Whether none comes any more."""
        ...
