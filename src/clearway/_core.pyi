"""
Native search core: geometry, motion tables, space, search, multi-robot search, assignment.
"""

from collections.abc import Callable, Sequence
import enum
from typing import Annotated

import numpy
from numpy.typing import NDArray


class Pose:
    """Position (m) and heading (rad)."""

    def __init__(self, x: float, y: float, theta: float) -> None: ...

    @property
    def x(self) -> float: ...

    @property
    def y(self) -> float: ...

    @property
    def theta(self) -> float: ...

class Twist:
    """Body-frame displacement: along x (m), along y (m), turn (rad)."""

    def __init__(self, a: float, b: float, c: float) -> None: ...

    @property
    def a(self) -> float: ...

    @property
    def b(self) -> float: ...

    @property
    def c(self) -> float: ...

class Body:
    """Convex parts in the body frame, or a disc."""

    def __init__(self, parts: Sequence[Sequence[Sequence[float]]], disc_radius: float = 0.0) -> None: ...

    @property
    def circumradius(self) -> float: ...

    @property
    def inradius(self) -> float: ...

    def gap(self, pose: Pose, other: Body, other_pose: Pose) -> float:
        """Signed gap between two placed bodies (m)."""

class Obstacles:
    """Edges, discs and outlines of one layer."""

    def __init__(self, box: Sequence[float], segments: Sequence[Sequence[float]], discs: Sequence[Sequence[float]], solids: Sequence[Sequence[Sequence[float]]], bounds: Sequence[Sequence[float]]) -> None: ...

class Geodesic:
    """Shortest ways of a disc among obstacles, any angle."""

    def __init__(self, obstacles: Obstacles, radius: float) -> None: ...

    def __call__(self, start: Sequence[float], goal: Sequence[float]) -> float:
        """Length of the shortest way (m); infinite where there is none."""

class Statics:
    """Obstacles of one layer behind a distance field."""

    def __init__(self, obstacles: Obstacles, reach: float) -> None: ...

    def clearance(self, x: float, y: float) -> float:
        """Lower bound of the distance to the nearest obstacle (m)."""

    def gap(self, body: Body, pose: Pose) -> float:
        """Signed gap of a placed body (m)."""

    def clear(self, body: Body, start: Pose, motion: Twist, required: float = 0.0, slack: float = 0.0008) -> bool:
        """Whether a body keeps the required gap all along a motion."""

def goal_distances(statics: Statics, radius: float, goal: Sequence[float], cell: float, points: Sequence[Sequence[float]]) -> list[float]:
    """
    Obstacle-aware distances (m) of points to a goal for a disc of the given radius.
    """

NEVER: int = 1073741824

def reeds_shepp_length(x: float, y: float, phi: float) -> float:
    """
    Length of the shortest Reeds-Shepp curve from the origin, turning radius 1.
    """

def reeds_shepp_word(x: float, y: float, phi: float) -> list[tuple[int, float]]:
    """Segments of that curve: (1 left, 0 straight, -1 right; signed length)."""

class Family(enum.Enum):
    """Families of analytic connections."""

    REEDS_SHEPP = 0

    TURN_DRIVE_TURN = 1

    SLIDE = 2

    TRANSLATE = 3

class Step:
    """One part of a connection or of a primitive."""

    def __init__(self, mode: int, twist: Twist, duration: int) -> None: ...

    @property
    def mode(self) -> int: ...

    @property
    def twist(self) -> Twist: ...

    @property
    def duration(self) -> int: ...

class Primitive:
    """One short motion of a table."""

    def __init__(self, mode: int, twist: Twist, turn_steps: int, duration: int) -> None: ...

    @property
    def mode(self) -> int: ...

    @property
    def twist(self) -> Twist: ...

    @property
    def turn_steps(self) -> int: ...

    @property
    def duration(self) -> int: ...

    @property
    def allowed_from(self) -> int:
        """Modes in which it may begin, as bits; the last of 64: in none."""

    @allowed_from.setter
    def allowed_from(self, arg: int, /) -> None: ...

    @property
    def steps(self) -> list[Step]:
        """How it is driven; empty: evenly."""

    @steps.setter
    def steps(self, arg: Sequence[Step], /) -> None: ...

class Pace:
    """A mode at a speed."""

    def __init__(self, moving: int, course: int, speed: float) -> None: ...

    @property
    def moving(self) -> int: ...

    @property
    def course(self) -> int: ...

    @property
    def speed(self) -> float: ...

class Connection:
    """How one family of analytic curves is driven."""

    def __init__(self) -> None: ...

    @property
    def family(self) -> Family: ...

    @family.setter
    def family(self, arg: Family, /) -> None: ...

    @property
    def direction(self) -> float: ...

    @direction.setter
    def direction(self, arg: float, /) -> None: ...

    @property
    def radius(self) -> float: ...

    @radius.setter
    def radius(self, arg: float, /) -> None: ...

    @property
    def forward_speed(self) -> float: ...

    @forward_speed.setter
    def forward_speed(self, arg: float, /) -> None: ...

    @property
    def reverse_speed(self) -> float: ...

    @reverse_speed.setter
    def reverse_speed(self, arg: float, /) -> None: ...

    @property
    def forward_arc_speed(self) -> float: ...

    @forward_arc_speed.setter
    def forward_arc_speed(self, arg: float, /) -> None: ...

    @property
    def reverse_arc_speed(self) -> float: ...

    @reverse_arc_speed.setter
    def reverse_arc_speed(self, arg: float, /) -> None: ...

    @property
    def yaw_rate(self) -> float: ...

    @yaw_rate.setter
    def yaw_rate(self, arg: float, /) -> None: ...

    @property
    def forward(self) -> int: ...

    @forward.setter
    def forward(self, arg: int, /) -> None: ...

    @property
    def reverse(self) -> int: ...

    @reverse.setter
    def reverse(self, arg: int, /) -> None: ...

    @property
    def forward_left(self) -> int: ...

    @forward_left.setter
    def forward_left(self, arg: int, /) -> None: ...

    @property
    def forward_right(self) -> int: ...

    @forward_right.setter
    def forward_right(self, arg: int, /) -> None: ...

    @property
    def reverse_left(self) -> int: ...

    @reverse_left.setter
    def reverse_left(self, arg: int, /) -> None: ...

    @property
    def reverse_right(self) -> int: ...

    @reverse_right.setter
    def reverse_right(self, arg: int, /) -> None: ...

    @property
    def sideways_speed(self) -> float: ...

    @sideways_speed.setter
    def sideways_speed(self, arg: float, /) -> None: ...

    @property
    def left(self) -> int: ...

    @left.setter
    def left(self, arg: int, /) -> None: ...

    @property
    def right(self) -> int: ...

    @right.setter
    def right(self, arg: int, /) -> None: ...

    @property
    def rotate_left(self) -> int: ...

    @rotate_left.setter
    def rotate_left(self, arg: int, /) -> None: ...

    @property
    def rotate_right(self) -> int: ...

    @rotate_right.setter
    def rotate_right(self, arg: int, /) -> None: ...

class Objective:
    """What a search minimises."""

    def __init__(self) -> None: ...

    @property
    def time(self) -> bool: ...

    @time.setter
    def time(self, arg: bool, /) -> None: ...

    @property
    def turning(self) -> float: ...

    @turning.setter
    def turning(self, arg: float, /) -> None: ...

    @property
    def mode_switch(self) -> float: ...

    @mode_switch.setter
    def mode_switch(self, arg: float, /) -> None: ...

    @property
    def waiting(self) -> float: ...

    @waiting.setter
    def waiting(self, arg: float, /) -> None: ...

class MotionTable:
    """A robot's motions as a table."""

    def __init__(self) -> None: ...

    @property
    def headings(self) -> int: ...

    @headings.setter
    def headings(self, arg: int, /) -> None: ...

    @property
    def top_speed(self) -> float: ...

    @top_speed.setter
    def top_speed(self, arg: float, /) -> None: ...

    @property
    def rest(self) -> list[bool]: ...

    @rest.setter
    def rest(self, arg: Sequence[bool], /) -> None: ...

    @property
    def primitives(self) -> list[Primitive]: ...

    @primitives.setter
    def primitives(self, arg: Sequence[Primitive], /) -> None: ...

    @property
    def connections(self) -> list[Connection]: ...

    @connections.setter
    def connections(self, arg: Sequence[Connection], /) -> None: ...

    @property
    def turn_arm(self) -> float: ...

    @turn_arm.setter
    def turn_arm(self, arg: float, /) -> None: ...

    @property
    def switch_duration(self) -> int: ...

    @switch_duration.setter
    def switch_duration(self, arg: int, /) -> None: ...

    @property
    def has_modes(self) -> bool: ...

    @has_modes.setter
    def has_modes(self, arg: bool, /) -> None: ...

    @property
    def paces(self) -> list[Pace]:
        """What each mode is, where acceleration is limited."""

    @paces.setter
    def paces(self, arg: Sequence[Pace], /) -> None: ...

    @property
    def acceleration(self) -> float: ...

    @acceleration.setter
    def acceleration(self, arg: float, /) -> None: ...

    @property
    def deceleration(self) -> float: ...

    @deceleration.setter
    def deceleration(self, arg: float, /) -> None: ...

def ramp(length: float, enter: float, leave: float, top: float, acceleration: float, deceleration: float) -> list[tuple[float, int]]:
    """
    Steps of even speed (m, ticks) from one speed to another; none where it is too short.
    """

def connect(table: MotionTable, objective: Objective, start: Pose, goal: Pose, mode: int = -1) -> list[Step]:
    """Steps of the best obstacle-free connection between two poses."""

def connections(table: MotionTable, objective: Objective, start: Pose, goal: Pose, count: int) -> list[list[Step]]:
    """
    Steps of the best obstacle-free connections, at most `count`; mode -1 stands between modes.
    """

class TimedPiece:
    """A stretch of a trajectory."""

    def __init__(self, begin: int, end: int, start: Pose, twist: Twist, mode: int, body: int) -> None: ...

    @property
    def begin(self) -> int: ...

    @property
    def end(self) -> int: ...

    @property
    def start(self) -> Pose: ...

    @property
    def twist(self) -> Twist: ...

    @property
    def mode(self) -> int: ...

    @property
    def body(self) -> int: ...

class Leg:
    """Drive to a goal, then stand there."""

    def __init__(self, goal: Pose, service: int, body: int, not_before: int = 0) -> None: ...

class Model:
    """What all robots of one type share."""

    def __init__(self, bodies: Sequence[Body], statics: Sequence[Statics], table: MotionTable, fine: MotionTable, clearance: float) -> None: ...

    @property
    def num_bodies(self) -> int: ...

class Agent:
    """A robot of the team."""

    def __init__(self) -> None: ...

    @property
    def model(self) -> int: ...

    @model.setter
    def model(self, arg: int, /) -> None: ...

    @property
    def start(self) -> Pose: ...

    @start.setter
    def start(self, arg: Pose, /) -> None: ...

    @property
    def mode(self) -> int: ...

    @mode.setter
    def mode(self, arg: int, /) -> None: ...

    @property
    def ready(self) -> int: ...

    @ready.setter
    def ready(self, arg: int, /) -> None: ...

    @property
    def committed(self) -> list[TimedPiece]: ...

    @committed.setter
    def committed(self, arg: Sequence[TimedPiece], /) -> None: ...

    @property
    def legs(self) -> list[Leg]: ...

    @legs.setter
    def legs(self, arg: Sequence[Leg], /) -> None: ...

    @property
    def rest_body(self) -> int: ...

    @rest_body.setter
    def rest_body(self, arg: int, /) -> None: ...

    @property
    def fixed(self) -> bool: ...

    @fixed.setter
    def fixed(self, arg: bool, /) -> None: ...

    @property
    def bound(self) -> int: ...

    @bound.setter
    def bound(self, arg: int, /) -> None: ...

class SearchParams:
    """Parameters of the single-robot search."""

    def __init__(self) -> None: ...

    @property
    def weight(self) -> float: ...

    @weight.setter
    def weight(self, arg: float, /) -> None: ...

    @property
    def greed(self) -> float: ...

    @greed.setter
    def greed(self, arg: float, /) -> None: ...

    @property
    def most_weight(self) -> float: ...

    @most_weight.setter
    def most_weight(self, arg: float, /) -> None: ...

    @property
    def tail_weight(self) -> float: ...

    @tail_weight.setter
    def tail_weight(self, arg: float, /) -> None: ...

    @property
    def soft_weight(self) -> float: ...

    @soft_weight.setter
    def soft_weight(self, arg: float, /) -> None: ...

    @property
    def cell(self) -> float: ...

    @cell.setter
    def cell(self, arg: float, /) -> None: ...

    @property
    def shot_words(self) -> int: ...

    @shot_words.setter
    def shot_words(self, arg: int, /) -> None: ...

    @property
    def most_nodes(self) -> int: ...

    @most_nodes.setter
    def most_nodes(self, arg: int, /) -> None: ...

    @property
    def most_cells(self) -> int: ...

    @most_cells.setter
    def most_cells(self, arg: int, /) -> None: ...

class Aim(enum.Enum):
    """What the sum over robots, or the last of them, is to be least of."""

    SUM_OF_COSTS = 0

    MAKESPAN = 1

class TeamParams:
    """Parameters of prioritised planning."""

    def __init__(self) -> None: ...

    @property
    def search(self) -> SearchParams: ...

    @search.setter
    def search(self, arg: SearchParams, /) -> None: ...

    @property
    def objective(self) -> Objective: ...

    @objective.setter
    def objective(self, arg: Objective, /) -> None: ...

    @property
    def aim(self) -> Aim: ...

    @aim.setter
    def aim(self, arg: Aim, /) -> None: ...

    @property
    def margin(self) -> float: ...

    @margin.setter
    def margin(self, arg: float, /) -> None: ...

    @property
    def first_penalty(self) -> float: ...

    @first_penalty.setter
    def first_penalty(self, arg: float, /) -> None: ...

    @property
    def penalty_growth(self) -> float: ...

    @penalty_growth.setter
    def penalty_growth(self, arg: float, /) -> None: ...

    @property
    def first_hold(self) -> float: ...

    @first_hold.setter
    def first_hold(self, arg: float, /) -> None: ...

    @property
    def last_hold(self) -> float: ...

    @last_hold.setter
    def last_hold(self, arg: float, /) -> None: ...

    @property
    def jitter(self) -> float: ...

    @jitter.setter
    def jitter(self, arg: float, /) -> None: ...

    @property
    def search_limit(self) -> int: ...

    @search_limit.setter
    def search_limit(self, arg: int, /) -> None: ...

    @property
    def alone_limit(self) -> int: ...

    @alone_limit.setter
    def alone_limit(self, arg: int, /) -> None: ...

    @property
    def restarts(self) -> int: ...

    @restarts.setter
    def restarts(self, arg: int, /) -> None: ...

    @property
    def repair_limit(self) -> int: ...

    @repair_limit.setter
    def repair_limit(self, arg: int, /) -> None: ...

    @property
    def neighbourhood(self) -> int: ...

    @neighbourhood.setter
    def neighbourhood(self, arg: int, /) -> None: ...

class TourStop:
    """A visit made: its leg, ticks of arrival and leaving."""

    @property
    def leg(self) -> int: ...

    @property
    def arrive(self) -> int: ...

    @property
    def leave(self) -> int: ...

class TourResult:
    """One robot's way through its visits."""

    @property
    def pieces(self) -> list[TimedPiece]: ...

    @property
    def stops(self) -> list[TourStop]: ...

class TeamStatus(enum.Enum):
    """How prioritised planning ended."""

    SOLVED = 0

    STOPPED = 1

    STUCK = 2

class TeamAnswer:
    """What planning a team came to."""

    @property
    def status(self) -> TeamStatus: ...

    @property
    def tours(self) -> list[TourResult]: ...

    @property
    def planned(self) -> list[bool]: ...

    @property
    def concerned(self) -> list[int]: ...

    @property
    def conflict_free_until(self) -> int: ...

    @property
    def expansions(self) -> int: ...

    @property
    def searches(self) -> int: ...

    @property
    def rip_ups(self) -> int: ...

    @property
    def restarts(self) -> int: ...

    @property
    def full(self) -> int: ...

    @property
    def repairs(self) -> int: ...

    @property
    def repaired(self) -> int: ...

    @property
    def first_expansions(self) -> int: ...

    @property
    def first_cost(self) -> float: ...

    @property
    def interrupted(self) -> bool: ...

class Expanded:
    """A state that a search expanded, with its safe interval."""

    @property
    def pose(self) -> Pose: ...

    @property
    def begin(self) -> int: ...

    @property
    def end(self) -> int: ...

    @property
    def leg(self) -> int: ...

def trace_tour(models: Sequence[Model], agents: Sequence[Agent], params: TeamParams, tours: Sequence[TourResult], robot: int) -> tuple[TourResult, list[Expanded]]:
    """
    Search one robot's tour among others' and tell the states expanded, in order.
    """

def plan_team(models: Sequence[Model], agents: Sequence[Agent], params: TeamParams, seed: int, expansions: int = -1, seconds: float | None = None, progress: Callable[[int, int, int, float | None], None] | None = None, improve: bool = True) -> TeamAnswer:
    """
    Plan a team, then plan it better until the budget or an interrupt ends that.
    """

class Heuristic(enum.Enum):
    """How a search over a lattice estimates what is left."""

    LOOK_BACK = 0

    BOUND = 1

    PAPER = 2

class ConflictMode(enum.Enum):
    """What conflict-based search aims at."""

    OPTIMAL = 0

    BOUNDED = 1

    GREEDY = 2

class LatticeParams:
    """What makes a robot's finite graph."""

    def __init__(self) -> None: ...

    @property
    def slot(self) -> int: ...

    @slot.setter
    def slot(self, arg: int, /) -> None: ...

    @property
    def shot_words(self) -> int: ...

    @shot_words.setter
    def shot_words(self, arg: int, /) -> None: ...

    @property
    def shot_reach(self) -> float: ...

    @shot_reach.setter
    def shot_reach(self, arg: float, /) -> None: ...

    @property
    def most_nodes(self) -> int: ...

    @most_nodes.setter
    def most_nodes(self, arg: int, /) -> None: ...

class ConflictParams:
    """Choices of conflict-based search."""

    def __init__(self) -> None: ...

    @property
    def mode(self) -> ConflictMode: ...

    @mode.setter
    def mode(self, arg: ConflictMode, /) -> None: ...

    @property
    def objective(self) -> Objective: ...

    @objective.setter
    def objective(self, arg: Objective, /) -> None: ...

    @property
    def lattice(self) -> LatticeParams: ...

    @lattice.setter
    def lattice(self, arg: LatticeParams, /) -> None: ...

    @property
    def heuristic(self) -> Heuristic: ...

    @heuristic.setter
    def heuristic(self, arg: Heuristic, /) -> None: ...

    @property
    def factor(self) -> float: ...

    @factor.setter
    def factor(self, arg: float, /) -> None: ...

    @property
    def xi(self) -> float: ...

    @xi.setter
    def xi(self, arg: float, /) -> None: ...

    @property
    def adaptive(self) -> bool: ...

    @adaptive.setter
    def adaptive(self, arg: bool, /) -> None: ...

    @property
    def meeting(self) -> float: ...

    @meeting.setter
    def meeting(self, arg: float, /) -> None: ...

    @property
    def attempts(self) -> int: ...

    @attempts.setter
    def attempts(self, arg: int, /) -> None: ...

    @property
    def first_limit(self) -> int: ...

    @first_limit.setter
    def first_limit(self, arg: int, /) -> None: ...

    @property
    def most_nodes(self) -> int: ...

    @most_nodes.setter
    def most_nodes(self, arg: int, /) -> None: ...

    @property
    def margin(self) -> float: ...

    @margin.setter
    def margin(self, arg: float, /) -> None: ...

class ConflictStatus(enum.Enum):
    """How conflict-based search ended."""

    SOLVED = 0

    STOPPED = 1

    NONE = 2

class ConflictAnswer:
    """What conflict-based search came to."""

    @property
    def status(self) -> ConflictStatus: ...

    @property
    def tours(self) -> list[TourResult]: ...

    @property
    def concerned(self) -> list[int]: ...

    @property
    def cost(self) -> float: ...

    @property
    def proven(self) -> bool: ...

    @property
    def largest_group(self) -> int: ...

    @property
    def bound(self) -> float: ...

    @property
    def expansions(self) -> int: ...

    @property
    def nodes(self) -> int: ...

    @property
    def searches(self) -> int: ...

    @property
    def too_large(self) -> bool: ...

    @property
    def interrupted(self) -> bool: ...

def search_conflicts(models: Sequence[Model], agents: Sequence[Agent], params: ConflictParams, expansions: int = -1, seconds: float | None = None, progress: Callable[[int, int, float, float], None] | None = None) -> ConflictAnswer:
    """Plan a team by conflict-based search on bodies."""

class CellStay:
    """One cell of a timed route; times in ticks."""

    def __init__(self, cell: int, arrive: int, depart: int, turn_begin: int = 0, turn_end: int = 0) -> None: ...

    @property
    def cell(self) -> int:
        """y times width plus x."""

    @property
    def arrive(self) -> int: ...

    @property
    def depart(self) -> int:
        """`NEVER` of the last one."""

    @property
    def turn_begin(self) -> int: ...

    @property
    def turn_end(self) -> int: ...

class Clash:
    """Two robots that hold a cell at once, or turn side by side."""

    @property
    def cell(self) -> int: ...

    @property
    def index(self) -> int:
        """Of the cell in the route asked about."""

    @property
    def other(self) -> int:
        """The robot in the way."""

    @property
    def other_index(self) -> int:
        """Of the cell in its route."""

    @property
    def at(self) -> int:
        """Tick at which both begin to hold it."""

class CellHolds:
    """Who holds which cell of a lane grid when."""

    def __init__(self, width: int, height: int, num_robots: int, step: int, wide: bool = False) -> None: ...

    def put(self, robot: int, route: Sequence[CellStay]) -> None:
        """Replace what a robot holds by a timed route."""

    def remove(self, robot: int) -> None: ...

    def route(self, robot: int) -> list[CellStay]: ...

    def clashes(self, robot: int, route: Sequence[CellStay], granted: int = 0) -> list[Clash]:
        """
        Conflicts of a timed route with what all others hold, by their moments. Nobody goes before another into a cell that this one begins to hold before `granted`.
        """

    def least_delay(self, robot: int, route: Sequence[CellStay], index: int, other: int, granted: int = 0) -> int:
        """
        Ticks by which a robot must go on later from a cell of its route so that it meets nothing of another's from there on; -1: it cannot by waiting there.
        """

    def holders(self, cell: int, since: int) -> list[int]:
        """Robots that hold a cell after a tick."""

def delayed(route: Sequence[CellStay], index: int, by: int) -> list[CellStay]:
    """
    A route whose robot goes on from the middle of a cell later, and turns there later.
    """

class LaneWay:
    """What a search over a lane grid found."""

    @property
    def found(self) -> bool: ...

    @property
    def stays(self) -> list[CellStay]: ...

    @property
    def behind(self) -> list[int]:
        """Per stay: the robot waited for there before it departs; -1: nobody."""

    @property
    def ready(self) -> int:
        """Tick at which it has turned to its last heading."""

    @property
    def expansions(self) -> int: ...

class LaneSearch:
    """Earliest way over a lane grid past what others hold."""

    def __init__(self, holds: CellHolds, may_wait: Annotated[NDArray[numpy.uint8], dict(shape=(None, None), order='C', device='cpu', writable=False)], turn: int) -> None: ...

    def __call__(self, moves: Annotated[NDArray[numpy.uint8], dict(shape=(None, None), order='C', device='cpu', writable=False)], robot: int, start: int, goal: int, now: int, granted: int, first_turn: Sequence[int], last_turn: Sequence[int], limit: int) -> LaneWay:
        """
        `moves` holds bits of the legal directions out of each cell; the earliest arrival wins.
        """

class LoneLeg:
    """From one pose to another, with a body."""

    def __init__(self, start: Pose, goal: Pose, body: int) -> None: ...

def lone_durations(model: Model, params: TeamParams, legs: Sequence[LoneLeg]) -> list[int]:
    """
    Ticks that each leg takes with nobody else on the site; -1 where no way is found.
    """

class RouteSearch:
    """Best routes over square cells with legal moves."""

    def __init__(self, lanes: Annotated[NDArray[numpy.uint8], dict(shape=(None, None), order='C', device='cpu', writable=False)], step: int, turn: int) -> None: ...

    def __call__(self, moves: Annotated[NDArray[numpy.uint8], dict(shape=(None, None), order='C', device='cpu', writable=False)], start: int, goal: int, heading: int) -> list[int]:
        """
        Cells (numbered row by row) from start to goal; none where there is no way.
        """

    @property
    def expansions(self) -> int:
        """Nodes expanded in the last search."""

class TailParams:
    """Parameters of always-complete planning."""

    def __init__(self) -> None: ...

    @property
    def search(self) -> SearchParams: ...

    @search.setter
    def search(self, arg: SearchParams, /) -> None: ...

    @property
    def objective(self) -> Objective: ...

    @objective.setter
    def objective(self, arg: Objective, /) -> None: ...

    @property
    def margin(self) -> float: ...

    @margin.setter
    def margin(self, arg: float, /) -> None: ...

class TailQuery:
    """A new tail that is asked for."""

    def __init__(self) -> None: ...

    @property
    def robot(self) -> int: ...

    @robot.setter
    def robot(self, arg: int, /) -> None: ...

    @property
    def now(self) -> int: ...

    @now.setter
    def now(self, arg: int, /) -> None: ...

    @property
    def kept(self) -> list[TimedPiece]: ...

    @kept.setter
    def kept(self, arg: Sequence[TimedPiece], /) -> None: ...

    @property
    def start(self) -> Pose: ...

    @start.setter
    def start(self, arg: Pose, /) -> None: ...

    @property
    def mode(self) -> int: ...

    @mode.setter
    def mode(self, arg: int, /) -> None: ...

    @property
    def ready(self) -> int: ...

    @ready.setter
    def ready(self, arg: int, /) -> None: ...

    @property
    def legs(self) -> list[Leg]: ...

    @legs.setter
    def legs(self, arg: Sequence[Leg], /) -> None: ...

    @property
    def rests(self) -> list[Pose]: ...

    @rests.setter
    def rests(self, arg: Sequence[Pose], /) -> None: ...

    @property
    def rest_body(self) -> int: ...

    @rest_body.setter
    def rest_body(self, arg: int, /) -> None: ...

    @property
    def fine(self) -> bool: ...

    @fine.setter
    def fine(self, arg: bool, /) -> None: ...

    @property
    def limit(self) -> int: ...

    @limit.setter
    def limit(self, arg: int, /) -> None: ...

class Tail:
    """What a search for a tail came to."""

    @property
    def found(self) -> bool: ...

    @property
    def exhausted(self) -> bool: ...

    @property
    def pieces(self) -> list[TimedPiece]: ...

    @property
    def stops(self) -> list[TourStop]: ...

    @property
    def rest(self) -> int: ...

    @property
    def expansions(self) -> int: ...

    @property
    def met(self) -> list[int]: ...

class TailMeeting:
    """Whom a robot meets, and where it is then."""

    @property
    def robot(self) -> int: ...

    @property
    def at(self) -> Pose: ...

class TailPlanner:
    """Everybody's committed motion, of which tails are replaced one by one."""

    def __init__(self, models: Sequence[Model], model_of: Sequence[int], params: TailParams) -> None: ...

    def place(self, robot: int, now: int, start: Pose, pieces: Sequence[TimedPiece], body: int) -> None: ...

    def plan(self, query: TailQuery) -> Tail:
        """Commit a robot to a new tail, if one is found."""

    def alone(self, query: TailQuery) -> Tail:
        """The tail that it would have with nobody else on the site."""

    def meetings(self, robot: int, pieces: Sequence[TimedPiece], earlier: int) -> list[TailMeeting]:
        """
        Whom a robot would meet first if it drove pieces so many ticks earlier.
        """

    def clear_until(self, robot: int, now: int, statics: Sequence[Statics]) -> int:
        """
        Last tick up to which a robot's motion is clear of what stands; NEVER if always.
        """

    def settled(self, robot: int) -> int:
        """When a robot comes to its last rest."""

    def rebuild(self, statics: Sequence[Sequence[Statics]]) -> None:
        """Take over what stands, for each model and body."""

class CommittedPath:
    """A robot's whole motion, cut into cells."""

    def __init__(self, bodies: Sequence[Body], start: Pose, pieces: Sequence[TimedPiece], cell: float) -> None: ...

    @property
    def num_cells(self) -> int: ...

class PathParams:
    """How exactly places of conflict are told."""

    def __init__(self) -> None: ...

    @property
    def margin(self) -> float: ...

    @margin.setter
    def margin(self, arg: float, /) -> None: ...

    @property
    def finest(self) -> float: ...

    @finest.setter
    def finest(self, arg: float, /) -> None: ...

class PathConflicts:
    """What two robots wait for: (at, passed), rising."""

    @property
    def first(self) -> list[tuple[int, int]]: ...

    @property
    def second(self) -> list[tuple[int, int]]: ...

    @property
    def meeting(self) -> int: ...

def path_conflicts(a: CommittedPath, done_a: int, b: CommittedPath, done_b: int, params: PathParams) -> PathConflicts:
    """
    Where two committed motions need the same floor, whatever their times become.
    """

def paths_overlap(a: CommittedPath, from_a: int, to_a: int, b: CommittedPath, from_b: int, to_b: int) -> bool:
    """
    Whether bodies are in each other for some tick of each of two stretches.
    """

class AssignmentCosts:
    """What it costs robots to go from task to task."""

    def __init__(self, kind: Sequence[int], start: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], start_turn: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], between: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], turn: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], inner: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], allowed: Annotated[NDArray[numpy.uint8], dict(order='C', device='cpu', writable=False)], weights: Sequence[float], speed: float, service: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], due: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], before: Sequence[tuple[int, int]]) -> None: ...

    @property
    def num_robots(self) -> int: ...

    @property
    def num_tasks(self) -> int: ...

    @property
    def is_timed(self) -> bool: ...

    def values(self, orders: Annotated[NDArray[numpy.int32], dict(order='C', device='cpu', writable=False)], cuts: Annotated[NDArray[numpy.int32], dict(order='C', device='cpu', writable=False)]) -> list[float]:
        """
        Values of orders of tasks, cut into one route per robot; infinite where not legal.
        """

class RuinRecreateParams:
    """Effort and shape of ruin and recreate."""

    def __init__(self, rounds: int | None = None, removed: int = 10, longest_string: int = 10, blinks: float = 0.02, regret: float = 0.02, first_temperature: float = 1.0, last_temperature: float = 0.01) -> None: ...

    @property
    def rounds(self) -> int | None:
        """
        Times that tasks are taken out and put back; more find better routes. None: by the number of tasks, for about 2 s of a core at the most.
        """

    @property
    def removed(self) -> int:
        """Tasks taken out in a round, on average."""

    @property
    def longest_string(self) -> int:
        """Tasks out of one route in a row, at most."""

    @property
    def blinks(self) -> float:
        """Share of the places overlooked; more is more varied."""

    @property
    def regret(self) -> float:
        """
        Share of the rounds that put back first what would lose most by its second-best robot.
        """

    @property
    def first_temperature(self) -> float:
        """By how much a round may end worse at first, in mean prices of a leg."""

    @property
    def last_temperature(self) -> float:
        """The same at the end."""

def ruin_recreate(costs: AssignmentCosts, start: Sequence[Sequence[int]], seats: int, params: RuinRecreateParams, seed: int) -> list[list[int]]:
    """
    Better routes than those to start from, with at most so many seats per robot.
    """

class ExactResult:
    """What exact assignment came to."""

    @property
    def routes(self) -> list[list[int]]: ...

    @property
    def proven(self) -> bool: ...

    @property
    def pooled(self) -> int: ...

    @property
    def branchings(self) -> int: ...

def solve_exactly(costs: AssignmentCosts, seats: int, start: Sequence[Sequence[int]]) -> ExactResult:
    """
    The best routes of an untimed problem of at most 16 tasks, and proof that they are.
    """

class MemeticParams:
    """Effort and shape of the memetic swarm."""

    def __init__(self, particles: int = 30, iterations: int = 5, mutation: float = 0.1, c_max: float = 2.5, c_min: float = 0.5, w_max: float = 1.0, w_min: float = 0.0, gamma: float = 0.2) -> None: ...

    @property
    def particles(self) -> int:
        """More find better routes."""

    @property
    def iterations(self) -> int:
        """Times that all are mixed and descend."""

    @property
    def mutation(self) -> float:
        """Chance that two coordinates of a child change places."""

    @property
    def c_max(self) -> float:
        """Pull of a particle's own best at first and of the best of all at last."""

    @property
    def c_min(self) -> float:
        """The same the other way round."""

    @property
    def w_max(self) -> float:
        """Pull towards staying as it is, at first."""

    @property
    def w_min(self) -> float:
        """The same at last."""

    @property
    def gamma(self) -> float:
        """Adds to that, times the ratio of the best value to the mean one."""

class MemeticResult:
    """What a memetic swarm came to."""

    @property
    def routes(self) -> list[list[int]]: ...

    @property
    def evaluations(self) -> int: ...

def swarm_memetically(costs: AssignmentCosts, seats: int, start: Sequence[Sequence[int]], params: MemeticParams, seed: int) -> MemeticResult:
    """The best even split that a swarm finds."""
