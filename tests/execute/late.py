"""A small fleet that is late: it stops at random, drives slowly, and loses reports."""

import itertools
import random

from clearway.execute.course import Course
from clearway.formats.sampling import sample
from clearway.model import Piece, PlanRecord, Pose, Robot, Site, Status, Trajectory
from clearway.validate import validate_plan

STEP = 100


class Late:
    """Moves robots by their grants, step by step, and remembers how far each came when."""

    def __init__(self, commitments, executor, seed, *, stops=0.01, slow=0.3, lost=0.3):
        self.rng = random.Random(seed)
        self.executor = executor
        self.commitments = dict(commitments)
        self.courses = {r: Course(c.trajectory) for r, c in commitments.items()}
        self.progress = dict.fromkeys(commitments, 0)
        self.log = {robot: [0] for robot in commitments}
        self.speed = {r: 0.6 if self.rng.random() < slow else 1.0 for r in commitments}
        self.stops, self.lost = stops, lost
        self.stopped = dict.fromkeys(commitments, 0)
        self.now = 0
        executor.commit(commitments, 0)

    @property
    def is_done(self):
        return all(self.progress[r] >= c.trajectory.end for r, c in self.commitments.items())

    def step(self):
        """One period: everybody is granted, drives and, with luck, is heard of."""
        self.now += STEP
        for robot, course in self.courses.items():
            granted = self.executor.grant(robot)
            if self.rng.random() < self.stops:
                self.stopped[robot] = self.now + self.rng.randrange(1000, 15000)
            if self.now >= self.stopped[robot]:
                self.progress[robot] = self.advanced(robot, course, granted)
            self.log[robot].append(self.progress[robot])
        for robot in self.courses:
            if self.rng.random() >= self.lost:
                self.executor.report(robot, self.progress[robot])

    def advanced(self, robot, course, granted):
        left, tick = STEP, self.progress[robot]
        while left > 0:
            tick = min(course.skipped(tick, self.now), course.stands_until(granted))
            stretch = course.stretches[course.index(tick)]
            ahead = min(self.now, course.stands_until(granted), stretch.end) - tick
            if stretch.is_wait or ahead <= 0:
                return max(tick, self.progress[robot])
            pace = self.speed[robot] if stretch.piece else 1.0
            move = min(ahead, int(left * pace))
            if move <= 0:
                return tick
            tick += move
            left -= round(move / pace)
        return tick


def executed(commitment, log):
    """What a robot has done, as a trajectory in true time."""
    course = Course(commitment.trajectory)
    pieces, timing = [], []
    for k, (a, b) in enumerate(itertools.pairwise(log)):
        parts = []
        for stretch in course.stretches:
            low, high = max(a, stretch.begin), min(b, stretch.end)
            if stretch.piece is not None and low < high:
                parts.append((stretch, low, high))
        edges = [k * STEP + STEP * i // max(1, len(parts)) for i in range(len(parts) + 1)]
        for (stretch, low, high), t0, t1 in zip(parts, edges, edges[1:], strict=False):
            share = (high - low) / stretch.duration
            twist = tuple(share * v for v in stretch.piece.twist)
            start = stretch.piece.at((low - stretch.begin) / stretch.duration)
            pieces.append(Piece(len(pieces), stretch.piece.mode, start, twist))
            timing.append((t0, t1))
    start = commitment.trajectory.start
    return Trajectory(commitment.robot, start, tuple(pieces), tuple(timing))


def overlaps(commitments, logs, types):
    """What the judge finds of bodies in each other; ``types`` by robot."""
    paths = {robot: executed(c, logs[robot]) for robot, c in commitments.items()}
    points = [p for path in paths.values() for p in (path.start, path.final_pose)]
    xs, ys = [p.x for p in points], [p.y for p in points]
    low, high = (min(xs) - 50, min(ys) - 50), (max(xs) + 50, max(ys) + 50)
    site = Site(bounds=(low, (high[0], low[1]), high, (low[0], high[1])))
    ends = [path.end / 1000.0 for path in paths.values()]
    record = PlanRecord(
        scenario="late",
        system="late",
        seed=0,
        status=Status.SOLVED,
        site=site,
        robot_types={kind.name: kind for kind in types.values()},
        robots=tuple(Robot(r, types[r].name, Pose(*paths[r].start)) for r in commitments),
        tours={},
        tracks={r: sample(path, False) for r, path in paths.items()},
        assignment={},
        sum_of_costs=sum(ends),
        makespan=max(ends),
    )
    return [v for v in validate_plan(record) if v.kind == "conflict"]
