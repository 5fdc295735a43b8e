"""A lifelong system as a value: the parts that do orders as they come."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from clearway.model import Scenario
from clearway.protocols import Dispatcher, Executor, TripPlanner


@dataclass(frozen=True)
class Lifelong:
    """Parts that together do a scenario's orders as they come; each is made anew for a run.

    Parameters
    ----------
    dispatch
        Who does what next.
    trips
        How robots get there without conflict.
    execute
        Who may go on where robots are late.
    unsupported
        What in a scenario these parts cannot take, in words a person can act on.
    parameters
        Tell files how the system was set.
    """

    name: str
    dispatch: Callable[[Scenario], Dispatcher]
    trips: Callable[[Scenario], TripPlanner]
    execute: Callable[[Scenario], Executor]
    unsupported: Callable[[Scenario], tuple[str, ...]] = lambda scenario: ()
    parameters: Mapping[str, Any] = field(default_factory=dict)
