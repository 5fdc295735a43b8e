"""Which keys each event of a trace has, and of what kind."""

from collections.abc import Callable
from typing import Any

from clearway.formats.json_node import Node
from clearway.formats.plan_parts import built, outline_of, polygon_of, pose_of
from clearway.formats.trace_dump import SAMPLES
from clearway.model import Zone

ORDER_STATES = ("released", "assigned", "started", "done", "failed", "cancelled")
END_STATES = ("done", "ended", "stuck", "stopped", "interrupted")


def event_of(node: Node, robots: set[str]) -> dict[str, Any]:
    """Return an event, with arrays of samples as NumPy arrays.

    Events of a kind that is not known are kept as they are.

    Raises
    ------
    FormatError
        If a key is missing, of the wrong type, or names a robot that is not among ``robots``.
    """
    kind = node["event"].text()
    event: dict[str, Any] = node.value
    robot = node["robot"]
    if robot.given and robot.text() not in robots:
        robot.fail("unknown robot", f"known: {', '.join(sorted(robots)) or 'none'}")
    if kind == "motion":
        return {**event, **_samples(node)}
    _seconds(node["t"])
    if kind in _CHECKS:
        _CHECKS[kind](node)
    return event


def _samples(node: Node) -> dict[str, Any]:
    node["robot"].text()
    arrays = {name: node[name].array() for name in SAMPLES}
    count = len(arrays["t"])
    if count == 0:
        node["t"].fail("no samples", "leave the motion out")
    lengths = {name: len(array) for name, array in arrays.items()}
    if node["mode"].given:
        lengths["mode"] = len(node["mode"].texts_or_none())
    for name, length in lengths.items():
        if length != count:
            node[name].fail_key(f"{length} samples where t has {count}", "give all one length")
    return arrays


def _seconds(node: Node) -> float:
    value = node.figure()
    if value < 0.0:
        node.fail("must be 0 or above", "give the time in s")
    return value


def _one_of(node: Node, known: tuple[str, ...]) -> str:
    if node.text() not in known:
        node.fail("unknown word", f"one of {', '.join(known)}")
    return str(node.value)


def _texts(node: Node) -> None:
    for inner in node.elements():
        inner.text()


def _optional(node: Node, *names: str, check: Callable[[Node], object]) -> None:
    for name in names:
        if node[name].given:
            check(node[name])


def _order(node: Node) -> None:
    node["order"].text()
    _one_of(node["state"], ORDER_STATES)
    _optional(node, "reason", "fetches", check=Node.text)
    _optional(node, "due", "priority", check=Node.figure)
    _optional(node, "visits", check=Node.integer)


def _visit(node: Node) -> None:
    node["robot"].text()
    _optional(node, "task", "order", "place", "purpose", check=Node.text)
    if _one_of(node["state"], ("arrived", "left")) == "arrived":
        pose_of(node["pose"])
        _seconds(node["service"])


def _wait(node: Node) -> None:
    node["robot"].text()
    _texts(node["for"])
    _optional(node, "until", check=_seconds)
    _optional(node, "because", check=Node.text)


def _load(node: Node) -> None:
    node["robot"].text()
    _texts(node["objects"])


def _energy(node: Node) -> None:
    node["robot"].text()
    node["level"].figure()


def _fault(node: Node) -> None:
    node["kind"].text()
    node["state"].text()
    if node["zone"].given:
        name, polygon = node["zone"].text(), node["polygon"]
        outline = outline_of(polygon)
        built(polygon, lambda: Zone(name, "closed", outline))


def _decision(node: Node) -> None:
    node["kind"].text()
    _optional(node, "order", "purpose", "chosen", "because", "outcome", "reason", check=Node.text)
    _optional(node, "rest", check=Node.text)
    _optional(node, "score", "cpu_s", check=Node.figure)
    _optional(node, "arrive", check=Node.array)
    _optional(node, "causes", check=_texts)
    _optional(node, "alternatives", check=_alternatives)
    _optional(node, "route", check=polygon_of)


def _alternatives(node: Node) -> None:
    for other in node.elements():
        other["name"].text()
        other["score"].figure()


def _end(node: Node) -> None:
    _one_of(node["status"], END_STATES)
    _optional(node, "orders_done", "orders_open", check=Node.integer)
    _optional(node, "makespan", "distance", "waiting", check=Node.figure)


_CHECKS: dict[str, Callable[[Node], None]] = {
    "order": _order,
    "visit": _visit,
    "wait": _wait,
    "load": _load,
    "energy": _energy,
    "fault": _fault,
    "decision": _decision,
    "end": _end,
}
