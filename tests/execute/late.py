"""A small fleet that is late: it stops at random, drives slowly, and loses reports."""

import random
from dataclasses import replace

from clearway.execute.course import Course
from clearway.formats.sampling import sample
from clearway.model import Piece, PlanRecord, Robot, Site, Status, Trajectory
from clearway.validate import validate_plan

STEP = 100


class Late:
    """Moves robots by their grants, step by step, and remembers what each has driven when."""

    def __init__(self, commitments, executor, seed, *, stops=0.01, slow=0.3, lost=0.3):
        self.rng = random.Random(seed)
        self.executor = executor
        self.commitments = dict(commitments)
        self.courses = {r: Course(c.trajectory) for r, c in commitments.items()}
        self.progress = dict.fromkeys(commitments, 0)
        self.driven = {r: ([], []) for r in commitments}
        self.starts = {r: c.trajectory.start for r, c in commitments.items()}
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
            if self.now >= self.stopped[robot] and self.rng.random() < self.stops:
                self.stopped[robot] = self.now + self.rng.randrange(1000, 15000)
            if self.now >= self.stopped[robot]:
                before = self.progress[robot]
                self.progress[robot] = self.advanced(robot, course, granted)
                self.remember(robot, before, self.progress[robot])
        for robot in self.courses:
            if self.rng.random() >= self.lost:
                self.executor.report(robot, self.progress[robot])

    def advanced(self, robot, course, granted):
        """How far a robot comes within a step: never ahead of the plan, waits skipped if late."""
        left, tick = STEP, self.progress[robot]
        last = min(self.now, course.stands_until(granted))
        while True:
            tick = max(tick, min(course.skipped(tick, self.now), last))
            stretch = course.stretches[course.index(tick)]
            pace = self.speed[robot] if stretch.piece else 1.0
            move = min(last - tick, stretch.end - tick, int(left * pace))
            if stretch.is_wait or move <= 0:
                return tick
            tick += move
            left -= round(move / pace)

    def remember(self, robot, before, after):
        """Note what has been driven in the step that ends now, evenly over its time."""
        parts = []
        for stretch in self.courses[robot].stretches:
            low, high = max(before, stretch.begin), min(after, stretch.end)
            if stretch.piece is not None and low < high:
                parts.append((stretch, low, high))
        pieces, timing = self.driven[robot]
        begin = self.now - STEP
        for i, (stretch, low, high) in enumerate(parts):
            share = (high - low) / stretch.duration
            twist = tuple(share * v for v in stretch.piece.twist)
            start = stretch.piece.at((low - stretch.begin) / stretch.duration)
            pieces.append(Piece(len(pieces), stretch.piece.mode, start, twist))
            edges = (begin + STEP * i // len(parts), begin + STEP * (i + 1) // len(parts))
            timing.append(edges)

    def renew(self, commitments):
        """Put robots on other motions, where they go on at the tick that the ledger gives them."""
        self.executor.commit(commitments, self.now)
        for robot, commitment in commitments.items():
            self.commitments[robot] = commitment
            self.courses[robot] = Course(commitment.trajectory)
            self.progress[robot] = self.executor.reserve(robot)[0]

    def retime(self):
        """Everybody takes the times to be expected for those of the plan."""
        projected = self.executor.projected(self.now)
        self.renew({r: replace(self.commitments[r], trajectory=t) for r, t in projected.items()})

    def overlaps(self, types):
        """What the judge finds of bodies in each other; ``types`` by robot."""
        paths = {
            robot: Trajectory(robot, self.starts[robot], tuple(pieces), tuple(timing))
            for robot, (pieces, timing) in self.driven.items()
        }
        return overlaps(paths, types)


def from_now(trajectory, now):
    """A trajectory without what is before ``now``, which becomes tick 0."""
    pieces, timing, start = [], [], trajectory.start
    for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
        if end <= now:
            start = piece.end
            continue
        share = max(0, now - begin) / (end - begin)
        twist = tuple((1.0 - share) * value for value in piece.twist)
        pieces.append(replace(piece, start=piece.at(share), twist=twist))
        timing.append((max(now, begin) - now, end - now))
    start = pieces[0].start if pieces else start
    return Trajectory(trajectory.robot, start, tuple(pieces), tuple(timing))


def overlaps(paths, types):
    """What the judge finds of bodies in each other on trajectories; ``types`` by robot."""
    points = [p for path in paths.values() for p in (path.start, path.final_pose)]
    xs, ys = [p.x for p in points], [p.y for p in points]
    low, high = (min(xs) - 50, min(ys) - 50), (max(xs) + 50, max(ys) + 50)
    ends = [path.end / 1000.0 for path in paths.values()]
    record = PlanRecord(
        scenario="late",
        system="late",
        seed=0,
        status=Status.SOLVED,
        site=Site(bounds=(low, (high[0], low[1]), high, (low[0], high[1]))),
        robot_types={kind.name: kind for kind in types.values()},
        robots=tuple(Robot(r, types[r].name, path.start) for r, path in paths.items()),
        tours={},
        tracks={r: sample(path, False) for r, path in paths.items()},
        assignment={},
        sum_of_costs=sum(ends),
        makespan=max(ends),
    )
    return [v for v in validate_plan(record) if v.kind == "conflict"]
