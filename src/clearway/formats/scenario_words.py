"""What pydantic finds in a table, in the words of a scenario file."""

import re
from typing import Any

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_dump import FORMAT
from clearway.formats.scenario_error import Misfit, Problem, closest, key_path

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
    "robot_types": ("there are no robot types", "add a table [robot_types.NAME]"),
    "visits": ("a task needs at least one visit", "add {pose = [x, y, theta]}"),
    "format": ("the format is not named", f"add format = '{FORMAT}' at the top"),
}


def translate(error: Any) -> Problem:
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
