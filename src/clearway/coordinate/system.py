"""A system as a value: the parts that share out work, plan motion and add tasks of their own."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from clearway.coordinate.travel import Travel, by_grid
from clearway.coordinate.value import Value, sum_of_costs
from clearway.model import Scenario, Visit
from clearway.protocols import Assigner, Planner, Weights

Tours = Mapping[str, tuple[Visit, ...]]


class OwnTasks(Protocol):
    """Visits that robots give themselves, such as parking."""

    def __call__(self, scenario: Scenario, tours: Tours) -> dict[str, tuple[Visit, ...]]:
        """Return the tours with the robots' own visits added."""
        ...


@dataclass(frozen=True)
class System:
    """Parts that together do a scenario's work.

    Parameters
    ----------
    travel
        How far apart ``assign`` believes tasks to be.
    rounds
        How often tasks are shared out anew for what a plan has shown.
    value
        By which plans are compared then.
    parameters
        Tell files how the system was set.
    """

    name: str
    assign: Assigner
    own_tasks: OwnTasks
    plan: Planner
    weights: Weights = field(default_factory=Weights)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    travel: Travel = by_grid
    rounds: int = 0
    value: Value = sum_of_costs
