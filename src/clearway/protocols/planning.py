"""The joint between a planning problem and the algorithms that solve it."""

from dataclasses import dataclass, replace
from typing import Protocol

from clearway.model import Plan, Problem


class Progress(Protocol):
    """Called now and then while planning."""

    def __call__(
        self,
        planned: int,
        total: int,
        expansions: int,
        sum_of_costs: float | None = None,
        lower_bound: float | None = None,
    ) -> None:
        """Tell robots planned, robots in all and the expansions so far.

        Once all are planned, ``sum_of_costs`` (s) is that of the best plan so far.
        """


@dataclass(frozen=True)
class Budget:
    """How much effort a search may spend: seconds, expansions; ``None`` is unlimited.

    Results repeat exactly for a budget of expansions; seconds are only a stop. Once it has a
    plan, a planner may go on to improve it with what is left, unless ``improve`` is false.
    """

    seconds: float | None = None
    expansions: int | None = None
    improve: bool = True

    def __post_init__(self) -> None:
        if self.seconds is not None and not self.seconds > 0.0:
            raise ValueError(f"a budget of seconds must be above 0, got {self.seconds}")
        if self.expansions is not None and self.expansions < 0:
            raise ValueError(f"a budget of expansions must be 0 or above, got {self.expansions}")

    @property
    def is_unlimited(self) -> bool:
        """Whether nothing ends a search but its own end."""
        return self.seconds is None and self.expansions is None

    @property
    def first_plan(self) -> "Budget":
        """The same effort at most, for a first plan only."""
        return replace(self, improve=False)

    def share(self, part: float) -> "Budget":
        """Return that part, in [0, 1], of the effort."""
        return Budget(
            None if self.seconds is None else part * self.seconds,
            None if self.expansions is None else round(part * self.expansions),
            self.improve,
        )

    def spent(self, parts: float, expansions: int) -> float:
        """Return which part is spent by plans that got these parts and expanded so many states.

        Expansions are known; of seconds, which nobody counts, whole parts are spent.
        """
        if self.seconds is not None:
            return parts
        if self.expansions is not None:
            return min(1.0, expansions / max(self.expansions, 1))
        return 0.0


class Planner(Protocol):
    """Moves a team through its tours without conflict, each visit at its time.

    The tasks that visits wait for (``after``) are not the planner's business: `plan_in_order`
    of the coordinator makes times of them.
    """

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
