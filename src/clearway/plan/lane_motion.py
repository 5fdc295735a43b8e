"""Timed routes over a lane grid as trajectories, and back."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from clearway import _core
from clearway.model import Piece, Pose, Stop, Trajectory, wrap
from clearway.world.lane_grid import STEPS, Cell, LaneGrid

QUARTER = math.pi / 2.0
# Directions are numbered as the bits of a lane grid: east, north, west, south.
HEADINGS = tuple(wrap(k * QUARTER) for k in range(len(STEPS)))
_SAME = 1e-6


def direction(before: Cell, after: Cell) -> int:
    """Return the number of the direction that leads from a cell to one beside it."""
    return list(STEPS.values()).index((after[0] - before[0], after[1] - before[1]))


def turn_ticks(before: float, after: float, quarter: int) -> int:
    """Return how long a turn on the spot lasts (ticks), if a quarter lasts ``quarter``."""
    return math.ceil(quarter * abs(wrap(after - before)) / QUARTER - _SAME)


def timed(
    indices: Sequence[int], width: int, ready: int, step: int, turns: Sequence[int], quarter: int
) -> list[_core.CellStay]:
    """Return when a robot is where on a route if it never waits.

    Parameters
    ----------
    indices
        Cells, each ``y * width + x``.
    ready
        Tick at which it may set out.
    step, quarter
        Ticks to the next cell, and of a turn by 90 degrees.
    turns
        Ticks of the first turn, by the direction of the first step.
    """
    cells = [(index % width, index // width) for index in indices]
    steps = [direction(*pair) for pair in pairwise(cells)]
    stays = []
    arrive = ready
    for k, way in enumerate(steps):
        turned = abs(way - steps[k - 1]) % 4 if k else 0
        turn = min(turned, 4 - turned) * quarter if k else turns[way]
        stays.append(_core.CellStay(indices[k], arrive, arrive + turn, arrive, arrive + turn))
        arrive += turn + step
    return [*stays, _core.CellStay(indices[-1], arrive, _core.NEVER, arrive, arrive)]


def trajectory_of(
    grid: LaneGrid,
    robot: str,
    start: Pose,
    stays: Sequence[_core.CellStay],
    goal: Pose,
    stops: tuple[Stop, ...],
    loaded: bool = False,
) -> Trajectory:
    """Join straight runs at even speed, and turns on the spot, to a trajectory.

    Where a turn takes no time the heading jumps between two pieces; at the goal it lasts as long
    as the last stay turns.

    Parameters
    ----------
    start, goal
        Poses at rest in the middle of the first and of the last cell.
    """
    width = grid.size[0]
    cells = [(stay.cell % width, stay.cell // width) for stay in stays]
    pieces: list[Piece] = []
    timing: list[tuple[int, int]] = []
    pose = start

    def add(twist: tuple[float, float, float], begin: int, end: int) -> None:
        pieces.append(Piece(len(pieces), None, pose, twist, loaded))
        timing.append((begin, end))

    def turn(theta: float, stay: _core.CellStay) -> None:
        nonlocal pose
        by = wrap(theta - pose.theta)
        if stay.turn_end > stay.turn_begin and abs(by) > _SAME:
            add((0.0, 0.0, by), stay.turn_begin, stay.turn_end)
        pose = Pose(pose.x, pose.y, theta)

    steps = [direction(*pair) for pair in pairwise(cells)]
    k = 0
    while k < len(steps):
        turn(HEADINGS[steps[k]], stays[k])
        first = k
        k += 1
        while k < len(steps) and steps[k] == steps[first] and stays[k].depart == stays[k].arrive:
            k += 1
        add(((k - first) * grid.cell, 0.0, 0.0), stays[first].depart, stays[k].arrive)
        pose = grid.centre(cells[k], HEADINGS[steps[first]])
    turn(goal.theta, stays[-1])
    return Trajectory(robot, start, tuple(pieces), tuple(timing), stops)


def split(trajectory: Trajectory, at: int) -> Trajectory:
    """Return the same motion with a piece that goes on over a tick made two."""
    pieces, timing = [], []
    for piece, (first, last) in zip(trajectory.pieces, trajectory.timing, strict=True):
        if first < at < last:
            share = (at - first) / (last - first)
            a, b, c = piece.twist
            head = (share * a, share * b, share * c)
            pieces += [
                replace(piece, twist=head),
                replace(
                    piece,
                    start=piece.at(share),
                    twist=(a - head[0], b - head[1], c - head[2]),
                ),
            ]
            timing += [(first, at), (at, last)]
        else:
            pieces.append(piece)
            timing.append((first, last))
    return replace(trajectory, pieces=numbered(pieces), timing=tuple(timing))


def paused(trajectory: Trajectory, at: int, by: int) -> Trajectory:
    """Return a motion that stands still at a tick, at which nobody is within a turn, for a while.

    Parameters
    ----------
    by
        Ticks for which it stands; what comes afterwards is that much later.
    """
    path = split(trajectory, at)
    timing = tuple((t + by, end + by) if t >= at else (t, end) for t, end in path.timing)
    stops = tuple(
        replace(stop, arrive=stop.arrive + by, leave=stop.leave + by) if stop.arrive >= at else stop
        for stop in path.stops
    )
    return replace(path, timing=timing, stops=stops)


def numbered(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """Return pieces with ids in their order."""
    return tuple(replace(piece, id=k) for k, piece in enumerate(pieces))


def stays_of(grid: LaneGrid, trajectory: Trajectory) -> list[_core.CellStay]:
    """Return when a robot is in the middle of each cell that it passes, by its trajectory.

    A robot that starts between two cells has left the one behind at tick 0; one that ends there
    comes to the one ahead at the end of time, so that it holds both.
    """
    width = grid.size[0]
    # Cell, arrive, depart, and when it turns.
    stays: list[list[int]] = []

    def visit(x: float, y: float, tick: int) -> list[int]:
        cell = round(y) * width + round(x)
        if stays and stays[-1][0] == cell:
            stays[-1][2] = max(stays[-1][2], tick)
        else:
            stays.append([cell, tick, tick, tick, tick])
        return stays[-1]

    start = trajectory.start
    x, y = start.x / grid.cell - 0.5, start.y / grid.cell - 0.5  # cells' middles at whole numbers
    dx, dy = round(math.cos(start.theta)), round(math.sin(start.theta))
    ahead = (x - round(x)) * dx + (y - round(y)) * dy
    if abs(ahead) < _SAME:
        visit(x, y, 0)
    else:
        behind = ahead if ahead > 0.0 else 1.0 + ahead
        visit(x - behind * dx, y - behind * dy, 0)
    for piece, (first, last) in zip(trajectory.pieces, trajectory.timing, strict=True):
        x, y = piece.start.x / grid.cell - 0.5, piece.start.y / grid.cell - 0.5
        length = piece.twist[0] / grid.cell
        if length == 0.0:
            stay = visit(x, y, last)
            stay[3:] = [first, last]
            continue
        dx, dy = round(math.cos(piece.start.theta)), round(math.sin(piece.start.theta))
        place = x * dx + y * dy
        for middle in range(math.ceil(place - _SAME), math.floor(place + length + _SAME) + 1):
            by = middle - place
            visit(x + by * dx, y + by * dy, first + round(by / length * (last - first)))
    end = trajectory.final_pose
    x, y = end.x / grid.cell - 0.5, end.y / grid.cell - 0.5
    dx, dy = round(math.cos(end.theta)), round(math.sin(end.theta))
    place = x * dx + y * dy
    ahead = math.ceil(place - _SAME) - place
    if ahead > _SAME:
        visit(x + ahead * dx, y + ahead * dy, _core.NEVER - 1)
    stays[-1][2] = _core.NEVER
    for stay in stays[:-1]:
        if stay[3] == stay[4]:
            stay[3:] = [stay[2], stay[2]]
    return [_core.CellStay(*stay) for stay in stays]
