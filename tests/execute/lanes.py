"""Grid robots that drive by hand-made routes through a hall of crossings, bay to bay."""

import itertools
import random

import numpy as np

from clearway.execute import CellConflicts
from clearway.model import Commitment, Footprint, Limits, Piece, RobotType, Trajectory
from clearway.world.lane_grid import CROSSING, LaneGrid

MOVE = 1000  # ticks that a step takes
BOX = RobotType("box", Footprint.rectangle(0.7, 0.7), "holonomic", Limits(speed=1.0))


def hall(width, height):
    """Every cell is a crossing."""
    region = np.full((height, width), CROSSING, dtype=np.int8)
    return LaneGrid("hall", 1.0, region, np.full((height, width), 15, dtype=np.uint8), {})


def driven(grid, robot, cells, times):
    """A commitment through neighbouring cells; step k begins at ``times[k]``.

    Bodies are square and slide, so that headings need no time to change.
    """
    pieces = []
    for k, (a, b) in enumerate(itertools.pairwise(cells)):
        pieces.append(Piece(k, None, grid.centre(a), (float(b[0] - a[0]), float(b[1] - a[1]), 0.0)))
    timing = tuple((t, t + MOVE) for t in times)
    return Commitment(robot, Trajectory(robot, grid.centre(cells[0]), tuple(pieces), timing))


def through(start, goal, row):
    """Cells from one bay to another: straight to a row of the hall, along it, and straight on."""
    way = 1 if goal[0] >= start[0] else -1
    up, on = (1 if row >= start[1] else -1), (1 if goal[1] >= row else -1)
    cells = [(start[0], y) for y in range(start[1], row, up)]
    cells += [(x, row) for x in range(start[0], goal[0], way)]
    return cells + [(goal[0], y) for y in range(row, goal[1] + on, on)]


def soonest(grid, check, robot, cells, begin, others, done=(0, 0)):
    """The first commitment, in quarters of a second, that meets nobody on its way."""
    while True:
        times = [begin + i * MOVE for i in range(len(cells) - 1)]
        mine = driven(grid, robot, cells, times)
        if all(is_free(check, mine, other, done) for other in others):
            return mine
        begin += 250


def crowd(num_robots, seed):
    """Robots cross a hall from bays in the south to bays in the north, and none is met.

    Each sets out as soon as it can drive through to its end; so do they follow each other closely.
    """
    rng = random.Random(seed)
    grid = hall(num_robots, 8)
    check = CellConflicts(grid)
    goals = rng.sample(range(num_robots), num_robots)
    found = {}
    for k, goal in enumerate(goals):
        cells = through((k, 0), (goal, 7), rng.randrange(1, 7))
        found[f"r{k}"] = soonest(grid, check, f"r{k}", cells, 0, found.values())
    return grid, found


def is_free(check, one, other, done):
    """Whether two commitments are free of conflicts, as far as they are still to be driven."""
    try:
        check(one, other, done)
    except ValueError:
        return False
    return True
