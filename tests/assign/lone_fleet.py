"""Robots that meet nobody: a loop that drives dispatchers without a planner."""

import heapq
import random
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from clearway.model import (
    Battery,
    Footprint,
    Layout,
    Limits,
    Order,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Trip,
    Zone,
    to_ticks,
)
from clearway.protocols import Board, Choice, Dispatcher, RobotView, TripEnded
from clearway.world.channels import lane_grid
from clearway.world.lane_grid import LaneGrid


def yard(
    grid: LaneGrid,
    robots: int,
    fetches: list[str],
    battery: Battery | None = None,
    energy: float = 1.0,
    releases: list[float] | None = None,
) -> Scenario:
    """Robots rest under the shelves named first in equal steps; orders fetch shelves."""
    zones = []
    for point in grid.endpoints.values():
        pose = grid.centre(point.cell)
        x, y, h = pose.x, pose.y, grid.cell / 2
        square = ((x - h, y - h), (x + h, y - h), (x + h, y + h), (x - h, y + h))
        zones.append(Zone(point.name, point.kind, square, pose))
    width, height = grid.size
    w, h = width * grid.cell, height * grid.cell
    half = 0.35
    body = Footprint((((-half, -half), (half, -half), (half, half), (-half, half)),))
    agv = RobotType("agv", body, "differential", Limits(grid.cell), battery=battery)
    row = [point for point in grid.of_kind("shelf") if point.cell[1] == 2] or grid.of_kind("shelf")
    row = list(grid.of_kind("shelf")) if robots > len(row) else list(row)
    at = [row[k * len(row) // robots] for k in range(robots)]
    fleet = tuple(
        Robot(f"agv-{k + 1}", "agv", grid.centre(p.cell), energy=energy) for k, p in enumerate(at)
    )
    times = releases or [0.0] * len(fetches)
    orders = tuple(
        Order(Task(f"o{k + 1}", (), fetches=shelf), release=times[k])
        for k, shelf in enumerate(fetches)
    )
    site = Site(((0.0, 0.0), (w, 0.0), (w, h), (0.0, h)), zones=tuple(zones))
    return Scenario(grid.name, site, {"agv": agv}, fleet, orders)


def paper_yard(robots: int, orders: int, seed: int, rule: str = "bidirectional") -> Scenario:
    """The paper's warehouse; orders drawn without replacement."""
    grid = lane_grid(Layout(rule))
    shelves = [point.name for point in grid.of_kind("shelf")]
    return yard(grid, robots, random.Random(seed).sample(shelves, orders))


@dataclass
class Log:
    """What was driven: choices with departure and end (ticks), and what was left open."""

    driven: list[tuple[int, int, Choice]] = field(default_factory=list)
    refused: int = 0
    open: list[str] = field(default_factory=list)

    @property
    def makespan(self) -> float:
        """End of the last trip of an order (s)."""
        return max((end for _, end, c in self.driven if c.trip.order), default=0) / 1000.0


def run(
    scenario: Scenario,
    dispatcher: Dispatcher,
    travel: Callable[[str, str], float] | None = None,
    refuse: Callable[[Choice, int], bool] = lambda choice, now: False,
    retry: float = 5.0,
) -> Log:
    """Drive until no trip is under way and no order is to come.

    ``travel`` gives seconds between zones, Manhattan at the speed limit without it; energy falls
    while driving and rises while charging.
    """
    pose = {zone.name: zone.pose for zone in scenario.site.zones}
    where = {(p.x, p.y): name for name, p in pose.items() if p is not None}
    views = {}
    for robot in scenario.robots:
        place = where.get((robot.start.x, robot.start.y))
        views[robot.id] = RobotView(robot.id, robot.type, robot.start, place, energy=robot.energy)
    board = Board(0, views)
    log = Log()
    events: list[tuple[int, int, str, object]] = [(0, -1, "begin", None)]
    number = 0
    for order in scenario.orders:
        heapq.heappush(events, (to_ticks(order.release), number, "order", order))
        number += 1
    while events:
        now = events[0][0]
        arrived, ended = [], []
        while events and events[0][0] == now:
            _, _, what, item = heapq.heappop(events)
            if what == "order":
                assert isinstance(item, Order)
                board.open[item.task.id] = item
                arrived.append(item.task.id)
            elif what == "end":
                choice, level = item  # type: ignore[misc]
                trip: Trip = choice.trip
                view = board.robots[trip.robot]
                place = trip.goals[-1]
                board.robots[trip.robot] = replace(
                    view,
                    trip=None,
                    ready=now,
                    place=place,
                    pose=trip.visits[-1].pose,
                    carries=trip.carries,
                    energy=level,
                    idle_since=now,
                )
                if trip.order and choice.completes:
                    del board.open[trip.order]
                ended.append(TripEnded(trip.robot, trip))
        board.now, board.arrived, board.ended = now, tuple(arrived), tuple(ended)
        was_refused = False
        for choice in dispatcher(board):
            view = board.robots[choice.trip.robot]
            assert view.trip is None, f"{view.id} has a trip"
            if refuse(choice, now):
                log.refused += 1
                was_refused = True
                continue
            kind = scenario.robot_types[view.type]
            here, pose_here, seconds, level, service = view.place, view.pose, 0.0, view.energy, 0.0
            for goal, visit in zip(choice.trip.goals, choice.trip.visits, strict=True):
                if travel is not None and here is not None and goal is not None:
                    leg = travel(here, goal)
                else:
                    away = abs(pose_here.x - visit.pose.x) + abs(pose_here.y - visit.pose.y)
                    leg = away / kind.limits.speed
                here, pose_here = goal, visit.pose
                seconds += leg + visit.service
                service = visit.service
                level -= leg / kind.battery.capacity if kind.battery else 0.0
            if choice.trip.purpose == "charge" and kind.battery:
                level += service / kind.battery.charging
            board.robots[view.id] = replace(view, trip=choice.trip)
            end = now + to_ticks(seconds)
            log.driven.append((now, end, choice))
            heapq.heappush(events, (end, number, "end", (choice, level)))
            number += 1
        if was_refused and not any(e[2] == "retry" for e in events):
            heapq.heappush(events, (now + to_ticks(retry), number, "retry", None))
            number += 1
    log.open = list(board.open)
    return log


def by_purpose(log: Log, purpose: str) -> list[tuple[int, int, str, str]]:
    """Return (departure, end, robot, goal) of the trips of one purpose."""
    return [
        (begin, end, c.trip.robot, c.trip.goals[0] or "")
        for begin, end, c in log.driven
        if c.trip.purpose == purpose
    ]


def check_ownership(scenario: Scenario, log: Log) -> None:
    """Nobody is bound for an endpoint before its last owner was committed to leave it."""
    zones = {zone.pose: zone.name for zone in scenario.site.zones}
    owned = {robot.id: zones.get(robot.start) for robot in scenario.robots}
    assert len(set(owned.values())) == len(owned)
    for _, _, choice in log.driven:
        goal, robot = choice.trip.goals[0], choice.trip.robot
        assert goal not in [other for r, other in owned.items() if r != robot], (goal, choice)
        owned[robot] = goal


def check_shelves(scenario: Scenario, log: Log) -> None:
    """Each order's shelf is carried once at a time, by one robot, from where it was left."""
    at = {zone.name: zone.name for zone in scenario.site.zones_of("shelf")}
    carried: dict[str, str] = {}
    for _, _, choice in sorted(log.driven, key=lambda d: d[0]):
        trip = choice.trip
        if trip.purpose == "fetch":
            (shelf,) = trip.carries
            assert at[shelf] == trip.goals[0]
            assert shelf not in carried.values()
            carried[trip.robot] = shelf
        elif trip.purpose == "deliver":
            del at[carried[trip.robot]]
        elif trip.purpose == "store":
            at[carried.pop(trip.robot)] = trip.goals[0] or ""
            assert len(set(at.values())) == len(at), "two shelves in one place"
    assert not carried
