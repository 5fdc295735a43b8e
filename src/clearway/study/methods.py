"""The assigners and planners that the studies of system A compare: a line each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Generic, TypeVar

from clearway.assign import InsertionLocalSearch, InsertionParams, RandomAssigner
from clearway.coordinate import System
from clearway.plan import PrioritisedPlanner, TeamParams
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

    budget: Budget = field(default_factory=Budget)
    quick: Budget | None = None  # in the quick version; absent: the same


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
    """Return the planner that minimises the paper's cost; the first plan is its answer.

    A search for the least cost takes some ten times as many expansions as one for the least
    time, so that a search may take more of them than usual before a round is given up.
    """
    params = TeamParams()
    search, objective = params.search, params.objective
    search.weight, objective.time = weight, False
    params.search, params.objective = search, objective
    params.search_limit, params.restarts = 200_000, 20
    return PrioritisedPlanner(params)


# Plans of the assignment studies; all of them come from this planner.
PLANNER: Part[Planner] = Part(
    "prioritised planning with rip-up for the least cost of the paper, weight 1.1, 20 restarts",
    lambda: _prioritised(1.1),
)


def system_of(label: str) -> System:
    """Return system A with one of the assigners, for the problem as the paper has it."""
    settings = HierarchicalSettings(even=True, objective="paper")
    return replace(hierarchical(settings), assign=ASSIGNERS[label].make(), plan=PLANNER.make())


# Planners of the corridor study. Those with these labels answer for the paper's xi = 1 and
# adaptive xi; its claims are not told while they are missing.
OPTIMAL, ADAPTIVE = "optimal", "adaptive"
CORRIDOR: Mapping[str, Method] = {
    "prioritised": Method(f"{PLANNER.words}; the first plan", PLANNER.make),
    "prioritised, greedy": Method(
        "the same with weight 2; the first plan", lambda: _prioritised(2.0)
    ),
    "prioritised, improved": Method(
        f"{PLANNER.words}; improved until 500,000 expansions",
        PLANNER.make,
        Budget(expansions=500_000),
    ),
}


def words_of(parts: Mapping[str, Part[object]]) -> dict[str, str]:
    """Return what each label stands for."""
    return {label: part.words for label, part in parts.items()}
