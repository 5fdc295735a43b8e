"""A scenario: site, fleet, work and the parts chosen to do it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from clearway.model.robot import Robot, RobotType
from clearway.model.site import Site
from clearway.model.task import Order


@dataclass(frozen=True)
class Scenario:
    """All that a run needs. ``system`` names the composition, ``settings`` are its parameters."""

    name: str
    site: Site
    robot_types: Mapping[str, RobotType]
    robots: tuple[Robot, ...]
    orders: tuple[Order, ...]
    system: str = "hierarchical"
    settings: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0

    def type_of(self, robot: Robot) -> RobotType:
        """Return the type of ``robot``."""
        return self.robot_types[robot.type]
