"""Timed routes over a lane grid as trajectories, and back."""

import math
from collections.abc import Sequence
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


def trajectory_of(
    grid: LaneGrid,
    robot: str,
    start: Pose,
    stays: Sequence[_core.CellStay],
    goal: Pose,
    stop: Stop,
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
    return Trajectory(robot, start, tuple(pieces), tuple(timing), (stop,))
