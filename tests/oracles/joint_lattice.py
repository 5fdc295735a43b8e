"""Joint brute force over the lattices of all robots: what conflict-based search must find.

A robot's lattice is walked pose by pose and its motions are sampled in time; bodies are Shapely's.
The search knows nothing of conflicts beyond "these two motions, so many slots apart, meet": the
robot that is earliest in time moves on, or waits for a slot, and nobody may meet what another
does meanwhile. Only the analytic ways to a goal are asked of the core.
"""

import heapq
import itertools
import math
from dataclasses import dataclass

import numpy as np
import shapely

from clearway import _core
from clearway.model import LOAD_CHANGE, Footprint, Pose, Problem, to_ticks
from clearway.motion import LATTICE_HEADINGS, lattice_model, model_of
from clearway.motion.native import native_table

TICK_STEP = 10  # between samples
TOLERANCE = 0.008  # a gap so near to what is required, or an overlap so slight, is unclear (m)
LEAST_GAP = 0.01  # kept where the clearance asks for less (m)
WORDS, LOOKED_AT, REACH = 2, 6, 12.0
SAME = 1e-6  # costs that differ by less are equal
TURNING, SWITCH, WAITING = 2.0, 3.0, 0.1


class Unclear(Exception):
    """A gap lies too near to the required one, or the search is too large, to say anything."""


class Shape:
    """A footprint that can be put at many poses at once: a polygon, or a point with a radius."""

    def __init__(self, footprint: Footprint) -> None:
        self.radius = footprint.radius
        self.reach = footprint.circumradius
        parts = [shapely.Polygon(part) for part in footprint.parts]
        self.rings = {}
        for shrunk in (0.0, TOLERANCE) if parts else ():
            outline = shapely.union_all(parts).buffer(-shrunk, join_style="mitre")
            self.rings[shrunk] = np.asarray(outline.exterior.coords)

    def at(self, poses: np.ndarray, shrunk: float = 0.0) -> np.ndarray:
        """Return geometries at poses of shape (n, 3), all their edges moved inwards (m)."""
        if not self.rings:
            return shapely.points(poses[:, :2])
        x, y = self.rings[shrunk].T
        c, s = np.cos(poses[:, 2, None]), np.sin(poses[:, 2, None])
        corners = [poses[:, 0, None] + c * x - s * y, poses[:, 1, None] + s * x + c * y]
        return shapely.polygons(np.stack(corners, axis=-1))


def meets(a: Shape, at: np.ndarray, other, more: float, required: float) -> bool:
    """Whether a body at some of its poses overlaps geometries swollen by ``more`` (m)."""
    gaps = shapely.distance(a.at(at), other) - a.radius - more
    if gaps.min() >= required + TOLERANCE:
        return False
    if a.rings:
        gaps = shapely.distance(a.at(at, TOLERANCE), other) - more - TOLERANCE
    if gaps.min() <= -TOLERANCE:
        return True
    raise Unclear(f"a gap of about {gaps.min():.3f} m")


def moved(pose: Pose, twist, shares: np.ndarray) -> np.ndarray:
    """Return the poses, of shape (n, 3), after shares of a constant twist."""
    a, b, c = twist
    turn = c * shares
    if c == 0.0:
        dx, dy = a * shares, b * shares
    else:
        dx = (a * np.sin(turn) - b * (1.0 - np.cos(turn))) / c
        dy = (a * (1.0 - np.cos(turn)) + b * np.sin(turn)) / c
    cos, sin = math.cos(pose.theta), math.sin(pose.theta)
    x, y = pose.x + cos * dx - sin * dy, pose.y + sin * dx + cos * dy
    return np.stack([x, y, pose.theta + turn], axis=-1)


def end_of(pose: Pose, twist) -> Pose:
    """Return the pose after a twist."""
    return Pose(*moved(pose, twist, np.ones(1))[0].tolist())


@dataclass(frozen=True, eq=False)
class Motion:
    """What a robot does from a pose on: ``poses`` every `TICK_STEP`, of shape (n, 3)."""

    slots: int
    first: int  # mode; -1: it does not move
    last: int
    cost: float
    target: tuple[int, int] | None  # leg and node; None: all is done
    poses: np.ndarray


class Lattice:
    """All poses of one robot and what it can do there, by (leg, node)."""

    def __init__(
        self, problem: Problem, index: int, slot: int, paper: bool, all_ties: bool
    ) -> None:
        self.all_ties, self.has_ties = all_ties, False
        robot = problem.robots[index]
        kind = problem.robot_types[robot.type]
        model = lattice_model(kind, model_of(kind, LATTICE_HEADINGS))
        self.table = native_table(model)
        self.objective = _core.Objective()
        self.objective.time = not paper
        self.slot, self.paper = slot, paper
        self.pause = math.ceil(to_ticks(kind.mode_switch) / slot)
        self.arm = model.turn_arm
        self.shape = Shape(kind.footprint)
        self.required = max(kind.clearance, LEAST_GAP)
        names = [mode.name for mode in model.modes]
        assert all(mode.rest for mode in model.modes)
        self.primitives = [
            (names.index(m.mode), m.twist, self.whole(to_ticks(m.duration))) for m in model.motions
        ]
        self.walls = self._walls(problem, robot.type)
        self.visits = problem.tours[robot.id]
        assert not any(LOAD_CHANGE[visit.load] for visit in self.visits)
        self.stops = [Pose(*robot.start), *(Pose(*visit.pose) for visit in self.visits)]
        for stop in self.stops:
            if not self.is_clear([((0.0, 0.0, 0.0), 0, 0)], stop):
                raise Unclear("a stop is not free")
        self.poses: dict[tuple[int, int], Pose] = {}
        self.numbers: dict[tuple, int] = {}
        self.motions: dict[tuple[int, int], list[Motion]] = {}
        for leg in range(len(self.visits)):
            self._node(leg, self.stops[leg])
        pending = list(self.poses)
        while pending:
            known = len(self.poses)
            at = pending.pop()
            self.motions[at] = [*self._steps(at), *self._shots(at)]
            pending += list(self.poses)[known:]
        self.to_go = self._look_back()

    def whole(self, ticks: int) -> int:
        """Round ticks up to whole slots."""
        return -(-ticks // self.slot) * self.slot

    @staticmethod
    def _walls(problem: Problem, type_name: str):
        walls = [shapely.Polygon(problem.site.bounds).exterior]
        for obstacle in problem.site.obstacles:
            assert obstacle.polygon is not None
            if obstacle.stops(type_name, False):
                walls.append(shapely.Polygon(obstacle.polygon))
        return shapely.union_all(walls)

    def _node(self, leg: int, pose: Pose) -> tuple[int, int]:
        quarter = round((pose.theta - self.stops[leg].theta) / (math.pi / 2.0)) % 4
        key = (leg, round(pose.x, 5), round(pose.y, 5), quarter)
        at = (leg, self.numbers.setdefault(key, len(self.numbers)))
        self.poses.setdefault(at, pose)
        return at

    def sampled(self, steps, pose: Pose, stand: int = 0) -> np.ndarray:
        """Return poses along steps of (twist, ticks, mode), then standing, every `TICK_STEP`."""
        times = np.arange(0, sum(ticks for _, ticks, _ in steps) + stand + 1, TICK_STEP)
        poses, begin = np.empty((len(times), 3)), 0
        for twist, ticks, _ in steps:
            during = (times >= begin) & (times < begin + ticks)
            poses[during] = moved(pose, twist, (times[during] - begin) / max(1, ticks))
            pose, begin = end_of(pose, twist), begin + ticks
        poses[times >= begin] = [*pose]
        return poses

    def is_clear(self, steps, pose: Pose) -> bool:
        """Whether a body on its way keeps off all walls."""
        poses = self.sampled(steps, pose)
        apart = shapely.distance(shapely.points(poses[:, :2]), self.walls)
        near = poses[apart < self.shape.reach + self.required + TOLERANCE]
        return not len(near) or not meets(self.shape, near, self.walls, 0.0, self.required)

    def _cost(self, steps) -> float:
        """Return what steps cost; in time their ticks, else eq. 21 with changes of mode inside."""
        if not self.paper:
            return sum(ticks for _, ticks, _ in steps)
        moving = [step for step in steps if step[2] >= 0]
        total = SWITCH * sum(a[2] != b[2] for a, b in itertools.pairwise(moving))
        total += WAITING / 1000.0 * sum(ticks for _, ticks, mode in steps if mode < 0)
        for (a, b, c), _, _ in moving:
            length = math.hypot(a, b) or abs(c) * self.arm
            total += length * (TURNING if c else 1.0)
        return total

    def _steps(self, at: tuple[int, int]):
        leg, pose = at[0], self.poses[at]
        for mode, twist, ticks in self.primitives:
            steps = [(twist, ticks, mode)]
            if self.is_clear(steps, pose):
                to = self._node(leg, end_of(pose, twist))
                cost = self._cost(steps)
                yield Motion(ticks // self.slot, mode, mode, cost, to, self.sampled(steps, pose))

    def _shots(self, at: tuple[int, int]):
        leg, pose = at[0], self.poses[at]
        goal = self.stops[leg + 1]
        if math.hypot(pose.x - goal.x, pose.y - goal.y) > REACH:
            return
        theta = math.remainder(pose.theta, math.tau)
        ways = _core.connections(
            self.table,
            self.objective,
            _core.Pose(pose.x, pose.y, theta),
            _core.Pose(*goal),
            LOOKED_AT,
        )
        ways = [[((s.twist.a, s.twist.b, s.twist.c), s.duration, s.mode) for s in w] for w in ways]
        ways.sort(key=self._cost)
        good = [w for w in ways if not self._begins_with_primitive(w) and self.is_clear(w, pose)]
        last = leg + 1 == len(self.visits)
        # The last arrival is the first moment of the final rest, however many visits that serves.
        rests = all(visit.pose == self.visits[-1].pose for visit in self.visits[leg:])
        service = self.whole(to_ticks(self.visits[leg].service))
        for way in self._best(good, len(ways)):
            cost, ticks = self._cost(way), sum(ticks for _, ticks, _ in way)
            rounded = self.whole(ticks)
            if way:
                twist, slow, mode = way[-1]
                way = [*way[:-1], (twist, slow + rounded - ticks, mode)]
            if not self.paper:
                cost = rounded + (0 if rests else service)
            yield Motion(
                (rounded + service) // self.slot,
                way[0][2] if way else -1,
                way[-1][2] if way else -1,
                cost,
                None if last else self._node(leg + 1, self.stops[leg + 1]),
                self.sampled(way, pose, service),
            )

    def _best(self, good: list, found: int) -> list:
        """Return the cheapest ways; of those that tie for the last place, all or none."""
        if len(good) <= WORDS:
            return good
        last = self._cost(good[WORDS - 1])
        tied = [way for way in good if abs(self._cost(way) - last) < SAME]
        sure = [way for way in good if self._cost(way) < last - SAME]
        alike = len({self._spelled(way) for way in tied}) == 1
        if alike or len(sure) + len(tied) <= WORDS:
            return good[:WORDS]
        if tied[-1] is good[-1] and found == LOOKED_AT:
            raise Unclear("more ways may cost the same than are looked at")
        self.has_ties = True
        return sure + tied if self.all_ties else sure

    @staticmethod
    def _spelled(way) -> tuple:
        return tuple((mode, *(round(v, 6) + 0.0 for v in twist)) for twist, _, mode in way)

    def _begins_with_primitive(self, way) -> bool:
        if not way:
            return False
        twist, _, mode = way[0]
        for own, other, _ in self.primitives:
            size = math.hypot(*other[:2]) or abs(other[2])
            share = (math.hypot(*twist[:2]) or abs(twist[2])) / size
            part = [v * share for v in other]
            if own == mode and share > 1.0 - 1e-9 and math.dist(part, twist) < 1e-6:
                return True
        return False

    def choices(self, at: tuple[int, int], mode: int):
        """Yield (motion, standing slots before it, cost with a change of mode, mode after it)."""
        for motion in self.motions[at]:
            pause, cost = 0, motion.cost
            if mode >= 0 and motion.first >= 0 and motion.first != mode:
                pause = self.pause
                cost += self.waits(pause) + (SWITCH if self.paper else 0.0)
            yield motion, pause, cost, motion.last if motion.last >= 0 else mode

    def waits(self, slots: int) -> float:
        """Return the cost of waiting for some slots."""
        return slots * self.slot * (WAITING / 1000.0 if self.paper else 1.0)

    def _look_back(self) -> dict:
        """Return the least cost to the end by place and mode, as if the robot were alone."""
        before: dict = {}
        queue = []
        modes = range(-1, len(self.table.rest))
        for at in self.motions:
            for mode in modes:
                for motion, _, cost, after in self.choices(at, mode):
                    if motion.target is None:
                        queue.append((cost, (at, mode)))
                    else:
                        before.setdefault((motion.target, after), []).append((cost, (at, mode)))
        heapq.heapify(queue)
        known: dict = {}
        while queue:
            cost, state = heapq.heappop(queue)
            if state in known:
                continue
            known[state] = cost
            for more, previous in before.get(state, ()):
                if previous not in known:
                    heapq.heappush(queue, (cost + more, previous))
        return known


@dataclass(frozen=True)
class Stage:
    """How far one robot is: at ``at`` from slot ``end`` on, after ``motion``."""

    at: tuple[int, int] | None  # None: all its visits are done
    mode: int
    begin: int  # of the motion, after standing for a change of mode
    end: int
    motion: Motion | None
    stood: int = 0  # slots before the motion, for a change of mode
    rests: bool = False


class JointSearch:
    """A* over what all robots do; ``expansions`` bounds it."""

    def __init__(
        self, problem: Problem, slot: int, paper: bool, expansions: int, all_ties: bool = True
    ) -> None:
        self.lattices = [
            Lattice(problem, i, slot, paper, all_ties) for i in range(len(problem.robots))
        ]
        self.slot, self.expansions = slot, expansions
        self._met: dict = {}
        for a, b in itertools.combinations(self.lattices, 2):
            for p, q in itertools.product(a.stops, b.stops):
                # Stops nearer than the gap would loosen what is required of the pair.
                self._bodies_meet(a, np.array([[*p]]), b, np.array([[*q]]))

    def alone(self) -> list[float]:
        """Return each robot's least cost as if it were alone; infinite: none."""
        return [x.to_go.get(((0, 0), -1), math.inf) for x in self.lattices]

    def _bodies_meet(self, a: Lattice, at: np.ndarray, b: Lattice, there: np.ndarray) -> bool:
        at, there = np.broadcast_arrays(at, there)
        apart = np.hypot(*(at[:, :2] - there[:, :2]).T)
        required = max(a.required, b.required)
        near = apart < a.shape.reach + b.shape.reach + required + TOLERANCE
        if not near.any():
            return False
        return meets(a.shape, at[near], b.shape.at(there[near]), b.shape.radius, required)

    def _during(self, i: int, stage: Stage, begin: int, end: float) -> np.ndarray:
        """Return a robot's poses from a slot to another; one row where it stands."""
        if stage.motion is None or stage.rests:
            lattice = self.lattices[i]
            pose = lattice.stops[-1] if stage.at is None else lattice.poses[stage.at]
            return np.array([[*pose]])
        per = self.slot // TICK_STEP
        poses = stage.motion.poses
        if stage.stood:
            poses = np.concatenate([np.repeat(poses[:1], stage.stood * per, axis=0), poses])
        first = stage.begin - stage.stood
        return poses[(begin - first) * per : int(end - first) * per + 1]

    def _clash(self, i: int, new: Stage, j: int, other: Stage) -> bool:
        """Whether what a robot begins to do meets what another is doing."""
        begin = new.begin - new.stood
        end = math.inf if new.rests else new.end
        end = min(end, math.inf if other.rests else other.end)
        doing = [
            (
                k,
                s.at,
                id(s.motion),
                s.stood,
                begin - (s.begin - s.stood) if s.motion else 0,
                s.rests,
            )
            for k, s in ((i, new), (j, other))
        ]
        key = (*doing, end - begin)
        if key not in self._met:
            if math.isinf(end):
                end = begin
            mine = self._during(i, new, begin, end)
            theirs = self._during(j, other, begin, end)
            self._met[key] = self._bodies_meet(self.lattices[i], mine, self.lattices[j], theirs)
        return self._met[key]

    def _next(self, i: int, stage: Stage):
        """Yield what a robot may do next, and its cost."""
        lattice, t = self.lattices[i], stage.end
        if stage.at is None:
            yield Stage(None, stage.mode, t, t, None, rests=True), 0.0
            return
        yield Stage(stage.at, stage.mode, t, t + 1, None), lattice.waits(1)
        for motion, pause, cost, mode in lattice.choices(stage.at, stage.mode):
            begin = t + pause
            yield Stage(motion.target, mode, begin, begin + motion.slots, motion, pause), cost

    def __call__(self) -> float:
        """Return the least cost (m, or ticks) of a plan without conflict; infinite: none."""
        start = tuple(Stage((0, 0), -1, 0, 0, None) for _ in self.lattices)
        left = sum(self.alone())
        if math.isinf(left):
            return math.inf
        count = itertools.count()
        queue = [(left, next(count), 0.0, start)]
        seen = set()
        while queue:
            f, _, g, stages = heapq.heappop(queue)
            key = self._key(stages)
            if key in seen:
                continue
            seen.add(key)
            if all(stage.rests for stage in stages):
                return g
            if len(seen) > self.expansions:
                raise Unclear("the joint search is too large")
            i = min(
                (k for k in range(len(stages)) if not stages[k].rests), key=lambda k: stages[k].end
            )
            for new, cost in self._next(i, stages[i]):
                h = self._left(i, new) - self._left(i, stages[i])
                if math.isinf(h):
                    continue
                others = ((j, s) for j, s in enumerate(stages) if j != i)
                if any(self._clash(i, new, j, s) for j, s in others):
                    continue
                after = (*stages[:i], new, *stages[i + 1 :])
                heapq.heappush(queue, (f + cost + h, next(count), g + cost, after))
        return math.inf

    def _left(self, i: int, stage: Stage) -> float:
        if stage.at is None:
            return 0.0
        return self.lattices[i].to_go.get((stage.at, stage.mode), math.inf)

    @staticmethod
    def _key(stages) -> tuple:
        """Return what the future depends on, times counted from the earliest robot's."""
        now = min((s.end for s in stages if not s.rests), default=0)
        return tuple(
            (s.at, s.mode, s.rests, 0 if s.rests else s.end - now)
            + ((id(s.motion), s.stood) if s.end > now and not s.rests else ())
            for s in stages
        )


def least_cost(problem: Problem, slot: int, paper: bool, expansions: int) -> tuple[float, float]:
    """Return what the best plan costs (m, or ticks), and what it would if nobody met anybody.

    Infinite where there is none. Raises `Unclear` where rounding decides.
    """
    search = JointSearch(problem, slot, paper, expansions)
    best, alone = search(), sum(search.alone())
    if any(lattice.has_ties for lattice in search.lattices):
        # Which of the ways that tie are on the graph must not matter.
        other = JointSearch(problem, slot, paper, expansions, all_ties=False)()
        if best != other and not abs(best - other) < SAME:
            raise Unclear("it matters which of the ways are taken that cost the same")
    return best, alone
