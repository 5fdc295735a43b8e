"""Order files: CSV, or JSON lines whose objects have the keys of a scenario's tasks."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from pydantic import ValidationError

from clearway.formats.atomic import write_text
from clearway.formats.order_checks import OrderCheck
from clearway.formats.order_table import Entry, format_table, parse_table
from clearway.formats.scenario_checks import find_non_numbers
from clearway.formats.scenario_error import OrderFileError, Problem
from clearway.formats.scenario_words import translate
from clearway.formats.scenario_work import OrderTable
from clearway.formats.source import read_source, unreadable
from clearway.model import Order, Scenario, Visit

__all__ = ["OrderFileError", "parse_order", "read_orders", "write_orders"]

SUFFIXES: Final = (".csv", ".jsonl")
_MARK = b"\xef\xbb\xbf"
_ENDS = (b"\r\n", b"\r")


def read_orders(
    path: Path | str, scenario: Scenario, known: Mapping[str, str] | None = None
) -> tuple[Order, ...]:
    """Read the orders of a CSV (``.csv``) or JSON-lines (``.jsonl``) file.

    Parameters
    ----------
    scenario
        Whose zones and robots the orders name; its own orders do not matter.
    known
        Ids of other orders, and where those are from.

    Raises
    ------
    OrderFileError
        After all lines have been looked at: each problem with its line, column or key, value
        and mend.
    """
    path = Path(path)
    raw = read_source(path, "an order file (.csv or .jsonl)", OrderFileError)
    if path.suffix.lower() not in SUFFIXES:
        what = "is neither .csv nor .jsonl by its name"
        mend = "name it .csv (a header and rows) or .jsonl (one object a line)"
        raise unreadable(str(path), what, mend, OrderFileError)
    lines, problems = _lines(raw)
    is_table = path.suffix.lower() == ".csv"
    if not lines and not problems:
        first = "a header such as id,fetches,release" if is_table else "one JSON object a line"
        raise unreadable(str(path), "is empty", f"write {first}", OrderFileError)
    entries: list[Entry] = []
    if lines:
        entries, wrong = (parse_table if is_table else _parse_lines)(lines)
        problems += wrong
    orders: list[Order] = []
    check = OrderCheck(scenario)
    taken = dict(known or {})
    for entry in entries:
        try:
            orders.append(_order(entry.keys, check, taken))
        except OrderFileError as error:
            at = entry.place if is_table else _key_of(entry)
            problems += [Problem(at(p.key), p.value, p.what, p.mend) for p in error.problems]
        taken.setdefault(str(entry.keys.get("id")), f"line {entry.lines[0]}")
    if problems:
        raise OrderFileError(str(path), sorted(problems, key=_line_of))
    return tuple(orders)


def parse_order(
    keys: Mapping[str, Any], scenario: Scenario, known: Mapping[str, str], now: float = 0.0
) -> Order:
    """Return one order from the keys of a task, as they come from JSON.

    Parameters
    ----------
    known
        Ids of other orders, and where those are from.
    now
        Second before which it cannot be released; and when it is, where it does not say.

    Raises
    ------
    OrderFileError
        Names each key, its value and the mend.
    """
    return _order({"release": now, **keys}, OrderCheck(scenario), known, now)


def _order(
    keys: dict[str, Any], check: OrderCheck, known: Mapping[str, str], now: float = 0.0
) -> Order:
    problems = find_non_numbers(keys)
    table = None
    if not problems:
        try:
            table = OrderTable.model_validate(keys)
        except ValidationError as error:
            problems = [translate(e) for e in error.errors()]
    problems += check.names(keys) if table is None else check(table)
    name = keys.get("id")
    if isinstance(name, str) and name in known:
        what = f"is already the id of the order in {known[name]}"
        problems.append(Problem("id", name, what, "give each its own"))
    if table is not None and table.release < now:
        what = f"is before now, which is {now:g} s"
        problems.append(Problem("release", table.release, what, "leave it out: released at once"))
    if problems or table is None:
        raise OrderFileError("order", problems)
    return table.built(check.poses)


def _lines(raw: bytes) -> tuple[list[tuple[int, str]], list[Problem]]:
    """Return the lines that are not blank, numbered from 1, and those that are not UTF-8."""
    raw = raw.removeprefix(_MARK)
    for end in _ENDS:
        raw = raw.replace(end, b"\n")
    lines: list[tuple[int, str]] = []
    problems: list[Problem] = []
    for number, line in enumerate(raw.split(b"\n"), start=1):
        try:
            text = line.decode("utf-8")
        except UnicodeDecodeError as error:
            what = f"is not UTF-8 at its byte {error.start + 1}"
            problems.append(Problem(f"line {number}", line, what, "save the file as UTF-8"))
            continue
        if text.strip():
            lines.append((number, text))
    return lines, problems


def _parse_lines(lines: Sequence[tuple[int, str]]) -> tuple[list[Entry], list[Problem]]:
    """Return the orders of JSON lines, and what is wrong with the lines."""
    entries: list[Entry] = []
    problems: list[Problem] = []
    for number, text in lines:
        try:
            keys = json.loads(text, object_pairs_hook=_unrepeated)
        except RecursionError:
            what = "is nested too deeply"
            problems.append(Problem(f"line {number}", text, what, "write a flat object"))
            continue
        except ValueError as error:
            where = f" at column {error.colno}" if isinstance(error, json.JSONDecodeError) else ""
            why = error.msg if isinstance(error, json.JSONDecodeError) else error
            mend = 'write one whole object in this line: {"id": "o1", "fetches": "g1"}'
            problems.append(Problem(f"line {number}", text, f"is broken{where} ({why})", mend))
            continue
        if not isinstance(keys, dict):
            mend = 'write an object: {"id": "o1", "fetches": "g1"}'
            problems.append(Problem(f"line {number}", keys, "is no object", mend))
            continue
        entries.append(Entry(keys, [number]))
    return entries, problems


def _unrepeated(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = dict(pairs)
    if len(keys) < len(pairs):
        names = [key for key, _ in pairs]
        twice = next(name for i, name in enumerate(names) if name in names[:i])
        raise ValueError(f"the key {twice} is there twice")
    return keys


def _key_of(entry: Entry) -> Any:
    def place(key: str) -> str:
        return f"line {entry.lines[0]}" + ("" if key == "(file)" else f", key {key}")

    return place


def _line_of(problem: Problem) -> int:
    return int(problem.key.split(",")[0].removeprefix("line "))


def write_orders(path: Path | str, orders: Sequence[Order]) -> None:
    """Write orders as CSV or JSON lines, by the file's name, to be read back equal.

    Raises
    ------
    ValueError
        If an order has what such a file cannot hold.
    """
    path = Path(path)
    if not orders:
        raise ValueError(f"{path}: there are no orders to write; an empty file is refused")
    if path.suffix.lower() == ".jsonl":
        rows = [json.dumps(_keys(order), ensure_ascii=False) for order in orders]
        write_text(path, "".join(f"{row}\n" for row in rows))
    elif path.suffix.lower() == ".csv":
        write_text(path, format_table([row for order in orders for row in _rows(order)]))
    else:
        raise ValueError(f"{path}: an order file ends in .csv or .jsonl; rename it")


def _keys(order: Order) -> dict[str, Any]:
    task = order.task
    if order.after:
        raise ValueError(f"order {task.id} waits for others; only a scenario file can say so")
    if any(visit.not_before or visit.after or visit.due is not None for visit in task.visits):
        raise ValueError(f"order {task.id} has visits with times of their own; drop them")
    place = {"fetches": task.fetches} if task.fetches is not None else {}
    visits = {"visits": [_visit(visit) for visit in task.visits]} if task.visits else {}
    due = {} if order.due is None else {"due": order.due}
    own = {"release": order.release, "priority": order.priority, "robot": task.robot}
    return {"id": task.id, **place, **visits, **due, **{k: v for k, v in own.items() if v}}


def _visit(visit: Visit) -> dict[str, Any]:
    rest = {"service": visit.service, "load": visit.load, "needs": visit.needs}
    together = {"together": list(visit.together)} if visit.together else {}
    return {"pose": list(visit.pose), **{k: v for k, v in rest.items() if v}, **together}


def _rows(order: Order) -> Iterator[dict[str, Any]]:
    keys = _keys(order)
    visits = keys.pop("visits", None)
    for name in (order.task.id, order.task.robot, order.task.fetches):
        if name is not None and name != name.strip():
            raise ValueError(f"a CSV file cannot hold the blanks around {name!r}; write .jsonl")
    if visits is None:
        yield keys
        return
    for visit in visits:
        if "together" in visit:
            raise ValueError(f"a CSV file cannot hold together of {order.task.id}; write .jsonl")
        x, y, theta = visit.pop("pose")
        yield keys | {"x": x, "y": y, "theta": theta} | visit
        keys = {"id": order.task.id}
