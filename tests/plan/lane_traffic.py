"""Random trips between endpoints without an end, and what robots drove, for the judge."""

import random
from collections.abc import Mapping
from dataclasses import replace

from clearway.formats.recording import record_plan
from clearway.model import (
    Commitment,
    Layout,
    Obstacle,
    Plan,
    Robot,
    Scenario,
    Status,
    Trajectory,
    Trip,
    Visit,
)
from clearway.plan.lane_trips import LaneTrips
from clearway.protocols import Refusal
from clearway.world.channels import agv_type, lane_grid, site_of
from clearway.world.dynamic_map import DynamicMap

LAYOUTS = ("bidirectional", "compact", "one_way")


class Traffic:
    """Robots that drive from one random endpoint to the next, ten seconds of service at each."""

    def __init__(
        self, layout: Layout, num_robots: int, turn_seconds=0.0, seed=0, kind=None, **options
    ):
        self.layout = layout
        self.grid = lane_grid(layout)
        self.type = kind or agv_type(layout, turn_seconds)
        self.random = random.Random(seed)
        places = self.random.sample(sorted(self.grid.endpoints), num_robots)
        self.robots = tuple(
            Robot(f"agv-{k}", self.type.name, self.grid.centre(self.grid.endpoints[place].cell))
            for k, place in enumerate(places)
        )
        moves = DynamicMap(self.grid, "completed")
        self.planner = LaneTrips(self.grid, self.robots, self.type, moves, **options)
        self.told: dict[str, list[Commitment]] = {robot.id: [] for robot in self.robots}
        self.rests = {robot.id: place for robot, place in zip(self.robots, places, strict=True)}
        self.done = [(0, robot.id) for robot in self.robots]
        self.status = Status.SOLVED

    def trip(self, robot: str, service: float = 10.0) -> Trip:
        """Return a trip to a random endpoint that nobody owns."""
        owned = set(self.rests.values())
        name = self.random.choice(sorted(set(self.grid.endpoints) - owned))
        return self.trip_to(robot, name, service)

    def trip_to(self, robot: str, name: str, service: float = 10.0) -> Trip:
        """Return a trip to an endpoint."""
        pose = self.grid.centre(self.grid.endpoints[name].cell)
        return Trip(robot, (Visit(None, pose, service),), "order", goals=(name,))

    def run(self, num_trips: int, until: int | None = None) -> list[Trip]:
        """Plan a trip whenever a robot is done with its last one; return those refused."""
        refused = []
        for _ in range(num_trips):
            now, robot = min(self.done)
            if until is not None and now > until:
                break
            trip = self.trip(robot)
            commitment = self.planner.plan(trip, now)
            if isinstance(commitment, Refusal):
                refused.append(trip)
                self.done = [(t, name) for t, name in self.done if name != robot]
                self.done.append((now + 5000, robot))
                continue
            self.told[robot].append(commitment)
            self.note(commitment)
            for changed in self.planner.changed:
                assert self.told[changed.robot][-1].trip is changed.trip
                self.told[changed.robot][-1] = changed
                self.note(changed)
        return refused

    def block(self, obstacle: Obstacle, now: int) -> tuple[str, ...]:
        """Let an obstacle turn up."""
        concerned = self.planner.block(obstacle, now)
        for robot in concerned:
            self.told[robot][-1] = self.planner.commitment(robot)
            self.note(self.told[robot][-1])
        return concerned

    def retime(self, paths: Mapping[str, Trajectory], now: int) -> None:
        """Begin anew, from where robots are, with the same paths at other times."""
        self.planner.retime(paths, now)
        self.robots = tuple(replace(robot, start=paths[robot.id].start) for robot in self.robots)
        for robot in self.robots:
            self.told[robot.id] = [self.planner.commitment(robot.id)]
            self.note(self.told[robot.id][0])
        self.status = Status.STOPPED

    def note(self, commitment: Commitment) -> None:
        """Note where a robot will rest, and when it is done."""
        self.rests[commitment.robot] = commitment.rest
        self.done = [(t, name) for t, name in self.done if name != commitment.robot]
        self.done.append((max(commitment.served, commitment.trajectory.end), commitment.robot))

    def driven(self) -> dict[str, Trajectory]:
        """Return all that each robot has driven, and will, one trip after the other."""
        return {robot.id: joined(robot, self.told[robot.id]) for robot in self.robots}

    def record(self, obstacles=()):
        """Return the plan file's content of all that is driven."""
        tours = {
            name: tuple(visit for c in told if c.trip for visit in c.trip.visits)
            for name, told in self.told.items()
        }
        plan = Plan(self.status, self.driven(), tours, {}, None if self.status else "begun late")
        site = replace(site_of(self.layout), obstacles=tuple(obstacles))
        scenario = Scenario("traffic", site, {self.type.name: self.type}, self.robots, ())
        return record_plan(scenario, plan, seed=0, version="")


def joined(robot: Robot, told: list[Commitment]) -> Trajectory:
    """Join the motions of trips that were each planned once the one before was over."""
    pieces, timing, stops = [], [], []
    for commitment in told:
        path = commitment.trajectory
        pieces += path.pieces
        timing += path.timing
        stops += [replace(stop, visit=len(stops)) for stop in path.stops]
    pieces = [replace(piece, id=k) for k, piece in enumerate(pieces)]
    return Trajectory(robot.id, robot.start, tuple(pieces), tuple(timing), tuple(stops))
