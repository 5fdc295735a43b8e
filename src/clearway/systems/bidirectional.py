"""System B: a warehouse with bidirectional channels whose robots carry shelves.

Yu, Liao, Zu, "Dynamic Scheduling Optimization Method for Multi-AGV-Based Intelligent Warehouse
Considering Bidirectional Channel", Systems 2024, 12(1), 9.
"""

import math
from dataclasses import dataclass
from typing import Literal

from clearway.systems.settings import SettingsError


@dataclass(frozen=True)
class BidirectionalSettings:
    """Choices of system B.

    Parameters
    ----------
    dispatch
        ``nearest``: the paper's rules, oldest order to nearest idle robot; ``ahead``: orders,
        stations and places chosen together, looking ahead.
    nearest
        What that means: ``manhattan`` distance, or the length of the ``route``.
    rules
        Who gives way: ``waiting``, the paper's rules, or ``search`` for each way in space and time.
    map_mode
        Ways that a robot may take: ``completed``, the lanes and the aprons of its own start and
        goal; ``literal``, Algorithms 1 to 3 (bidirectional sites only).
    residence
        Seconds at a packing station.
    lift, lower
        Seconds that taking up and putting down a shelf takes.
    """

    dispatch: Literal["nearest", "ahead"] = "nearest"
    nearest: Literal["manhattan", "route"] = "manhattan"
    rules: Literal["waiting", "search"] = "waiting"
    map_mode: Literal["completed", "literal"] = "completed"
    residence: float = 10.0
    lift: float = 0.0
    lower: float = 0.0

    def __post_init__(self) -> None:
        for name in ("residence", "lift", "lower"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise SettingsError(f"system.{name}", getattr(self, name), "write 0 or above")
