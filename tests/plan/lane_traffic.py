"""Random trips between endpoints without an end, and what robots drove, for the judge."""

import heapq
import random
from dataclasses import replace

from clearway.formats.recording import record_plan
from clearway.model import (
    Commitment,
    Layout,
    Plan,
    Robot,
    Scenario,
    Status,
    Trajectory,
    Trip,
    Visit,
)
from clearway.plan.lane_trips import LaneTrips
from clearway.world.channels import agv_type, lane_grid, site_of
from clearway.world.dynamic_map import DynamicMap

LAYOUTS = ("bidirectional", "compact", "one_way")


class Traffic:
    """Robots that drive from one random endpoint to the next, ten seconds of service at each."""

    def __init__(self, layout: Layout, num_robots: int, turn_seconds=0.0, seed=0, **options):
        self.layout = layout
        self.grid = lane_grid(layout)
        self.type = agv_type(layout, turn_seconds)
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
        self.now = 0

    def trip(self, robot: str, service: float = 10.0) -> Trip:
        """Return a trip to a random endpoint that nobody owns."""
        owned = set(self.rests.values())
        name = self.random.choice(sorted(set(self.grid.endpoints) - owned))
        pose = self.grid.centre(self.grid.endpoints[name].cell)
        return Trip(robot, (Visit(None, pose, service),), "order", goals=(name,))

    def run(self, num_trips: int) -> None:
        """Plan a trip whenever a robot is done with its last one."""
        done = [(0, robot.id) for robot in self.robots]
        heapq.heapify(done)
        for _ in range(num_trips):
            self.now, robot = heapq.heappop(done)
            trip = self.trip(robot)
            commitment = self.planner.plan(trip, self.now)
            assert isinstance(commitment, Commitment), commitment
            self.rests[robot] = trip.goals[0]
            self.told[robot].append(commitment)
            for changed in self.planner.changed:
                assert self.told[changed.robot][-1].trip is changed.trip
                self.told[changed.robot][-1] = changed
                done = [(t, name) for t, name in done if name != changed.robot]
                heapq.heapify(done)
                heapq.heappush(done, (changed.served, changed.robot))
            heapq.heappush(done, (commitment.served, robot))

    def driven(self) -> dict[str, Trajectory]:
        """Return all that each robot has driven, and will, one trip after the other."""
        return {robot.id: joined(robot, self.told[robot.id]) for robot in self.robots}

    def record(self):
        """Return the plan file's content of all that is driven."""
        tours = {
            name: tuple(visit for c in told for visit in c.trip.visits)
            for name, told in self.told.items()
        }
        plan = Plan(Status.SOLVED, self.driven(), tours, {})
        site = site_of(self.layout)
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
