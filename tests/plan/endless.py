"""A small hall with bays, trips in it, and the judge's word on all that its robots drove."""

from dataclasses import replace

from tests.plan.rooms import CART, EAST, judged, rectangle, room

from clearway.model import (
    Commitment,
    Plan,
    Pose,
    Problem,
    Robot,
    RobotType,
    Scenario,
    Site,
    Status,
    Stop,
    Trajectory,
    Trip,
    Visit,
    Zone,
)
from clearway.plan.tail_trips import TailTrips

BAYS = tuple(f"bay-{i + 1}" for i in range(6))


def hall(*obstacles, width=24.0, height=12.0, bays=6) -> Site:
    """A hall with bays 1.8 m apart along its left wall, in which carts look into it."""
    poses = [Pose(1.0, 1.5 + 1.8 * i, EAST) for i in range(bays)]
    zones = tuple(
        Zone(name, "parking", rectangle(p.x - 0.5, p.y - 0.3, p.x + 0.5, p.y + 0.3), p)
        for name, p in zip(BAYS, poses, strict=False)
    )
    site = room(width, height, *obstacles)
    return Site(site.bounds, site.obstacles, zones)


def fleet(site: Site, *starts: Pose, kind: RobotType = CART) -> Scenario:
    """Robots a, b, c, ... at their starts."""
    robots = tuple(
        Robot(name, kind.name, pose) for name, pose in zip("abcdefgh", starts, strict=False)
    )
    return Scenario("hall", site, {kind.name: kind}, robots, ())


def parked(site: Site, count: int, kind: RobotType = CART) -> Scenario:
    """Robots in the first bays of a site."""
    return fleet(site, *(zone.pose for zone in site.zones_of("parking")[:count]), kind=kind)


def trip(robot: str, *visits: Visit, rests: tuple[str, ...] = BAYS) -> Trip:
    """A trip that ends in any bay."""
    return Trip(robot, visits, "order", rests=rests)


class Endless:
    """What robots have been committed to, one after the other."""

    def __init__(self, scenario: Scenario, trips: TailTrips) -> None:
        self.scenario, self.trips = scenario, trips
        self.past: dict[str, list[tuple[int, Commitment]]] = {
            robot.id: [(0, trips.commitment(robot.id))] for robot in scenario.robots
        }

    def commit(self, wanted: Trip, now: int, effort: int = 1) -> Commitment:
        """Plan a trip, which must be found."""
        answer = self.trips.plan(wanted, now, effort)
        assert isinstance(answer, Commitment), answer
        self.past[wanted.robot].append((now, answer))
        return answer

    def note(self, robot: str, now: int) -> None:
        """Take over what a robot has been committed to otherwise."""
        self.past[robot].append((now, self.trips.commitment(robot)))

    def judged(self, site: Site | None = None):
        """What the judge finds wrong with all that was driven, and all that is committed to."""
        trajectories, tours, tasks = {}, {}, {}
        for robot, parts in self.past.items():
            pieces, timing, stops, visits = [], [], [], []
            ends = [now for now, _ in parts[1:]] + [10**9]
            for (begin, held), end in zip(parts, ends, strict=True):
                part = held.trajectory.part(begin, end)
                pieces += part.pieces
                timing += part.timing
                for stop in held.trajectory.stops:
                    # A trip that goes on another way keeps the stops that it has made.
                    if begin < stop.leave <= end:
                        stops.append(Stop(len(stops), stop.arrive, stop.leave))
                        name = f"{robot}{len(visits)}"
                        visits.append(replace(held.trip.visits[stop.visit], task=name))
            start = parts[0][1].trajectory.start
            path = Trajectory(robot, start, tuple(pieces), tuple(timing), tuple(stops))
            trajectories[robot] = path
            tours[robot] = tuple(visits)
            tasks[robot] = tuple(visit.task for visit in visits)
        problem = Problem(
            site or self.scenario.site, self.scenario.robot_types, self.scenario.robots, tours
        )
        return judged(problem, Plan(Status.SOLVED, trajectories, tours, tasks))
