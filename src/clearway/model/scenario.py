"""A scenario: site, fleet, work and the parts chosen to do it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from clearway.model.robot import Robot, RobotType
from clearway.model.simulation import Simulation
from clearway.model.site import Site
from clearway.model.task import Order


@dataclass(frozen=True)
class Scenario:
    """All that a run needs. ``system`` names the composition, ``settings`` are its parameters.

    ``simulation`` tells what happens while it runs; planning once does not look at it.
    """

    name: str
    site: Site
    robot_types: Mapping[str, RobotType]
    robots: tuple[Robot, ...]
    orders: tuple[Order, ...]
    system: str = "hierarchical"
    settings: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    simulation: Simulation = field(default_factory=Simulation)

    def __post_init__(self) -> None:
        known = {order.task.id for order in self.orders}
        for order in self.orders:
            for other in order.after:
                if other not in known:
                    raise ValueError(
                        f"task {order.task.id} waits for {other}, which is no task of {self.name}"
                    )

    def type_of(self, robot: Robot) -> RobotType:
        """Return the type of ``robot``."""
        return self.robot_types[robot.type]
