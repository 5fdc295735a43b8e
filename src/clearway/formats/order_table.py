"""Orders of a table of comma-separated values, one visit a row."""

import csv
import io
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_error import Problem, closest

POSE: Final[tuple[str, ...]] = ("x", "y", "theta", "theta_deg")
OF_A_VISIT: Final[tuple[str, ...]] = ("service", "load", "needs")
OF_AN_ORDER: Final[tuple[str, ...]] = ("fetches", "release", "due", "priority", "robot")
COLUMNS: Final = ("id", *OF_AN_ORDER, "station", *POSE, *OF_A_VISIT)
NUMBERS: Final = (*POSE, "service", "release", "due", "priority")


@dataclass
class Entry:
    """An order as a file has it: the keys of a task, and the lines that they stand in.

    ``lines`` holds the number of the order's line, or of each of its visits.
    """

    keys: dict[str, Any]
    lines: list[int] = field(default_factory=list)

    def place(self, key: str) -> str:
        """Return where the key of a task stands, as ``line 7, column due``."""
        found = re.match(r"visits\[(\d+)\]\.?", key)
        line = self.lines[int(found.group(1)) if found else 0]
        column = key[found.end() if found else 0 :].removeprefix("pose").strip(".")
        return f"line {line}, column {column}" if column in COLUMNS else f"line {line}"


def parse_table(lines: Sequence[tuple[int, str]]) -> tuple[list[Entry], list[Problem]]:
    """Return the orders of CSV lines, numbered, and what is wrong with the lines.

    The first one names the columns. Neighbouring rows with one id are the visits of one order.
    """
    (number, first), *rest = lines
    comma = ";" if first.count(";") > first.count(",") else ","
    problems: list[Problem] = []
    header = [name.strip() for name in _fields(first, comma, number, problems)]
    problems += _check_header(header, number)
    is_sound = not problems
    entries: list[Entry] = []
    for number, text in rest:
        cells = _fields(text, comma, number, problems)
        if not cells:
            continue
        if len(cells) != len(header):
            what = f"has {len(cells)} fields where the header has {len(header)}"
            mend = f"write {len(header)} fields, empty ones too, and quote what holds a {comma!r}"
            problems.append(Problem(f"line {number}", text, what, mend))
            continue
        row = {k: cell.strip() for k, cell in zip(header, cells, strict=True) if cell.strip()}
        values = _values(row, number, problems)
        if values is not None and is_sound:
            _add(values, number, entries, problems)
    return entries, problems


def _fields(text: str, comma: str, number: int, problems: list[Problem]) -> list[str]:
    try:
        return next(csv.reader([text], delimiter=comma, strict=True), [])
    except csv.Error as error:
        mend = 'write "" for a quote within quotes, and end what begins with one on its line'
        problems.append(Problem(f"line {number}", text, f"is broken ({error})", mend))
        return []


def _check_header(header: Sequence[str], number: int) -> Iterator[Problem]:
    for i, name in enumerate(header):
        where = f"line {number}, column {i + 1}"
        if name not in COLUMNS:
            yield Problem(where, name, "unknown column", closest(name, COLUMNS))
        elif name in header[:i]:
            what = f"is already column {header.index(name) + 1}"
            yield Problem(where, name, what, "keep one of them")
    where = f"line {number}"
    if "id" not in header:
        yield Problem(where, ABSENT, "has no column id", "name the columns here, id among them")
    if not {"fetches", "station", "x"} & set(header):
        mend = "add one of them, or the columns x, y and theta"
        yield Problem(where, ABSENT, "has no column fetches or station", mend)


def _values(row: Mapping[str, str], number: int, problems: list[Problem]) -> dict[str, Any] | None:
    """Return text and numbers by column; ``None`` where a number is none."""
    values: dict[str, Any] = {}
    for name, cell in row.items():
        if name not in NUMBERS:
            values[name] = cell
            continue
        try:
            values[name] = float(cell)
        except ValueError:
            values[name] = math.nan
        if not math.isfinite(values[name]) or "_" in cell:
            mend = "write a number such as 12.5, with a point, or leave it empty"
            problems.append(
                Problem(f"line {number}, column {name}", cell, "is no finite number", mend)
            )
            del values[name]
    return values if len(values) == len(row) else None


def _add(
    values: dict[str, Any], number: int, entries: list[Entry], problems: list[Problem]
) -> None:
    """Make an order of a row, or add its visit to the order before."""
    where = f"line {number}"
    if "id" not in values:
        problems.append(Problem(f"{where}, column id", ABSENT, "is empty", "name the order"))
        return
    last = entries[-1] if entries else None
    goes_on = last is not None and last.keys["id"] == values["id"]
    visit = {key: values[key] for key in ("station", *OF_A_VISIT) if key in values}
    pose = {key: values[key] for key in POSE if key in values}
    if pose:
        visit["pose"] = pose
    fetches = "fetches" in values
    places = fetches + ("station" in values) + bool(pose)
    if places != 1:
        mend = "fill in fetches, or station, or x, y and theta"
        what = "says in two ways where to go" if places else "does not say where to go"
        problems.append(Problem(where, ABSENT, what, mend))
        return
    if pose and not (pose.keys() >= {"x", "y"} and ("theta" in pose) != ("theta_deg" in pose)):
        what, mend = "needs x, y and one of theta and theta_deg", "fill in all three"
        problems.append(Problem(where, pose, what, mend))
        return
    own = {key: values[key] for key in OF_AN_ORDER if key in values}
    if not goes_on or last is None:
        keys = {"id": values["id"], **own} | (visit if fetches else {"visits": [visit]})
        entries.append(Entry(keys, [number]))
        return
    if fetches or "visits" not in last.keys:
        what = f"is already the id of the order in line {last.lines[0]}"
        problems.append(Problem(f"{where}, column id", values["id"], what, "give each its own"))
        return
    for key in own:
        if own[key] != last.keys.get(key):
            what = f"differs from line {last.lines[0]}, the first of order {values['id']}"
            mend = "write it there, once for all its visits"
            problems.append(Problem(f"{where}, column {key}", own[key], what, mend))
    last.keys["visits"].append(visit)
    last.lines.append(number)


def format_table(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return rows as CSV text, with those columns that any of them fills."""
    used = [name for name in COLUMNS if any(name in row for row in rows)] or ["id", "station"]
    text = io.StringIO()
    writer = csv.DictWriter(text, used, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({k: repr(v) if isinstance(v, float) else v for k, v in row.items()})
    return text.getvalue()
