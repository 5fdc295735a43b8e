"""Grid robots that drive by hand-made routes through a hall of crossings, bay to bay."""

import itertools
import math
import random

import numpy as np

from clearway.execute import CellConflicts
from clearway.model import Commitment, Footprint, Limits, Piece, RobotType, Trajectory
from clearway.world.lane_grid import CROSSING, LaneGrid

MOVE = 1000  # ticks that a step takes
BOX = RobotType("box", Footprint.rectangle(0.7, 0.7), "holonomic", Limits(speed=1.0))
HEADING = {(1, 0): 0.0, (0, 1): math.pi / 2.0, (-1, 0): math.pi, (0, -1): -math.pi / 2.0}


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
        row = rng.randrange(1, 7)
        way = 1 if goal >= k else -1
        cells = [(k, y) for y in range(row + 1)]
        cells += [(x, row) for x in range(k + way, goal + way, way)] if goal != k else []
        cells += [(goal, y) for y in range(row + 1, 8)]
        begin = 0
        while True:
            times = [begin + i * MOVE for i in range(len(cells) - 1)]
            mine = driven(grid, f"r{k}", cells, times)
            if all(is_free(check, mine, other) for other in found.values()):
                break
            begin += 250
        found[mine.robot] = mine
    return grid, found


def is_free(check, one, other):
    try:
        check(one, other)
    except ValueError:
        return False
    return True
