"""Travel costs: how far apart an assigner believes tasks to be."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from clearway.assign.costs import loads_after
from clearway.model import RobotType, Scenario, Site
from clearway.plan import TeamParams
from clearway.plan.bounds import LegBounds
from clearway.plan.lone_legs import Drive, lone_seconds
from clearway.protocols import AssignmentProblem

Floats = NDArray[np.float64]
# Where in an array a sum of drives belongs: rows of robots, then tasks.
Entry = tuple[Floats, tuple[int | list[int], ...], tuple[Drive, ...]]


class Travel(Protocol):
    """Tells an assigner the ways that robots really have."""

    def __call__(self, scenario: Scenario, work: AssignmentProblem) -> AssignmentProblem:
        """Return the problem with other ways; what cannot be driven remains so."""
        ...


class Durations(Protocol):
    """How long drives last."""

    def __call__(self, site: Site, robot_type: RobotType, drives: Sequence[Drive]) -> Floats:
        """Return seconds, NaN where they are not known."""
        ...


def by_grid(scenario: Scenario, work: AssignmentProblem) -> AssignmentProblem:
    """Leave the ways as they are: shortest paths over a grid."""
    return work


def bounded_seconds(site: Site, robot_type: RobotType, drives: Sequence[Drive]) -> Floats:
    """Return bounds: any-angle ways round obstacles, Reeds-Shepp curves and turns."""
    bounds = LegBounds(site)
    return np.array(
        [bounds(robot_type, d.loaded, d.start, d.goal).seconds for d in drives], dtype=np.float64
    )


@dataclass(frozen=True)
class Searched:
    """Durations of lone ways, found by the planner's own search."""

    params: TeamParams

    def __call__(self, site: Site, robot_type: RobotType, drives: Sequence[Drive]) -> Floats:
        """Return how long each drive lasts with nobody else on the site."""
        return lone_seconds(site, robot_type, drives, self.params)


@dataclass(frozen=True)
class ByDuration:
    """Ways as long as a robot gets at the problem's speed in the time that they take it.

    Each leg from a start or task to a task is asked for once per robot type and load. Where a
    duration is not known, the way stays as long as it was.
    """

    durations: Durations

    def __call__(self, scenario: Scenario, work: AssignmentProblem) -> AssignmentProblem:
        """Return the problem with ways measured in time."""
        start, between, inner = (
            np.array(ways) for ways in (work.start_to_task, work.task_to_task, work.inner)
        )
        for name in sorted({robot.type for robot in scenario.robots}):
            entries = [
                (array, place, drives)
                for array, place, drives in _entries(scenario, name, (start, between, inner))
                if drives and np.isfinite(array[place]).all()
            ]
            drives = list(dict.fromkeys(drive for _, _, drives in entries for drive in drives))
            seconds = self.durations(scenario.site, scenario.robot_types[name], drives)
            lasts = dict(zip(drives, seconds.tolist(), strict=True))
            for array, place, parts in entries:
                total = sum(lasts[drive] for drive in parts)
                if not np.isnan(total):
                    array[place] = total * work.speed
        return replace(work, start_to_task=start, task_to_task=between, inner=inner)


def _entries(
    scenario: Scenario, type_name: str, ways: tuple[Floats, Floats, Floats]
) -> Iterator[Entry]:
    """Yield the drives of one robot type, each with its place in the arrays of ways."""
    start, between, inner = ways
    like = [k for k, robot in enumerate(scenario.robots) if robot.type == type_name]
    tasks = [order.task for order in scenario.orders]
    for j, task in enumerate(tasks):
        first = task.visits[0].pose
        for k in like:
            yield start, (k, j), (Drive(scenario.robots[k].start, first),)
        for i, before in enumerate(tasks):
            if i != j:
                drive = Drive(before.visits[-1].pose, first, loads_after(before)[-1] > 0)
                yield between, (like, i, j), (drive,)
        loads = loads_after(task)
        yield (
            inner,
            (like, j),
            tuple(
                Drive(here.pose, there.pose, load > 0)
                for (here, there), load in zip(pairwise(task.visits), loads, strict=False)
            ),
        )
