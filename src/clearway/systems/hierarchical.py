"""System A: hierarchical scheduling of four-wheel-steering robots.

Zhang, An, Niu, Bao, Wang, Wang, "An Enhanced Hybrid Metaheuristic for Hierarchical Scheduling
in 4WIDS Multi-robot Systems under Confined Environments", Control Engineering Practice.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Literal

from clearway.assign import InsertionLocalSearch, RandomAssigner, park
from clearway.assign.insertion import InsertionParams
from clearway.coordinate import ByDuration, Searched, System, Travel, bounded_seconds, by_grid
from clearway.coordinate.value import Value, makespan, paper, sum_of_costs
from clearway.model import Scenario, Visit
from clearway.plan import Aim, PrioritisedPlanner, TeamParams
from clearway.protocols import Assigner, Weights
from clearway.systems.settings import SettingsError

MOST_ROUNDS = 100
VALUES: dict[str, Value] = {"time": sum_of_costs, "makespan": makespan, "paper": paper}


@dataclass(frozen=True)
class HierarchicalSettings:
    """Choices of system A.

    Parameters
    ----------
    assign
        ``insertion`` with local search, or ``random`` (the paper's NTA).
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
    objective
        What planning minimises: ``time`` (sum of costs), ``makespan`` (the last arrival, then
        the sum), or the ``paper`` cost (eq. 21).
    weight
        Factor on the heuristic; larger plans faster and drives longer.
    """

    assign: Literal["insertion", "random"] = "insertion"
    even: bool = False
    max_distance: float = 1.0
    total_distance: float = 1.0
    turning: float = 1.0
    tardiness: float = 1.0
    travel: Literal["grid", "curves", "planned"] = "grid"
    rounds: int = 0
    park: Literal["blocking", "always", "never"] = "blocking"
    objective: Literal["time", "makespan", "paper"] = "time"
    weight: float = 1.1

    def __post_init__(self) -> None:
        for name in ("max_distance", "total_distance", "turning", "tardiness"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise SettingsError(f"system.{name}", getattr(self, name), "write 0 or above")
        if not 0 <= self.rounds <= MOST_ROUNDS:
            raise SettingsError("system.rounds", self.rounds, f"write 0 to {MOST_ROUNDS}")
        if not (math.isfinite(self.weight) and self.weight > 0.0):
            raise SettingsError("system.weight", self.weight, "write a number above 0")


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
        "insertion": InsertionLocalSearch(InsertionParams(even=settings.even)),
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
        plan=PrioritisedPlanner(params),
        travel=travels[settings.travel],
        rounds=settings.rounds,
        value=VALUES[settings.objective],
        weights=Weights(
            settings.max_distance, settings.total_distance, settings.turning, settings.tardiness
        ),
        parameters=asdict(settings),
    )
