"""Checks of a scenario file that need more than one of its tables."""

from collections.abc import Iterator

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_error import Problem, closest, key_path
from clearway.formats.scenario_models import (
    RobotTable,
    ScenarioTable,
    SiteTable,
    TaskTable,
    VisitTable,
)
from clearway.model import LOAD_CHANGE
from clearway.model.robot import FOUR_WHEEL_MODES
from clearway.protocols import find_circle


def find_problems(table: ScenarioTable) -> list[Problem]:
    """Return everything that is wrong between the tables; empty if they agree."""
    return [
        *_repeated("robots", [robot.id for robot in table.robots], "id"),
        *_repeated("tasks", [task.id for task in table.tasks], "id"),
        *_repeated("site.zones", [zone.name for zone in table.site.zones], "name"),
        *_type_names(table),
        *_blocks(table.site, table),
        *_fleet(table),
        *_work(table),
        *_order_of_tasks(table.tasks),
    ]


def _repeated(where: str, names: list[str], key: str) -> Iterator[Problem]:
    first: dict[str, int] = {}
    for i, name in enumerate(names):
        if name in first:
            what = f"already the {key} of {where}[{first[name]}]"
            yield Problem(f"{where}[{i}].{key}", name, what, f"give each its own {key}")
        first.setdefault(name, i)


def _type_names(table: ScenarioTable) -> Iterator[Problem]:
    for name in table.robot_types:
        if not name.strip() or ":" in name or not name.isprintable() or len(name) > 200:
            mend = "use 1 to 200 printable characters without a colon"
            key = key_path(("robot_types", name))
            yield Problem(key, name, "is not usable as the name of a robot type", mend)


def _blocks(site: SiteTable, table: ScenarioTable) -> Iterator[Problem]:
    known = [f"{name}{state}" for name in table.robot_types for state in ("", ":loaded")]
    for i, obstacle in enumerate(site.obstacles):
        for j, name in enumerate(obstacle.blocks):
            if name not in known:
                key = f"site.obstacles[{i}].blocks[{j}]"
                yield Problem(key, name, "names no robot type", closest(name, known))


def _fleet(table: ScenarioTable) -> Iterator[Problem]:
    for i, robot in enumerate(table.robots):
        kind = table.robot_types.get(robot.type)
        if kind is None:
            mend = closest(robot.type, table.robot_types)
            yield Problem(f"robots[{i}].type", robot.type, "unknown robot type", mend)
            continue
        if abs(robot.start_speed) > kind.limits.speed:
            what = f"exceeds the type's speed {kind.limits.speed:g} m/s"
            mend = "start no faster than the type's speed (m/s)"
            yield Problem(f"robots[{i}].start_speed", robot.start_speed, what, mend)
        modes = kind.modes or (FOUR_WHEEL_MODES if kind.kinematics == "four_wheel" else ())
        if robot.start_mode is not None and robot.start_mode not in modes:
            mend = closest(robot.start_mode, modes)
            yield Problem(
                f"robots[{i}].start_mode", robot.start_mode, "not a mode of its type", mend
            )


def _work(table: ScenarioTable) -> Iterator[Problem]:
    robots = {robot.id: robot for robot in table.robots if robot.type in table.robot_types}
    stations = [zone.name for zone in table.site.zones if zone.pose is not None]
    for i, task in enumerate(table.tasks):
        where = f"tasks[{i}]"
        if task.robot is not None and task.robot not in {robot.id for robot in table.robots}:
            mend = closest(task.robot, robots)
            yield Problem(f"{where}.robot", task.robot, "unknown robot", mend)
            continue
        for j, visit in enumerate(task.stops()):
            at = where if task.visits is None else f"{where}.visits[{j}]"
            if visit.station is not None and visit.station not in stations:
                mend = closest(visit.station, stations)
                yield Problem(
                    f"{at}.station", visit.station, "no zone with a pose has this name", mend
                )
            yield from _together(visit, task, at, robots)
        yield from _able(table, task, where, robots)


def _order_of_tasks(tasks: list[TaskTable]) -> Iterator[Problem]:
    """Check that tasks wait for other tasks, and never in a circle."""
    numbers = {task.id: i for i, task in enumerate(tasks)}
    waits: list[tuple[int, int]] = []
    for i, task in enumerate(tasks):
        for k, other in enumerate(task.after):
            key = f"tasks[{i}].after[{k}]"
            if other not in numbers:
                yield Problem(key, other, "unknown task", closest(other, numbers))
            elif other == task.id or other in task.after[:k]:
                what = "a task does not wait for itself" if other == task.id else "named twice"
                yield Problem(key, other, what, "name each other task once")
            else:
                waits.append((i, numbers[other]))
    if circle := find_circle(waits):
        told = " after ".join(tasks[i].id for i in (*circle, circle[0]))
        first = tasks[circle[0]]
        what = f"tasks wait for each other: {told}"
        yield Problem(f"tasks[{circle[0]}].after", first.after, what, "drop one of these")


def _together(
    visit: VisitTable, task: TaskTable, at: str, robots: dict[str, RobotTable]
) -> Iterator[Problem]:
    for k, other in enumerate(visit.together):
        key = f"{at}.together[{k}]"
        if other not in robots:
            yield Problem(key, other, "unknown robot", closest(other, robots))
        elif other == task.robot or other in visit.together[:k]:
            what = "a robot does not wait for itself" if other == task.robot else "named twice"
            yield Problem(key, other, what, "name each other robot once")


def _able(
    table: ScenarioTable, task: TaskTable, where: str, robots: dict[str, RobotTable]
) -> Iterator[Problem]:
    """Check that the loads can be taken in this order, by a robot that may do the task."""
    stops = task.stops()
    names = [where if task.visits is None else f"{where}.visits[{j}]" for j in range(len(stops))]
    carried = peak = peak_at = 0
    for j, visit in enumerate(stops):
        carried += LOAD_CHANGE[visit.load]
        if carried < 0:
            what = "drops a load that this task has not picked up"
            yield Problem(
                f"{names[j]}.load", visit.load, what, "add a visit with load = 'pick' before"
            )
            return
        if carried > peak:
            peak, peak_at = carried, j
    candidates = [robots[task.robot]] if task.robot in robots else list(robots.values())
    whose = f"robot {task.robot}" if task.robot else "any robot"
    kinds = [table.robot_types[name] for name in sorted({robot.type for robot in candidates})]
    for j, visit in enumerate(stops):
        if visit.needs is None:
            continue
        kinds = [kind for kind in kinds if visit.needs in kind.capabilities]
        if not kinds:
            had = {name for kind in table.robot_types.values() for name in kind.capabilities}
            mend = f"add it to capabilities of a robot type; {closest(visit.needs, had)}"
            what = f"is not a capability of {whose} that could do the rest of the task"
            yield Problem(f"{names[j]}.needs", visit.needs, what, mend)
            return
    if kinds and peak > max(kind.capacity for kind in kinds):
        most = max(kind.capacity for kind in kinds)
        what = f"is load {peak} on board where {whose} carries at most {most}"
        mend = "drop a load before, or raise capacity of the robot type"
        yield Problem(f"{names[peak_at]}.load", "pick", what, mend)


def find_non_numbers(document: dict[str, object]) -> list[Problem]:
    """Return every NaN and infinity, and every integer beyond 64 bits, by key path."""
    problems: list[Problem] = []
    pending: list[tuple[tuple[str | int, ...], object]] = [((), document)]
    while pending:
        path, value = pending.pop()
        if isinstance(value, dict):
            pending.extend(((*path, key), item) for key, item in value.items())
        elif isinstance(value, list):
            pending.extend(((*path, i), item) for i, item in enumerate(value))
        elif isinstance(value, float) and not abs(value) < float("inf"):
            problems.append(Problem(key_path(path), value, "must be finite", "write a number"))
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            mend = "write a smaller number"
            problems.append(Problem(key_path(path), ABSENT, "exceeds 64 bits", mend))
    return sorted(problems, key=lambda problem: problem.key)
