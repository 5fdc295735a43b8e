"""The assigners and planners that the studies of system A compare: a line each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from clearway.assign import InsertionLocalSearch, InsertionParams, RandomAssigner
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Assigner, Budget, Planner
from clearway.systems import HierarchicalSettings, hierarchical

T_co = TypeVar("T_co", covariant=True)


@dataclass(frozen=True)
class Part(Generic[T_co]):
    """A part to compare: what it is, in words that change when it does, and how it is made."""

    words: str
    make: Callable[[], T_co]


@dataclass(frozen=True)
class Method(Part[Planner]):
    """A planner with the effort that it is given where nobody says otherwise."""

    budget: Budget


NTA, APSGA, OURS = "NTA", "APSGA", "ours"


def _insertion(rounds: int) -> Part[Assigner]:
    return Part(
        f"regret insertion with {rounds} rounds of local search (stands in)",
        lambda: InsertionLocalSearch(InsertionParams(rounds=rounds, even=True)),
    )


ASSIGNERS: Mapping[str, Part[Assigner]] = {
    NTA: Part("random permutation, even split", lambda: RandomAssigner(even=True)),
    "PSO": _insertion(0),
    "GA": _insertion(1),
    "PSGA": _insertion(5),
    APSGA: _insertion(20),
    OURS: _insertion(60),
}


def _prioritised(weight: float) -> Planner:
    return hierarchical(HierarchicalSettings(objective="paper", weight=weight)).plan


# Plans of the assignment studies; all of them come from this planner.
PLANNER: Part[Planner] = Part(
    "prioritised planning with rip-up that minimises the paper's cost, weight 1.1",
    lambda: _prioritised(1.1),
)

# Planners of the corridor study.
CORRIDOR: Mapping[str, Method] = {
    "prioritised": Method(PLANNER.words, PLANNER.make, Budget(expansions=20_000_000)),
    "prioritised, greedy": Method(
        "the same with weight 2", lambda: _prioritised(2.0), Budget(expansions=20_000_000)
    ),
    "prioritised, least time": Method(
        "prioritised planning that minimises the sum of arrivals",
        PrioritisedPlanner,
        Budget(expansions=20_000_000),
    ),
}


def words_of(parts: Mapping[str, Part[object]]) -> dict[str, str]:
    """Return what each label stands for."""
    return {label: part.words for label, part in parts.items()}
