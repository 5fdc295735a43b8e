"""The judge of plans: all that the plan format promises, checked in continuous time."""

import math
from itertools import combinations

import numpy as np

from clearway.model import PlanRecord
from clearway.validate.acceleration import judge_acceleration
from clearway.validate.clocks import judge_clock, judge_samples
from clearway.validate.displacement import displacement_of
from clearway.validate.figures import judge_figures
from clearway.validate.kinematics import judge_kinematics
from clearway.validate.modes import judge_modes
from clearway.validate.pairs import Meeting, Mover, Timetable, judge_pairs
from clearway.validate.paper_cost import judge_paper_cost
from clearway.validate.separation import gaps, least_separation
from clearway.validate.statics import Surroundings, margin_around
from clearway.validate.steps import Floats, Steps, track_of
from clearway.validate.violation import Violation
from clearway.validate.visits import Schedule, judge_visits, loads_of, schedule_of

OVERLAP = 1e-3
BORDER = 2e-3


def validate_plan(
    record: PlanRecord, *, overlap: float = OVERLAP, border: float = BORDER
) -> list[Violation]:
    """Return everything that is wrong with a plan, by time; an empty list if it is right.

    Between samples all is linear. Overlaps are proven absent, not sampled: of a body with
    obstacles, bounds and closed zones at all times, of bodies with each other until the
    plan's ``conflict_free_until``. Each violation is told once per unbroken time, at its
    worst moment. Depth is the least shift that frees two convex parts; bodies and obstacles
    that are not convex are judged part by part.

    Parameters
    ----------
    overlap
        Depth (m) up to which bodies may be in each other or in obstacles.
    border
        How far (m) a body may leave the bounds.
    """
    known = {robot.id for robot in record.robots}
    found = [
        Violation("robot", (name,), 0.0, (0.0, 0.0), None, "a trajectory of an unknown robot")
        for name in record.tracks
        if name not in known
    ]
    for robot in record.robots:
        found += judge_clock(robot, track_of(record, robot))
    if found:
        return found
    steps, schedule = _motions(record)
    for robot in record.robots:
        kind, track = record.robot_types[robot.type], track_of(record, robot)
        motion = displacement_of(track)
        found += judge_samples(robot, kind, track)
        found += judge_kinematics(robot, kind, track, motion)
        found += judge_modes(robot, kind, track, motion)
        found += judge_acceleration(robot, kind, track, motion)
    margin = margin_around(record.site, record.robot_types.values(), steps.values())
    surroundings = Surroundings(record.site, overlap, border, margin)
    for robot in record.robots:
        found += surroundings.judge(robot, record.robot_types[robot.type], steps[robot.id])
    found += judge_pairs(_movers(record, steps), _until(record, steps), overlap)
    if record.status:
        found += judge_visits(record, schedule)
    found += judge_figures(record) + judge_paper_cost(record, schedule)
    return sorted(found, key=lambda violation: violation.time)


def separations(
    record: PlanRecord, within: float = math.inf
) -> list[tuple[str, str, float, float]]:
    """Return for each pair of robots their least gap (m) and when (s) it occurs.

    The gap is between the true bodies in continuous time, until the plan's
    ``conflict_free_until``, found to within 1 mm; it is minus the depth where they overlap.

    Parameters
    ----------
    within
        Pairs that are never nearer than this (m) are left out, which saves most of the time
        where robots are many.
    """
    steps, _ = _motions(record)
    movers, until = _movers(record, steps), _until(record, steps)
    if len(movers) < 2 or until <= 0.0:
        return []
    timetable = Timetable(movers, until)
    found = []
    for i, j in combinations(range(len(movers)), 2):
        least = least_separation(timetable, i, j, within)
        if least is not None:
            found.append((movers[i].robot.id, movers[j].robot.id, *least))
    return found


def gaps_over_time(record: PlanRecord, times: Floats) -> dict[tuple[str, str], Floats]:
    """Return the exact gap (m) between the bodies of each pair of robots at some moments.

    Minus the depth where they overlap. After the end of the plan all robots stand.

    Parameters
    ----------
    times
        Shape ``(n,)``, s, from 0 on; each pair's gaps have the same shape.
    """
    steps, _ = _motions(record)
    movers = _movers(record, steps)
    end = min((float(each.t1[-1]) for each in steps.values()), default=0.0)
    moments = np.minimum(times, end)
    held = [mover.steps.over(moments, moments) for mover in movers]
    return {
        (movers[i].robot.id, movers[j].robot.id): gaps(
            Meeting(movers[i], movers[j], held[i], held[j])
        )
        for i, j in combinations(range(len(movers)), 2)
    }


def _motions(record: PlanRecord) -> tuple[dict[str, Steps], Schedule]:
    """Return all robots' steps to a common end, with their loads, and their visits in time."""
    tracks = {robot.id: track_of(record, robot) for robot in record.robots}
    end = max((float(track.t[-1]) for track in tracks.values()), default=0.0)
    empty = {name: Steps.from_track(track, end + 1.0) for name, track in tracks.items()}
    schedule = schedule_of(record, empty)
    # A load that changes in the final rest does so within the time that is judged.
    loads = {name: loads_of(services) for name, services in schedule.items()}
    end = max([end, *(time for changes in loads.values() for time, _ in changes)])
    steps = {
        name: Steps.from_track(track, end + 1.0, loads[name]) for name, track in tracks.items()
    }
    return steps, schedule


def _movers(record: PlanRecord, steps: dict[str, Steps]) -> list[Mover]:
    return [Mover.of(r, record.robot_types[r.type], steps[r.id]) for r in record.robots]


def _until(record: PlanRecord, steps: dict[str, Steps]) -> float:
    end = min((float(s.t1[-1]) for s in steps.values()), default=0.0)
    return end if record.conflict_free_until is None else min(end, record.conflict_free_until)
