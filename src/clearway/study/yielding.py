"""Who slowed for whom: a team's plan beside the plans of its robots alone."""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from clearway.formats.sampling import sample
from clearway.metrics.motion import Floats, track_of
from clearway.model import PlanRecord, Problem, Robot, Track, wrap
from clearway.protocols import Budget, Planner
from clearway.study.lone_clock import lone_clock
from clearway.validate import gaps_over_time

# Below this share of its lone pace a robot yields; losses below so many seconds are none.
PACE, LEAST_LOSS = 0.8, 1.0
# Stretches that are nearer than this (s) are one.
NEAR = 3.0
# Whom a robot would meet later than this after it began to yield (s), it does not yield to.
AHEAD = 30.0
# Farther than this (m) from its lone way a robot takes a detour.
OFF = 1.0
# Seconds between the moments at which a lone way is compared with the others' plans.
STEP = 0.1
# Below this speed (m/s) a robot stands.
STANDING = 0.01


class Yielding(NamedTuple):
    """A stretch of time in which a robot loses time against its lone plan.

    ``kind`` is ``waits``, ``slows`` or ``detours``; ``partner`` is the robot that it would
    have met first, ``meeting`` seconds into the plan, going on as if it were alone; ``None``
    where it would have met nobody within half a minute.
    """

    robot: str
    begin: float
    end: float
    lost: float
    kind: str
    place: tuple[float, float]
    partner: str | None
    meeting: float | None


def lone_records(record: PlanRecord, planner: Planner, seed: int) -> dict[str, PlanRecord]:
    """Return each robot's plan by the same planner with nobody else on the site.

    Robots for which the planner finds none are left out.
    """
    found = {}
    for robot in record.robots:
        tours = {robot.id: record.tours.get(robot.id, ())}
        plan = planner(Problem(record.site, record.robot_types, (robot,), tours), Budget(), seed)
        if plan and robot.id in plan.trajectories:
            path = plan.trajectories[robot.id]
            has_modes = record.robot_types[robot.type].kinematics == "four_wheel"
            found[robot.id] = replace(
                record,
                robots=(robot,),
                tours=tours,
                tracks={robot.id: sample(path, has_modes)},
                paths={robot.id: path},
            )
    return found


def yieldings(record: PlanRecord, alone: Mapping[str, PlanRecord]) -> list[Yielding]:
    """Return who loses time against its lone plan, when, how and for whom; by time."""
    found: list[Yielding] = []
    for robot in record.robots:
        if robot.id in alone:
            found += _of_robot(record, alone[robot.id], robot)
    return sorted(found, key=lambda each: (each.begin, each.robot))


def _of_robot(record: PlanRecord, lone: PlanRecord, robot: Robot) -> list[Yielding]:
    clock = lone_clock(record, lone, robot)
    found = []
    for first, last in _stretches(clock.times, clock.pace < PACE):
        begin, end = float(clock.times[first]), float(clock.times[last])
        lost = (end - begin) - float(clock.alone[last] - clock.alone[first])
        if lost < LEAST_LOSS:
            continue
        part = slice(first, last + 1)
        stands = (end - begin) * float(np.mean(clock.speed[part] < STANDING))
        off = float(np.mean(clock.away[part] > OFF))
        kind = "waits" if stands > 0.5 * lost else "detours" if off > 0.5 else "slows"
        partner, meeting = _partner(record, lone, robot, begin, float(clock.alone[first]))
        place = (float(clock.x[first]), float(clock.y[first]))
        found.append(Yielding(robot.id, begin, end, lost, kind, place, partner, meeting))
    return found


def _stretches(
    times: Floats, slow: "np.ndarray[tuple[int], np.dtype[np.bool_]]"
) -> list[tuple[int, int]]:
    """Return first and last sample of each stretch that is slow, small gaps bridged."""
    found: list[tuple[int, int]] = []
    for at in np.flatnonzero(slow).tolist():
        after = min(at + 1, len(times) - 1)
        if found and times[at] - times[found[-1][1]] <= NEAR:
            found[-1] = (found[-1][0], after)
        else:
            found.append((at, after))
    return found


def _partner(
    record: PlanRecord, lone: PlanRecord, robot: Robot, begin: float, alone: float
) -> tuple[str | None, float | None]:
    """Return whom the robot meets first, and when, if it goes on alone from ``begin``."""
    ahead = _going_on(track_of(record, robot), track_of(lone, robot), begin, alone)
    times = np.arange(begin, min(float(ahead.t[-1]), begin + AHEAD) + STEP, STEP)
    met: list[tuple[float, str]] = []
    for other in record.robots:
        if other.id == robot.id:
            continue
        both = replace(
            record,
            robots=(robot, other),
            tracks={**record.tracks, robot.id: ahead},
            paths={},
            conflict_free_until=None,
        )
        margin = sum(record.robot_types[each.type].clearance for each in (robot, other))
        near = gaps_over_time(both, times)[robot.id, other.id] < margin
        if near.any():
            met.append((float(times[near.argmax()]), other.id))
    when, whom = min(met, default=(None, None))
    return whom, when


def _going_on(team: Track, lone: Track, begin: float, alone: float) -> Track:
    """Return the team's track until ``begin`` and the lone one, from ``alone`` on, after it."""
    before, after = team.t < begin, lone.t > alone
    here = [np.interp(alone, lone.t, values) for values in (lone.x, lone.y)]
    theta = wrap(float(np.interp(alone, lone.t, np.unwrap(lone.theta))))
    return Track(
        np.concatenate([team.t[before], [begin], lone.t[after] + (begin - alone)]),
        np.concatenate([team.x[before], [here[0]], lone.x[after]]),
        np.concatenate([team.y[before], [here[1]], lone.y[after]]),
        np.concatenate([team.theta[before], [theta], lone.theta[after]]),
        (None,) * int(before.sum() + 1 + after.sum()),
    )
