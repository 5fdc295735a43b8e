"""A warehouse run to look at: pieces, samples and visits, made without any planner."""

import math
import shutil
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pytest
from shapely import affinity, distance
from shapely.geometry import Polygon as Shape

from clearway.model import (
    FOUR_WHEEL_MODES,
    Footprint,
    Limits,
    Obstacle,
    Piece,
    PlanRecord,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Stop,
    Track,
    Trajectory,
    Visit,
    Zone,
    to_seconds,
    to_ticks,
)

if TYPE_CHECKING:
    from playwright.sync_api import Browser

SPEED = 1.5
YAW_RATE = 0.5
STEP = 0.1


class Rover:
    """A four-wheel robot that writes down what it is told to do."""

    def __init__(self, name: str, start: Pose, kind: str = "carrier") -> None:
        self.robot = Robot(name, kind, start)
        self.pose = start
        self.clock = 0
        self.loaded = False
        self.pieces: list[Piece] = []
        self.timing: list[tuple[int, int]] = []
        self.visits: list[Visit] = []
        self.stops: list[Stop] = []

    def _go(self, mode: str, twist: tuple[float, float, float], seconds: float) -> "Rover":
        piece = Piece(len(self.pieces), mode, self.pose, twist, self.loaded)
        end = self.clock + to_ticks(seconds)
        self.pieces.append(piece)
        self.timing.append((self.clock, end))
        self.pose, self.clock = piece.end, end
        return self

    def drive(self, length: float) -> "Rover":
        mode = "forward" if length > 0 else "reverse"
        return self._go(mode, (length, 0.0, 0.0), abs(length) / SPEED)

    def arc(self, turn_deg: float, radius: float = 3.0) -> "Rover":
        turn = math.radians(turn_deg)
        mode = "forward-left" if turn > 0 else "forward-right"
        length = abs(turn) * radius
        return self._go(mode, (length, 0.0, turn), max(length / SPEED, abs(turn) / YAW_RATE))

    def rotate(self, turn_deg: float) -> "Rover":
        turn = math.radians(turn_deg)
        mode = "rotate-left" if turn > 0 else "rotate-right"
        return self._go(mode, (0.0, 0.0, turn), abs(turn) / YAW_RATE)

    def lateral(self, length: float) -> "Rover":
        mode = "lateral-left" if length > 0 else "lateral-right"
        return self._go(mode, (0.0, length, 0.0), abs(length) / SPEED)

    def wait(self, seconds: float) -> "Rover":
        self.clock += to_ticks(seconds)
        return self

    def serve(self, task: str | None, seconds: float, load: str | None = None) -> "Rover":
        self.visits.append(Visit(task, self.pose, seconds, load))
        leave = self.clock + to_ticks(seconds)
        self.stops.append(Stop(len(self.stops), self.clock, leave))
        self.clock = leave
        self.loaded = {"pick": True, "drop": False, None: self.loaded}[load]
        return self

    @property
    def trajectory(self) -> Trajectory:
        pieces, timing = tuple(self.pieces), tuple(self.timing)
        return Trajectory(self.robot.id, self.robot.start, pieces, timing, tuple(self.stops))

    @property
    def track(self) -> Track:
        """Samples at each piece's ends, and every 0.1 s between."""
        rows: list[tuple[float, Pose, str]] = [(0.0, self.robot.start, "stop")]
        for piece, (first, last) in zip(self.pieces, self.timing, strict=True):
            count = max(1, math.ceil((last - first) / 1000 / STEP))
            if rows[-1][0] == to_seconds(first):
                rows.pop()
            rows += [
                (
                    to_seconds(first) + k / count * to_seconds(last - first),
                    piece.at(k / count),
                    piece.mode or "stop",
                )
                for k in range(count)
            ]
            rows.append((to_seconds(last), piece.end, "stop"))
        t, poses, modes = zip(*rows, strict=True)
        x, y, theta = np.array(poses).T
        return Track(np.array(t), x, y, theta, modes)


def warehouse() -> Site:
    """Return 100 m by 60 m with 18 shelves of 35 m by 1.5 m, four stations and a parking place."""
    shelves = tuple(
        Obstacle(polygon=((x, y - 0.75), (x + 35, y - 0.75), (x + 35, y + 0.75), (x, y + 0.75)))
        for x in (10.0, 55.0)
        for y in np.arange(6.0, 55.0, 6.0).tolist()
    )
    areas = (
        ("dock west", "station", 0.5, 0.5, 6.0, 5.0),
        ("dock east", "station", 93.5, 0.5, 6.0, 5.0),
        ("night parking", "parking", 46.5, 52.0, 7.0, 7.5),
    )
    zones = tuple(
        Zone(name, kind, ((x, y), (x + w, y), (x + w, y + h), (x, y + h)))
        for name, kind, x, y, w, h in areas
    )
    pillar = Obstacle(disc=(50.0, 3.0, 0.8))
    partition = Obstacle(wall=((46.0, 59.0), (46.0, 52.5)))
    obstacles = (*shelves, pillar, partition)
    return Site(((0, 0), (100, 0), (100, 60), (0, 60)), obstacles, zones)


def fleet(names: Sequence[str]) -> list[Rover]:
    """Return rovers that work in their own aisles, four from the west and four from the east."""
    rovers = []
    for k, name in enumerate(names):
        west, lane = k % 2 == 0, k // 2
        y = 9.0 + 12.0 * lane
        rover = Rover(name, Pose(4.0, y, 0.0) if west else Pose(96.0, y, math.pi))
        turn = 90.0 if west else -90.0
        rover.wait(2.0 * lane).drive(14.0 + 2.0 * lane).serve(f"T{2 * k + 1}", 8.0, "pick")
        rover.drive(25.0 - 2.0 * lane).arc(turn).arc(turn).drive(8.0)
        rover.lateral(0.6 if west else -0.6).serve(f"T{2 * k + 1}", 6.0, "drop")
        rover.lateral(-0.6 if west else 0.6).wait(3.0 + lane).rotate(turn * 2.0)
        rover.wait(1.5).drive(-2.0).serve(f"T{2 * k + 2}", 10.0).drive(3.0).serve(None, 0.0)
        rovers.append(rover)
    return rovers


def record_of(rovers: Sequence[Rover], exact: bool = True, **changes: object) -> PlanRecord:
    """Return the record of what the rovers wrote down; ``exact`` keeps the pieces."""
    body = Footprint.rectangle(3.0, 2.0)
    carrier = RobotType(
        "carrier",
        body,
        "four_wheel",
        Limits(SPEED, yaw_rate=YAW_RATE, turning_radius=3.0),
        loaded_footprint=Footprint.rectangle(3.4, 2.4),
        clearance=0.1,
        modes=FOUR_WHEEL_MODES,
    )
    arrivals = [to_seconds(rover.timing[-1][1]) if rover.timing else 0.0 for rover in rovers]
    fields: dict[str, object] = {
        "scenario": "warehouse of 18 shelves",
        "system": "hierarchical",
        "seed": 7,
        "status": Status.SOLVED,
        "site": warehouse(),
        "robot_types": {"carrier": carrier},
        "robots": tuple(rover.robot for rover in rovers),
        "tours": {rover.robot.id: tuple(rover.visits) for rover in rovers},
        "tracks": {rover.robot.id: rover.track for rover in rovers},
        "assignment": {
            rover.robot.id: tuple(dict.fromkeys(v.task for v in rover.visits if v.task))
            for rover in rovers
        },
        "sum_of_costs": sum(arrivals),
        "makespan": max(arrivals),
        "lower_bound": 0.94 * sum(arrivals),
        "cost": 1.2 * sum(arrivals),
        "cost_name": "time and mode switches",
        "cost_lower_bound": sum(arrivals),
        "discrete_bound": {"graph": "32 headings, 0.5 m cells", "value": 930.0, "factor": 1.05},
        "paths": {rover.robot.id: rover.trajectory for rover in rovers} if exact else {},
        "parameters": {"plan": {"weight": 1.05, "headings": 32}},
        "version": "0.1.0",
    }
    return PlanRecord(**{**fields, **changes})


def closest(record: PlanRecord, every: float = 0.5) -> list[tuple[str, str, float, float]]:
    """Return each pair's least distance, looked at every so often."""
    times = np.arange(0.0, record.makespan + every, every)
    bodies = {}
    for robot in record.robots:
        track = record.tracks[robot.id]
        shape = Shape(record.robot_types[robot.type].footprint.parts[0])
        heading = np.interp(times, track.t, np.unwrap(track.theta))
        bodies[robot.id] = np.array(
            [
                affinity.translate(affinity.rotate(shape, a, origin=(0, 0), use_radians=True), x, y)
                for x, y, a in zip(
                    np.interp(times, track.t, track.x),
                    np.interp(times, track.t, track.y),
                    heading,
                    strict=True,
                )
            ]
        )
    found = []
    for i, a in enumerate(record.robots):
        for b in record.robots[i + 1 :]:
            apart = distance(bodies[a.id], bodies[b.id])
            k = int(apart.argmin())
            found.append((a.id, b.id, float(apart[k]), float(times[k])))
    return found


@pytest.fixture(scope="session")
def warehouse_record() -> PlanRecord:
    return record_of(fleet([f"R{k + 1}" for k in range(8)]))


@pytest.fixture(scope="session")
def browser() -> "Iterator[Browser]":
    api = pytest.importorskip("playwright.sync_api", reason="pip install playwright")
    names = ("chromium", "chromium-browser", "google-chrome")
    found = next((path for name in names if (path := shutil.which(name))), None)
    if found is None:
        pytest.skip("no Chromium is installed: apt-get install chromium")
    arguments = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found, args=arguments)
        yield browser
        browser.close()
