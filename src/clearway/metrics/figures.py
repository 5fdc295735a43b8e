"""The figures of a plan: costs and their bounds, how the time was spent, who came how close."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from clearway.metrics.activities import Activity, activities
from clearway.metrics.motion import arrival_sample, step_lengths, track_of
from clearway.metrics.visits import visit_times
from clearway.model import PlanRecord, Robot


@dataclass(frozen=True)
class RobotMetrics:
    """One robot's share; lengths in m, times in s.

    Parameters
    ----------
    arrival
        First moment of the final rest; 0 if it never moves.
    waiting
        Rest that is neither service nor after the last arrival.
    utilisation
        Fraction of the plan's ``duration`` spent driving, turning or serving.
    tasks
        Ids in the order in which the robot takes them up.
    finished
        Whether all its visits are made.
    """

    robot: str
    distance: float
    arrival: float
    driving: float
    turning: float
    waiting: float
    service: float
    utilisation: float
    tasks: tuple[str, ...]
    finished: bool


@dataclass(frozen=True)
class Separation:
    """Least distance (m) between the bodies of two robots, and when (s) it is reached."""

    first: str
    second: str
    metres: float
    time: float


@dataclass(frozen=True)
class Metrics:
    """The figures of one plan; lengths in m, times in s.

    Parameters
    ----------
    gap
        ``sum_of_costs / lower_bound - 1``; ``None`` without a bound above 0 or where the plan
        is not complete.
    duration
        End of the last activity of all, service at the last visit included.
    tardiness
        Sum over tasks of the seconds that they are finished after they are due; those not
        finished do not count. ``None`` where no task is due.
    separations
        One per pair, the closest pair first.
    violations
        Number of findings of the judge.
    """

    status: str
    robots: int
    tasks: int
    tasks_done: int
    sum_of_costs: float
    makespan: float
    lower_bound: float | None
    gap: float | None
    cost: float | None
    cost_name: str | None
    cost_lower_bound: float | None
    distance: float
    duration: float
    tardiness: float | None
    per_robot: tuple[RobotMetrics, ...]
    separations: tuple[Separation, ...]
    violations: int

    @property
    def least_separation(self) -> Separation | None:
        """The closest encounter of all; ``None`` with fewer than two robots."""
        return self.separations[0] if self.separations else None


def plan_metrics(
    record: PlanRecord, separations: Sequence[tuple[str, str, float, float]], violations: int
) -> Metrics:
    """Return the figures of a plan.

    Parameters
    ----------
    separations
        ``(robot, robot, metres, second)`` of each pair's closest encounter, as measured by
        the judge.
    violations
        Number of the judge's findings.
    """
    doings = activities(record)
    duration = max((done[-1].end for done in doings.values() if done), default=0.0)
    per_robot = tuple(
        _robot_metrics(record, robot, doings[robot.id], duration) for robot in record.robots
    )
    bound = record.lower_bound
    tasks, done = _tasks(record)
    return Metrics(
        status=str(record.status),
        robots=len(record.robots),
        tasks=tasks,
        tasks_done=done,
        sum_of_costs=record.sum_of_costs,
        makespan=record.makespan,
        lower_bound=bound,
        gap=record.sum_of_costs / bound - 1.0 if bound and record.status else None,
        cost=record.cost,
        cost_name=record.cost_name,
        cost_lower_bound=record.cost_lower_bound,
        distance=sum(robot.distance for robot in per_robot),
        duration=duration,
        tardiness=_tardiness(record),
        per_robot=per_robot,
        separations=tuple(
            sorted((Separation(*pair) for pair in separations), key=lambda pair: pair.metres)
        ),
        violations=violations,
    )


def to_json(metrics: Metrics) -> dict[str, Any]:
    """Return the content of ``metrics.json``."""
    content = asdict(metrics)
    content["per_robot"] = {
        entry.pop("robot"): {**entry, "tasks": list(entry["tasks"])}
        for entry in content["per_robot"]
    }
    content["separations"] = [_separation_json(pair) for pair in metrics.separations]
    least = metrics.least_separation
    content["least_separation"] = None if least is None else _separation_json(least)
    return content


def _separation_json(pair: Separation) -> dict[str, Any]:
    return {"robots": [pair.first, pair.second], "metres": pair.metres, "time": pair.time}


def _robot_metrics(
    record: PlanRecord, robot: Robot, done: list[Activity], duration: float
) -> RobotMetrics:
    track = track_of(record, robot)
    spent = dict.fromkeys(("drive", "turn", "wait", "service"), 0.0)
    for activity in done:
        spent[activity.kind] += activity.end - activity.start
    busy = spent["drive"] + spent["turn"] + spent["service"]
    return RobotMetrics(
        robot=robot.id,
        distance=float(step_lengths(track).sum()),
        arrival=float(track.t[arrival_sample(track)]),
        driving=spent["drive"],
        turning=spent["turn"],
        waiting=spent["wait"],
        service=spent["service"],
        utilisation=busy / duration if duration else 0.0,
        tasks=tuple(record.assignment.get(robot.id, ())),
        finished=len(visit_times(record, robot)) == len(record.tours.get(robot.id, ())),
    )


def _tardiness(record: PlanRecord) -> float | None:
    if all(visit.due is None for tour in record.tours.values() for visit in tour):
        return None
    late = 0.0
    for robot in record.robots:
        for made in visit_times(record, robot):
            due = record.tours[robot.id][made.visit].due
            if due is not None:
                late += max(made.leave - due, 0.0)
    return round(late, 6)


def _tasks(record: PlanRecord) -> tuple[int, int]:
    """Return how many tasks the fleet has, and how many have all their visits made."""
    wanted: set[str] = set()
    missed: set[str] = set()
    for robot in record.robots:
        made = {entry.visit for entry in visit_times(record, robot)}
        for index, visit in enumerate(record.tours.get(robot.id, ())):
            if visit.task is not None:
                wanted.add(visit.task)
                if index not in made:
                    missed.add(visit.task)
    return len(wanted), len(wanted - missed)
