"""The assigners and planners that the studies of system A compare: a line each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Generic, TypeVar

from clearway.assign import (
    Apsga,
    AutomaticAssigner,
    Ga,
    MemeticApsga,
    Psga,
    Pso,
    RandomAssigner,
)
from clearway.coordinate import System
from clearway.plan import (
    ConflictBasedSearch,
    ConflictParams,
    InTurn,
    PrioritisedPlanner,
    TeamParams,
)
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
    few: int | None = None  # instances above 8 robots, where little is to be hoped for; all


NTA, APSGA, OURS = "NTA", "APSGA", "ours"


ASSIGNERS: Mapping[str, Part[Assigner]] = {
    NTA: Part("random permutation, even split", lambda: RandomAssigner(even=True)),
    "PSO": Part("particle swarm, N = 30, T = 200", Pso),
    "GA": Part("genetic algorithm, N = 30, T = 200, roulette", Ga),
    "PSGA": Part("swarm and genetic hybrid, N = 30, T = 200, elitist", Psga),
    APSGA: Part("adaptive hybrid, N = 30, T = 200, elitist", Apsga),
    "memetic": Part("memetic adaptive hybrid, N = 30, T = 5", MemeticApsga),
    OURS: Part(
        "our default: any number of tasks a robot, exact up to 16 tasks, else ruin and recreate",
        AutomaticAssigner,
    ),
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
    "adaptive search over conflicts, the paper's way, for the paper's cost; where 1,000,000 "
    "expansions bring no plan, by priorities (weight 1.1, 20 restarts)",
    lambda: InTurn((ConflictBasedSearch(ConflictParams("adaptive")), _prioritised(1.1)), 1_000_000),
)
PRIORITIES: Part[Planner] = Part(
    "prioritised planning with rip-up for the least cost of the paper, weight 1.1, 20 restarts",
    lambda: _prioritised(1.1),
)


def system_of(label: str) -> System:
    """Return system A with one of the assigners, for the problem as the paper has it."""
    settings = HierarchicalSettings(even=True, objective="paper")
    return replace(hierarchical(settings), assign=ASSIGNERS[label].make(), plan=PLANNER.make())


# Planners of the corridor study. Those with the XI labels answer for the paper's claims.
OPTIMAL, ADAPTIVE = "optimal", "adaptive"
XI_ONE, XI_ADAPTIVE = "paper, xi = 1", "paper, adaptive"
CORRIDOR: Mapping[str, Method] = {
    XI_ONE: Method(
        "conflicts of bodies, heuristic of eq. 22, xi = 1",
        lambda: _paper(1.0, fixed=True),
        Budget(seconds=100.0),
        Budget(seconds=4.0),
        few=5,
    ),
    "paper, xi = 2": Method(
        "conflicts of bodies, heuristic of eq. 22, xi = 2",
        lambda: _paper(2.0, fixed=True),
        Budget(seconds=100.0),
        Budget(seconds=4.0),
    ),
    XI_ADAPTIVE: Method(
        "conflicts of bodies, heuristic of eq. 22, adaptive xi up to 2",
        lambda: _paper(2.0, fixed=False),
        Budget(seconds=100.0),
        Budget(seconds=4.0),
    ),
    ADAPTIVE: Method(
        "conflicts of bodies, heuristic that says never too much, adaptive xi up to 1.2",
        lambda: ConflictBasedSearch(ConflictParams("adaptive")),
        Budget(seconds=100.0),
        Budget(seconds=4.0),
    ),
    OPTIMAL: Method(
        "conflicts of bodies, optimal on the lattices",
        lambda: ConflictBasedSearch(ConflictParams("optimal")),
        Budget(seconds=60.0),
        Budget(seconds=4.0),
        few=5,
    ),
    "prioritised": Method(f"{PRIORITIES.words}; the first plan", PRIORITIES.make),
    "prioritised, improved": Method(
        f"{PRIORITIES.words}; improved until 500,000 expansions",
        PRIORITIES.make,
        Budget(expansions=500_000),
    ),
}


def _paper(xi: float, fixed: bool) -> Planner:
    """Return search over conflicts as the paper has it, as far as it tells."""
    return ConflictBasedSearch(ConflictParams("adaptive", heuristic="paper", xi=xi, fixed=fixed))


def words_of(parts: Mapping[str, Part[object]]) -> dict[str, str]:
    """Return what each label stands for."""
    return {label: part.words for label, part in parts.items()}
