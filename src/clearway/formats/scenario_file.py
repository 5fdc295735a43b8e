"""Reading scenario files (TOML, format ``clearway.scenario/1``)."""

import re
import stat
import tomllib
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_checks import find_non_numbers, find_problems
from clearway.formats.scenario_dump import FORMAT, dump_scenario
from clearway.formats.scenario_error import Misfit, Problem, ScenarioError, closest, key_path
from clearway.formats.scenario_models import (
    RobotTypeTable,
    ScenarioTable,
    SiteTable,
    TaskTable,
    VisitTable,
)
from clearway.model import (
    Battery,
    Limits,
    Obstacle,
    Order,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
    Zone,
)

__all__ = [
    "FORMAT",
    "ScenarioError",
    "dump_scenario",
    "parse_scenario",
    "read_scenario",
    "scenario_schema",
]

LARGEST_FILE = 64 * 2**20

_WRITTEN_IN = {
    "speed": "m/s",
    "reverse_speed": "m/s",
    "start_speed": "m/s",
    "yaw_rate": "rad/s, not degrees",
    "turning_radius": "m",
    "acceleration": "m/s^2",
    "deceleration": "m/s^2",
    "clearance": "m",
    "service": "s",
    "release": "s",
    "due": "s",
    "mode_switch": "s",
}
_KINDS = {
    "float_type": ("must be a number", "write a number"),
    "int_type": ("must be a whole number", "write a whole number without a point"),
    "int_from_float": ("must be a whole number", "write a whole number"),
    "string_type": ("must be a string", "write it in quotes"),
    "list_type": ("must be a list", "write it in square brackets"),
    "dict_type": ("must be a table", "write it as a table [..] or {key = value}"),
    "model_type": ("must be a table", "write it as a table [..] or {key = value}"),
    "model_attributes_type": ("must be a table", "write it as a table [..] or {key = value}"),
}
_EMPTY = {
    "robots": ("the fleet is empty", "add a robot: {id = 'r1', type = .., start = [x, y, theta]}"),
    "robot_types": ("there are no robot types", "add a table [robot_types.NAME]"),
    "visits": ("a task needs at least one visit", "add {pose = [x, y, theta]}"),
    "format": ("the format is not named", f"add format = '{FORMAT}' at the top"),
}


def read_scenario(path: Path | str) -> Scenario:
    """Read a scenario file.

    Raises
    ------
    ScenarioError
        Names the file, the key, its value and the mend.
    """
    path = Path(path)
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            what = "is a directory" if stat.S_ISDIR(status.st_mode) else "is not a regular file"
            raise _unreadable(str(path), what, "name a scenario file (.toml)")
        if status.st_size > LARGEST_FILE:
            what = f"has {status.st_size} bytes, more than {LARGEST_FILE // 2**20} MiB"
            raise _unreadable(str(path), what, "split the scenario or shorten it")
        raw = path.read_bytes()
    except OSError as error:
        what = f"cannot be read ({error.strerror})"
        raise _unreadable(str(path), what, "check the name and the permissions") from error
    except ValueError as error:
        if isinstance(error, ScenarioError):
            raise
        raise _unreadable(str(path), f"cannot be read ({error})", "check the name") from error
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        what = f"is not UTF-8 at byte {error.start}"
        raise _unreadable(str(path), what, "save it as UTF-8") from error
    return parse_scenario(text, str(path))


def _unreadable(file: str, what: str, mend: str) -> ScenarioError:
    return ScenarioError(file, [Problem("(file)", ABSENT, what, mend)])


def parse_scenario(text: str, file: str = "scenario.toml") -> Scenario:
    """Read a scenario from TOML text; ``file`` is the name used in messages.

    Raises
    ------
    ScenarioError
        Names the file, the key, its value and the mend.
    """
    try:
        document = tomllib.loads(text)
    except RecursionError as error:
        raise _unreadable(file, "is nested too deeply", "write flat tables") from error
    except ValueError as error:
        place = re.search(r"\(at (.*)\)$", str(error))
        key = f"({place.group(1)})" if place else "(file)"
        mend = "mend the TOML there: strings in quotes, lists in brackets, key = value"
        what = f"is not TOML: {error}"
        raise ScenarioError(file, [Problem(key, ABSENT, what, mend)]) from error
    if problems := find_non_numbers(document):
        raise ScenarioError(file, problems)
    try:
        table = ScenarioTable.model_validate(document)
    except ValidationError as error:
        raise ScenarioError(file, [_translate(e) for e in error.errors()]) from error
    if problems := find_problems(table):
        raise ScenarioError(file, problems)
    return _scenario(table)


def scenario_schema() -> dict[str, Any]:
    """Return the JSON Schema of scenario files."""
    schema = ScenarioTable.model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _translate(error: Any) -> Problem:
    """Say what pydantic found in the words of a scenario file."""
    path: tuple[str | int, ...] = tuple(error["loc"])
    context = error.get("ctx", {})
    kind, last = error["type"], path[-1] if path else ""
    misfit = context.get("error")
    if isinstance(misfit, Misfit):
        where = key_path((*path, *misfit.path)) or "(file)"
        return Problem(where, misfit.value, misfit.what, misfit.mend)
    key, value = key_path(path), error["input"]
    if kind == "missing":
        what, mend = _EMPTY.get(str(last), ("is missing", f"add {last}"))
        return Problem(key, ABSENT, what, mend)
    if kind == "too_short":
        what, mend = _EMPTY.get(str(last), ("is empty", "add an entry"))
        return Problem(key, value, what, mend)
    if kind == "literal_error":
        known = re.findall(r"'([^']*)'", context["expected"])
        return Problem(key, value, "is not a known word", closest(value, known))
    if kind in _KINDS:
        what, mend = _KINDS[kind]
        return Problem(key, value, what, mend)
    what = error["msg"].removeprefix("Input should be ")
    unit = _WRITTEN_IN.get(str(last))
    mend = f"write it in {unit}" if unit else f"write a value {what}"
    return Problem(key, value, f"must be {what}", mend)


def _scenario(table: ScenarioTable) -> Scenario:
    stations = {zone.name: zone.pose for zone in table.site.zones}
    return Scenario(
        name=table.name,
        site=_site(table.site),
        robot_types={name: _robot_type(name, t) for name, t in table.robot_types.items()},
        robots=tuple(
            Robot(r.id, r.type, r.start, r.start_speed, r.start_mode) for r in table.robots
        ),
        orders=tuple(
            Order(
                Task(t.id, tuple(_visit(t, v, stations) for v in t.stops()), t.robot),
                t.release,
                t.due,
                t.priority,
                tuple(t.after),
            )
            for t in table.tasks
        ),
        system=table.system.name,
        settings=dict(table.system.model_extra or {}),
        seed=table.seed,
    )


def _site(table: SiteTable) -> Site:
    obstacles = tuple(Obstacle(o.polygon, o.disc, o.wall, tuple(o.blocks)) for o in table.obstacles)
    zones = tuple(Zone(z.name, z.kind, z.polygon, z.pose, z.value) for z in table.zones)
    return Site(table.bounds, obstacles, zones, table.border)


def _robot_type(name: str, table: RobotTypeTable) -> RobotType:
    return RobotType(
        name=name,
        footprint=table.footprint,
        kinematics=table.kinematics,
        limits=Limits(**table.limits.model_dump()),
        loaded_footprint=table.loaded_footprint,
        clearance=table.clearance,
        modes=tuple(table.modes),
        mode_switch=table.mode_switch,
        capacity=table.capacity,
        capabilities=frozenset(table.capabilities),
        battery=Battery(**table.battery.model_dump()) if table.battery else None,
        motion=table.motion,
    )


def _visit(task: TaskTable, visit: VisitTable, stations: dict[str, Any]) -> Visit:
    return Visit(
        task=task.id,
        pose=visit.pose if visit.pose is not None else stations[visit.station or ""],
        service=visit.service,
        load=visit.load,
        needs=visit.needs,
        together=tuple(visit.together),
    )
