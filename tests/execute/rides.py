"""Random rides of two robots of unlike shapes through one small room."""

import math
import random

from clearway.execute import BodyConflicts
from clearway.model import Commitment, Footprint, Limits, Piece, Pose, RobotType, Trajectory

LIMITS = Limits(speed=1.0)
CART = RobotType(
    "cart", Footprint.rectangle(1.2, 0.8, rear=0.3), "holonomic", LIMITS, clearance=0.1
)
DRUM = RobotType("drum", Footprint(radius=0.4), "holonomic", LIMITS, clearance=0.1)
HOOK = RobotType(
    "hook",
    Footprint(
        parts=(
            ((1.0, 0.5), (-0.5, 0.5), (-0.5, 0.0), (1.0, 0.0)),
            ((1.0, 0.0), (0.5, 0.0), (0.5, -0.8), (1.0, -0.8)),
        )
    ),
    "holonomic",
    LIMITS,
    clearance=0.1,
)


def ride(rng, robot, size, begin, legs=7):
    """From outside the room into it, arcs, turns and slides in it with waits between, and out."""
    side = rng.choice((-1, 1))
    pose = start = Pose(side * (size + rng.uniform(2.0, 5.0)), rng.uniform(-1.0, 1.0), 0.0)
    pieces, timing, tick = [], [], begin
    for k in range(legs):
        if k == 0:
            twist = (-side * rng.uniform(size, 1.5 * size), 0.0, 0.0)
        elif rng.random() < 0.2:
            twist = (0.0, 0.0, rng.uniform(-1.5, 1.5))
        else:
            way, turn = rng.choice((-1, 1)) * rng.uniform(0.3, 2.5), rng.choice((0.0, 1.0))
            course = rng.choice((0.0, 0.0, math.pi / 2.0))
            turn *= rng.uniform(-1.0, 1.0)
            twist = (way * math.cos(course), way * math.sin(course), turn)
        piece = Piece(k, None, pose, twist)
        duration = math.ceil(1000.0 * (math.hypot(*twist[:2]) + abs(twist[2]))) + 1
        pieces.append(piece)
        timing.append((tick, tick + duration))
        tick += duration + (rng.randrange(100, 3000) if rng.random() < 0.3 else 0)
        pose = piece.end
    return Commitment(robot, Trajectory(robot, start, tuple(pieces), tuple(timing)))


def encounter(seed):
    """Two rides that meet at no planned time, their types, and what each must wait for."""
    rng = random.Random(seed)
    types = dict(zip(("a", "b"), rng.choices((CART, DRUM, HOOK), k=2), strict=True))
    conflicts = BodyConflicts(types)
    while True:
        one = ride(rng, "a", 2.5, 0)
        for _ in range(30):
            other = ride(rng, "b", 2.5, rng.randrange(0, 12_000))
            try:
                found = conflicts(one, other)
            except ValueError:
                continue
            if found[0] or found[1]:
                return one, other, types, found
