"""What each robot does when: drive, turn on the spot, wait or serve."""

from typing import Literal, NamedTuple

import numpy as np

from clearway.metrics.motion import DRIVE, REST, TURN, arrival_sample, runs, track_of
from clearway.metrics.visits import VisitTime, visit_times
from clearway.model import PlanRecord, Robot

Kind = Literal["drive", "turn", "wait", "service"]

_KIND_OF_STEP: dict[int, Kind] = {REST: "wait", TURN: "turn", DRIVE: "drive"}


class Activity(NamedTuple):
    """One thing a robot does from ``start`` to ``end`` (s).

    ``label`` is the id of the task it is done for; empty on the way to parking or a charger.
    """

    kind: Kind
    start: float
    end: float
    label: str


def activities(record: PlanRecord) -> dict[str, list[Activity]]:
    """Return what each robot does, in order and without overlaps.

    Rest during a visit is service, any other rest is waiting. Rest after the last arrival
    is neither, save for the service there.
    """
    return {robot.id: _activities_of(record, robot) for robot in record.robots}


def _activities_of(record: PlanRecord, robot: Robot) -> list[Activity]:
    track = track_of(record, robot)
    made = visit_times(record, robot)
    spells = runs(track)
    starts = np.round([track.t[run.first] for run in spells], 6)
    served = np.round([[visit.arrive, visit.leave] for visit in made], 6).reshape(-1, 2)
    arrival = np.round(track.t[arrival_sample(track)], 6)
    cuts = np.unique(np.concatenate([starts, [arrival], served.ravel()]))
    middles = 0.5 * (cuts[:-1] + cuts[1:])
    spell_at = np.searchsorted(starts, middles, side="right") - 1
    is_service = np.logical_or.reduce((served[:, :1] < middles) & (middles < served[:, 1:]), axis=0)
    found: list[Activity] = []
    for start, end, middle, spell, serving in zip(
        cuts[:-1].tolist(), cuts[1:].tolist(), middles.tolist(), spell_at, is_service, strict=True
    ):
        if not serving and middle > arrival:
            continue
        kind: Kind = "service" if serving else _KIND_OF_STEP[spells[spell].kind]
        label = _task_at(record, robot, made, middle)
        if found and found[-1].end == start and found[-1].kind == kind and found[-1].label == label:
            found[-1] = found[-1]._replace(end=end)
        else:
            found.append(Activity(kind, start, end, label))
    return found


def _task_at(record: PlanRecord, robot: Robot, made: tuple[VisitTime, ...], time: float) -> str:
    """Return the task of the visit that the robot is making or heading for."""
    tour = record.tours.get(robot.id, ())
    upcoming = next((v.visit for v in made if v.leave > time), len(made))
    return (tour[upcoming].task or "") if upcoming < len(tour) else ""
