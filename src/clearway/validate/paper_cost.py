"""The cost named ``paper``: metres weighted for turning, mode switches and waiting.

Zhang, An, Niu, Bao, Wang, Wang: An Enhanced Hybrid Metaheuristic for Hierarchical Scheduling
in 4WIDS Multi-robot Systems under Confined Environments, eq. 21.
"""

from itertools import pairwise

import numpy as np

from clearway.model import PlanRecord, Robot
from clearway.validate.displacement import displacement_of
from clearway.validate.figures import whole
from clearway.validate.steps import last_arrival, moves, track_of
from clearway.validate.violation import Violation
from clearway.validate.visits import Schedule, Service

TURN_WEIGHT = 2.0
SWITCH_COST = 3.0
WAIT_COST = 0.1
# A step that turns by less than this (rad) is straight but for stored digits.
STRAIGHT_TURN = 1e-5
ON_THE_SPOT = 5e-3
STANDING = (None, "stop")
RELATIVE, ABSOLUTE = 1e-3, 1e-2


def judge_paper_cost(record: PlanRecord, schedule: Schedule) -> list[Violation]:
    """Return whether ``cost`` is not what the trajectories cost, if it is the paper's."""
    if record.cost is None or record.cost_name != "paper":
        return []
    true = sum(paper_cost(record, robot, schedule[robot.id]) for robot in record.robots)
    if abs(record.cost - true) <= max(RELATIVE * abs(true), ABSOLUTE):
        return []
    return [whole("cost", f"stated {record.cost:.6f}, by the trajectories {true:.6f}")]


def paper_cost(record: PlanRecord, robot: Robot, services: list[Service]) -> float:
    """Return one robot's cost.

    Length, twice where it turns; 3 per change of moving mode; 0.1 per second of standing
    before the last arrival that is not service. Turning on the spot counts as an arc of
    half the body's length.
    """
    track = track_of(record, robot)
    motion, moving = displacement_of(track), moves(track)
    turn = np.abs(motion.turn)
    arc = motion.length / np.sinc(turn / (2.0 * np.pi))
    half_body = 0.5 * record.robot_types[robot.type].footprint.length
    on_the_spot = (turn >= STRAIGHT_TURN) & (motion.length <= ON_THE_SPOT * turn)
    length = np.where(on_the_spot, half_body * turn, arc)
    weight = np.where(turn >= STRAIGHT_TURN, TURN_WEIGHT, 1.0)
    modes = [robot.start_mode, *(track.mode[i] for i in np.flatnonzero(moving))]
    switches = sum(one != other for one, other in pairwise(m for m in modes if m not in STANDING))
    end = last_arrival(track)
    rest = np.concatenate([[0.0], np.cumsum(np.where(moving, 0.0, motion.dt))])

    def rested(moment: float) -> float:
        return float(np.interp(min(moment, end), track.t, rest))

    waited = rested(end) - sum(
        rested(s.end) - rested(s.begin)
        for s in services
        if s.begin is not None and s.end is not None
    )
    drive = float((length * weight)[moving].sum())
    return drive + SWITCH_COST * switches + WAIT_COST * waited
