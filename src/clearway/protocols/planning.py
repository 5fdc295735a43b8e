"""The joint between a planning problem and the algorithms that solve it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from clearway.model import Plan, Problem

Progress = Callable[[int, int, int, float | None, float | None], None]
"""Called now and then with robots planned, robots in all, expansions so far; sum of costs (s) of
the best complete plan, ``None`` before there is one, and its lower bound, ``None`` if unknown."""


@dataclass(frozen=True)
class Budget:
    """How much effort a search may spend: seconds, expansions; ``None`` is unlimited.

    Results repeat exactly for a budget of expansions; seconds are only a stop.
    """

    seconds: float | None = None
    expansions: int | None = None

    def __post_init__(self) -> None:
        if self.seconds is not None and not self.seconds > 0.0:
            raise ValueError(f"a budget of seconds must be above 0, got {self.seconds}")
        if self.expansions is not None and self.expansions < 0:
            raise ValueError(f"a budget of expansions must be 0 or above, got {self.expansions}")


class Planner(Protocol):
    """Moves a team through its tours without conflict."""

    def __call__(
        self,
        problem: Problem,
        budget: Budget,
        seed: int,
        progress: Progress | None = None,
    ) -> Plan:
        """Return a plan; one that is not complete says why and holds what there is."""
        ...

    def unsupported(self, problem: Problem) -> tuple[str, ...]:
        """Return what in the problem this planner cannot take, in words a person can act on."""
        ...
