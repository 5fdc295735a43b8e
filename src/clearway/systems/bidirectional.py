"""System B: a warehouse with bidirectional channels whose robots carry shelves.

Yu, Liao, Zu, "Dynamic Scheduling Optimization Method for Multi-AGV-Based Intelligent Warehouse
Considering Bidirectional Channel", Systems 2024, 12(1), 9.
"""

import math
from dataclasses import asdict, dataclass
from typing import Literal

from clearway.assign import LookAhead, NearestIdle, ShelfParams
from clearway.coordinate import Lifelong
from clearway.execute import CellConflicts, RightOfWay
from clearway.model import Scenario
from clearway.plan import LaneTrips
from clearway.protocols import Dispatcher, Executor
from clearway.simulation.disturbed import PERIOD
from clearway.systems.settings import SettingsError
from clearway.world.channels import RULES, lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lane_grid import LaneGrid
from clearway.world.lane_times import LaneTimes


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


def bidirectional(settings: BidirectionalSettings) -> Lifelong:
    """Return system B as chosen."""

    def grid_of(scenario: Scenario) -> LaneGrid:
        assert scenario.site.layout is not None  # else unsupported
        return lane_grid(scenario.site.layout)

    def trips(scenario: Scenario) -> LaneTrips:
        grid = grid_of(scenario)
        kind = scenario.type_of(scenario.robots[0])
        moves = DynamicMap(grid, settings.map_mode)
        return LaneTrips(grid, scenario.robots, kind, moves, rules=settings.rules)

    def dispatch(scenario: Scenario) -> Dispatcher:
        params = ShelfParams(residence=settings.residence, lift=settings.lift, lower=settings.lower)
        if settings.dispatch == "ahead":
            return LookAhead(scenario, params)
        by_route = LaneTimes(grid_of(scenario)) if settings.nearest == "route" else None  # metres
        return NearestIdle(scenario, params, by_route)

    def execute(scenario: Scenario) -> Executor:
        return RightOfWay(CellConflicts(grid_of(scenario)), PERIOD)

    return Lifelong(
        name="bidirectional",
        dispatch=dispatch,
        trips=trips,
        execute=execute,
        unsupported=_unsupported,
        parameters=asdict(settings),
    )


def _unsupported(scenario: Scenario) -> tuple[str, ...]:
    """Return what in a scenario system B cannot take."""
    reasons = []
    if scenario.site.layout is None:
        known = ", ".join(RULES)
        reasons.append(f"site: system B drives on lanes; give it a layout (rule: {known})")
    if len({robot.type for robot in scenario.robots}) > 1:
        reasons.append("robots: all must be of one type")
    reasons += [
        f"robot type {name}: has limits on acceleration; system B drives in steps of one speed: "
        "remove them"
        for name in sorted({robot.type for robot in scenario.robots})
        if scenario.robot_types[name].limits.has_ramps
    ]
    reasons += [
        f"task {order.task.id}: has visits of its own; system B fetches shelves (fetches = 'g1')"
        for order in scenario.orders
        if order.task.fetches is None
    ]
    reasons += [
        f"stream {stream.name}: has visits of its own; system B fetches shelves (fetch = true)"
        for stream in scenario.simulation.streams
        if not stream.fetch
    ]
    reasons += [
        f"task {order.task.id}: is kept for {order.task.robot}, but system B sends the nearest; "
        "drop robot"
        for order in scenario.orders
        if order.task.robot is not None
    ]
    return tuple(reasons)
