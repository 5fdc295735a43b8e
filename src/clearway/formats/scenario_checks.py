"""Checks of a scenario file that need more than one of its tables."""

from collections.abc import Iterator, Sequence

from clearway.formats.atomic import ABSENT
from clearway.formats.order_checks import OrderCheck, find_load_problems
from clearway.formats.scenario_error import Problem, closest, key_path
from clearway.formats.scenario_models import ScenarioTable
from clearway.formats.scenario_site import ObstacleTable
from clearway.formats.scenario_work import TaskTable
from clearway.model import Scenario
from clearway.model.robot import FOUR_WHEEL_MODES
from clearway.protocols import find_circle


def find_problems(table: ScenarioTable, scenario: Scenario) -> list[Problem]:
    """Return everything that is wrong between the tables; empty if they agree.

    ``scenario`` is what they make, without the tasks.
    """
    surprises = table.simulation.surprises
    find_order_problems = OrderCheck(scenario)
    return [
        *_repeated("robots", [robot.id for robot in table.robots], "id"),
        *_repeated("tasks", [task.id for task in table.tasks], "id"),
        *_repeated("site.zones", [zone.name for zone in table.site.zones], "name"),
        *_repeated("simulation.streams", [s.name for s in table.simulation.streams], "name"),
        *_type_names(table),
        *_blocks("site.obstacles", table.site.obstacles, table),
        *_blocks("simulation.surprises", surprises, table),
        *_fleet(table),
        *_fleet_names(table),
        *(
            problem
            for i, task in enumerate(table.tasks)
            for problem in find_order_problems(task, f"tasks[{i}]")
        ),
        *_order_of_tasks(table.tasks),
        *_streams(table, scenario),
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


def _blocks(
    where: str, obstacles: Sequence[ObstacleTable], table: ScenarioTable
) -> Iterator[Problem]:
    known = [f"{name}{state}" for name in table.robot_types for state in ("", ":loaded")]
    for i, obstacle in enumerate(obstacles):
        for j, name in enumerate(obstacle.blocks):
            if name not in known:
                key = f"{where}[{i}].blocks[{j}]"
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


def _fleet_names(table: ScenarioTable) -> Iterator[Problem]:
    """Check that fleets have types, and that the ids of their robots are nobody else's."""
    ids = {robot.id: f"robots[{i}]" for i, robot in enumerate(table.robots)}
    for i, fleet in enumerate(table.fleets):
        if fleet.type not in table.robot_types:
            mend = closest(fleet.type, table.robot_types)
            yield Problem(f"fleets[{i}].type", fleet.type, "unknown robot type", mend)
        its = [f"{fleet.name}-{k + 1}" for k in range(fleet.count)]
        if taken := next((name for name in its if name in ids), None):
            what = f"makes a robot {taken}, which is already the id of {ids[taken]}"
            yield Problem(f"fleets[{i}].name", fleet.name, what, "give each its own name")
        ids.update(dict.fromkeys(its, f"a robot of fleets[{i}]"))


def _streams(table: ScenarioTable, scenario: Scenario) -> Iterator[Problem]:
    """Check that what streams draw from is there, and that their loads can be taken."""
    has_pose = {zone.kind for zone in scenario.site.zones if zone.pose is not None}
    shelves = len(scenario.site.zones_of("shelf"))
    for i, stream in enumerate(table.simulation.streams):
        where = f"simulation.streams[{i}]"
        visits = stream.visits or []
        for j, draw in enumerate(visits):
            if draw.kind not in has_pose:
                what = "no zone of this kind has a pose"
                mend = closest(draw.kind, has_pose)
                yield Problem(f"{where}.visits[{j}].kind", draw.kind, what, mend)
        if stream.fetch and (stream.open or 1) > shelves:
            what = f"asks for more shelves than the site's {shelves}"
            key, value = ("open", stream.open) if stream.open else ("fetch", True)
            yield Problem(f"{where}.{key}", value, what, "add zones of kind shelf, or lower open")
        names = [f"{where}.visits[{j}]" for j in range(len(visits))]
        loads = [draw.load for draw in visits]
        kinds = list(scenario.robot_types.values())
        yield from find_load_problems(loads, names, kinds, "any robot")


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
