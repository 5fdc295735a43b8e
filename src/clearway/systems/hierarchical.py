"""System A: hierarchical scheduling of four-wheel-steering robots.

Zhang, An, Niu, Bao, Wang, Wang, "An Enhanced Hybrid Metaheuristic for Hierarchical Scheduling
in 4WIDS Multi-robot Systems under Confined Environments", Control Engineering Practice.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Literal

from clearway.assign import (
    Apsga,
    AutomaticAssigner,
    ExactAssigner,
    Ga,
    InsertionLocalSearch,
    InsertionParams,
    MemeticApsga,
    Psga,
    Pso,
    RandomAssigner,
    RuinRecreate,
    park,
)
from clearway.coordinate import ByDuration, Searched, System, Travel, bounded_seconds, by_grid
from clearway.coordinate.value import Value, makespan, paper, sum_of_costs
from clearway.model import Scenario, Visit
from clearway.plan import (
    Aim,
    ConflictBasedSearch,
    ConflictParams,
    PrioritisedPlanner,
    TeamParams,
)
from clearway.protocols import Assigner, Planner, Weights
from clearway.systems.settings import SettingsError

MOST_ROUNDS = 100
VALUES: dict[str, Value] = {"time": sum_of_costs, "makespan": makespan, "paper": paper}


@dataclass(frozen=True)
class HierarchicalSettings:
    """Choices of system A.

    Parameters
    ----------
    assign
        ``auto``: what suits the problem (`clearway.assign.AutomaticAssigner`); ``exact`` (up to
        16 tasks), ``memetic`` (even splits), ``ruin`` and recreate, ``insertion`` with local
        search; the paper's ``apsga`` and its rivals ``psga``, ``pso``, ``ga`` (even splits) and
        ``random`` (its NTA).
    even
        Give every robot the same number of tasks, as the paper's encoding does.
    max_distance, total_distance, turning
        Weights of objective A-4 (eq. 2): longest route, all routes (per m), turns (per rad).
    tardiness
        Weight of each second that a task is finished after it is due; not in the paper.
    travel
        How far apart tasks are believed to be: ``grid`` distances, ``curves`` (least times of
        any motion) or ``planned`` (times of lone ways, each searched for).
    rounds
        How often tasks are shared out anew for the ways that a plan has shown; the better plan
        is kept. Each round assigns and plans once more.
    park
        Who ends in a parking bay: robots ``blocking`` others, ``always`` all, ``never``.
    plan
        By ``priorities``, improved while a budget lasts; or by search over conflicts, the
        paper's own way: ``adaptive`` (greedy), ``bounded`` (proven within ``factor`` on a finite
        graph) or ``optimal`` on it.
    factor
        Of ``bounded``.
    objective
        What planning minimises: ``time`` (sum of costs), ``makespan`` (the last arrival, then
        the sum), or the ``paper`` cost (eq. 21).
    weight
        Factor on the heuristic; larger plans faster and drives longer. Of ``adaptive`` it is
        the largest xi (eq. 23); ``bounded`` and ``optimal`` know none.
    dispatch
        Of orders that arrive, which a robot takes next: the ``nearest``, away from others, or
        the ``oldest``. The other settings are for planning at once.
    """

    assign: Literal[
        "auto",
        "exact",
        "memetic",
        "ruin",
        "insertion",
        "apsga",
        "psga",
        "pso",
        "ga",
        "random",
    ] = "auto"
    even: bool = False
    max_distance: float = 1.0
    total_distance: float = 1.0
    turning: float = 1.0
    tardiness: float = 1.0
    travel: Literal["grid", "curves", "planned"] = "grid"
    rounds: int = 0
    park: Literal["blocking", "always", "never"] = "blocking"
    plan: Literal["priorities", "adaptive", "bounded", "optimal"] = "priorities"
    factor: float = 1.05
    objective: Literal["time", "makespan", "paper"] = "time"
    weight: float = 1.1
    dispatch: Literal["nearest", "oldest"] = "nearest"

    def __post_init__(self) -> None:
        for name in ("max_distance", "total_distance", "turning", "tardiness"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise SettingsError(f"system.{name}", getattr(self, name), "write 0 or above")
        if not 0 <= self.rounds <= MOST_ROUNDS:
            raise SettingsError("system.rounds", self.rounds, f"write 0 to {MOST_ROUNDS}")
        if not (math.isfinite(self.weight) and self.weight > 0.0):
            raise SettingsError("system.weight", self.weight, "write a number above 0")
        if not (math.isfinite(self.factor) and self.factor >= 1.0):
            raise SettingsError("system.factor", self.factor, "write 1 or above")
        if self.plan != "priorities" and self.objective == "makespan":
            mend = 'search over conflicts minimises "time" or "paper"; or plan = "priorities"'
            raise SettingsError("system.objective", self.objective, mend)
        if self.plan == "adaptive" and self.weight < 1.0:
            raise SettingsError("system.weight", self.weight, "write 1 or above for adaptive")


def hierarchical(settings: HierarchicalSettings) -> System:
    """Return system A as chosen."""
    params = TeamParams()
    search, objective = params.search, params.objective
    search.weight = settings.weight
    objective.time = settings.objective != "paper"
    params.search, params.objective = search, objective
    params.aim = Aim.MAKESPAN if settings.objective == "makespan" else Aim.SUM_OF_COSTS

    def own_tasks(
        scenario: Scenario, tours: Mapping[str, tuple[Visit, ...]]
    ) -> dict[str, tuple[Visit, ...]]:
        return park(scenario.site, scenario.robot_types, scenario.robots, tours, settings.park)

    assigners: dict[str, Assigner] = {
        "auto": AutomaticAssigner(even=settings.even),
        "exact": ExactAssigner(even=settings.even),
        "memetic": MemeticApsga(),
        "ruin": RuinRecreate(even=settings.even),
        "insertion": InsertionLocalSearch(InsertionParams(even=settings.even)),
        "apsga": Apsga(),
        "psga": Psga(),
        "pso": Pso(),
        "ga": Ga(),
        "random": RandomAssigner(even=settings.even),
    }
    travels: dict[str, Travel] = {
        "grid": by_grid,
        "curves": ByDuration(bounded_seconds),
        "planned": ByDuration(Searched(params)),
    }
    return System(
        name="hierarchical",
        assign=assigners[settings.assign],
        own_tasks=own_tasks,
        plan=_planner(settings, params),
        travel=travels[settings.travel],
        rounds=settings.rounds,
        value=VALUES[settings.objective],
        weights=Weights(
            settings.max_distance, settings.total_distance, settings.turning, settings.tardiness
        ),
        parameters=asdict(settings),
    )


def _planner(settings: HierarchicalSettings, params: TeamParams) -> Planner:
    if settings.plan == "priorities":
        return PrioritisedPlanner(params)
    return ConflictBasedSearch(
        ConflictParams(
            mode=settings.plan,
            factor=settings.factor,
            xi=settings.weight,
            paper_cost=settings.objective == "paper",
        )
    )
