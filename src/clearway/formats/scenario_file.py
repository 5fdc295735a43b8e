"""Reading scenario files (TOML, format ``clearway.scenario/1``)."""

import re
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from clearway.formats.atomic import ABSENT, write_bytes
from clearway.formats.order_file import read_orders
from clearway.formats.scenario_checks import find_non_numbers, find_problems
from clearway.formats.scenario_dump import FORMAT, dump_scenario
from clearway.formats.scenario_error import OrderFileError, Problem, ScenarioError
from clearway.formats.scenario_models import ScenarioTable
from clearway.formats.scenario_words import translate
from clearway.formats.source import read_source, unreadable
from clearway.formats.starting_places import start_fleets
from clearway.model import Scenario, Site

__all__ = [
    "FORMAT",
    "OrderFileError",
    "ScenarioError",
    "copy_scenario",
    "dump_scenario",
    "parse_scenario",
    "read_scenario",
    "scenario_schema",
]


def read_scenario(path: Path | str) -> Scenario:
    """Read a scenario file, and the order files that it names.

    Raises
    ------
    ScenarioError, OrderFileError
        Names the file, the key, its value and the mend.
    """
    path = Path(path)
    raw = read_source(path, "a scenario file (.toml)", ScenarioError)
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        what = f"is not UTF-8 at byte {error.start}"
        raise unreadable(str(path), what, "save it as UTF-8", ScenarioError) from error
    return parse_scenario(text, str(path))


def parse_scenario(text: str, file: str = "scenario.toml") -> Scenario:
    """Read a scenario from TOML text.

    Parameters
    ----------
    file
        Name used in messages; order files are looked for in its folder.

    Raises
    ------
    ScenarioError, OrderFileError
        Names the file, the key, its value and the mend.
    """
    try:
        document = tomllib.loads(text)
    except RecursionError as error:
        mend = "write flat tables"
        raise unreadable(file, "is nested too deeply", mend, ScenarioError) from error
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
        raise ScenarioError(file, [translate(e) for e in error.errors()]) from error
    try:
        site = table.site.built()
    except ValueError as error:
        what, _, mend = str(error).removeprefix("layout.").partition("; ")
        key, _, what = what.partition(" ")
        problem = Problem(
            f"site.layout.{key.strip(':')}", ABSENT, what, mend or "change the layout"
        )
        raise ScenarioError(file, [problem]) from error
    return _scenario(table, site, file)


def _scenario(table: ScenarioTable, site: Site, file: str) -> Scenario:
    starts, problems = start_fleets(table.fleets, site)
    idle = Scenario(
        name=table.name,
        site=site,
        robot_types={name: kind.built(name) for name, kind in table.robot_types.items()},
        robots=(*(robot.built() for robot in table.robots), *starts),
        orders=(),
        system=table.system.name,
        settings=dict(table.system.model_extra or {}),
        seed=table.seed,
        simulation=table.simulation.built(),
    )
    problems += find_problems(table, idle)
    if problems:
        raise ScenarioError(file, problems)
    poses = {zone.name: zone.pose for zone in site.zones if zone.pose is not None}
    orders = [task.built(poses, tuple(task.after)) for task in table.tasks]
    known = {task.id: f"tasks[{i}] of {file}" for i, task in enumerate(table.tasks)}
    for name in table.orders:
        listed = read_orders(Path(file).parent / name, idle, known)
        known |= {order.task.id: name for order in listed}
        orders += listed
    return replace(idle, orders=tuple(orders))


def copy_scenario(source: Path, to: Path) -> None:
    """Copy a scenario file so that the copy needs no other file.

    The bytes stay as they are; but where it names order files, it is written anew with their
    orders as tasks.
    """
    if source.resolve() == to.resolve():
        return
    raw = source.read_bytes()
    if tomllib.loads(raw.decode("utf-8-sig")).get("orders"):
        comment = "Tasks are those of the file that this was copied from, and of its order files."
        raw = dump_scenario(read_scenario(source), comment).encode()
    write_bytes(to, raw)


def scenario_schema() -> dict[str, Any]:
    """Return the JSON Schema of scenario files."""
    schema = ScenarioTable.model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
