"""The text of a plan file, the same for the same record."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from clearway.formats.atomic import FormatError
from clearway.model import (
    Battery,
    Footprint,
    Limits,
    Obstacle,
    PlanRecord,
    Robot,
    RobotType,
    Site,
    Track,
    Trajectory,
    Visit,
    Zone,
)

PLAN_FORMAT = "clearway.plan/1"


def dump_plan(record: PlanRecord) -> str:
    """Return the record as JSON text, one line per robot and per array of samples.

    Raises
    ------
    FormatError
        If a number is not finite.
    """
    lines = [f"{_json(name, name)}: {text}" for name, text in _entries(record)]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _entries(record: PlanRecord) -> Iterator[tuple[str, str]]:
    head: dict[str, Any] = {
        "format": PLAN_FORMAT,
        "clearway": record.version,
        "scenario": record.scenario,
        "system": record.system,
        "seed": record.seed,
        "status": record.status.value,
    }
    if record.reason is not None:
        head["reason"] = record.reason
    head |= {
        "sum_of_costs": _float(record.sum_of_costs),
        "makespan": _float(record.makespan),
        "lower_bound": _float(record.lower_bound),
        "cost": _float(record.cost),
        "cost_name": record.cost_name,
        "cost_lower_bound": _float(record.cost_lower_bound),
        "discrete_bound": record.discrete_bound,
        "conflict_free_until": _float(record.conflict_free_until),
        "parameters": record.parameters,
        "timings": record.timings,
    }
    yield from ((name, _json(value, name)) for name, value in head.items())
    yield "site", _lines(site_json(record.site), "site")
    types = {name: robot_type_json(kind) for name, kind in record.robot_types.items()}
    yield "robot_types", _lines(types, "robot_types")
    robots = [robot_json(robot, record.tours.get(robot.id, ())) for robot in record.robots]
    rows = [_json(row, f"robots[{i}]") for i, row in enumerate(robots)]
    yield "robots", "[\n  " + ",\n  ".join(rows) + "\n]" if rows else "[]"
    yield "assignment", _lines({k: list(v) for k, v in record.assignment.items()}, "assignment")
    tracks = {name: _track(track, name) for name, track in record.tracks.items()}
    yield "trajectories", _nested(tracks, "trajectories")
    if record.paths:
        paths = {name: _path(path) for name, path in record.paths.items()}
        yield "pieces", _nested(paths, "pieces")


def _json(value: Any, key: str) -> str:
    try:
        return json.dumps(value, allow_nan=False, ensure_ascii=False)
    except ValueError:
        raise FormatError(
            "holds a number that is not finite", key=key, mend="plans hold finite numbers only"
        ) from None
    except TypeError as error:
        raise FormatError(f"holds what JSON cannot ({error})", key=key, mend="convert it") from None


def _lines(content: Mapping[str, Any], key: str) -> str:
    """Return an object with one line per entry."""
    rows = [f"  {_json(k, key)}: {_json(v, f'{key}.{k}')}" for k, v in content.items()]
    return "{\n" + ",\n".join(rows) + "\n}" if rows else "{}"


def _nested(content: Mapping[str, Mapping[str, Any]], key: str) -> str:
    """Return an object of objects with one line per inner entry."""
    blocks = []
    for name, inner in content.items():
        rows = [f"    {_json(k, key)}: {_json(v, f'{key}.{name}.{k}')}" for k, v in inner.items()]
        blocks.append(f"  {_json(name, key)}: {{\n" + ",\n".join(rows) + "\n  }")
    return "{\n" + ",\n".join(blocks) + "\n}" if blocks else "{}"


def _float(value: float | None) -> float | None:
    # Whole numbers are read again as floats, so they are written as such.
    return None if value is None else float(value)


def _point(point: Sequence[float]) -> list[float]:
    return [float(value) for value in point]


def site_json(site: Site) -> dict[str, Any]:
    """Return a site as plan and trace files write it."""
    content: dict[str, Any] = {"bounds": site.bounds, "border": site.border}
    content["obstacles"] = [_obstacle(obstacle) for obstacle in site.obstacles]
    content["zones"] = [_zone(zone) for zone in site.zones]
    return content


def _obstacle(obstacle: Obstacle) -> dict[str, Any]:
    content: dict[str, Any] = {}
    if obstacle.polygon is not None:
        content["polygon"] = obstacle.polygon
    if obstacle.disc is not None:
        content["disc"] = _point(obstacle.disc)
    if obstacle.wall is not None:
        content["wall"] = [_point(end) for end in obstacle.wall]
    if obstacle.blocks:
        content["blocks"] = obstacle.blocks
    return content


def _zone(zone: Zone) -> dict[str, Any]:
    content = {"name": zone.name, "kind": zone.kind, "polygon": zone.polygon}
    return content | _given(pose=zone.pose, value=_float(zone.value))


def _given(**values: Any) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def robot_type_json(kind: RobotType) -> dict[str, Any]:
    """Return a robot type as plan and trace files write it."""
    content: dict[str, Any] = {"footprint": _footprint(kind.footprint)}
    if kind.loaded_footprint is not None:
        content["loaded_footprint"] = _footprint(kind.loaded_footprint)
    content |= {
        "clearance": float(kind.clearance),
        "kinematics": kind.kinematics,
        "limits": _limits(kind.limits),
    }
    content |= _given(motion=kind.motion)
    if kind.modes:
        content["modes"] = kind.modes
    if kind.mode_switch:
        content["mode_switch"] = float(kind.mode_switch)
    content["capacity"] = kind.capacity
    if kind.capabilities:
        content["capabilities"] = sorted(kind.capabilities)
    if kind.battery is not None:
        content["battery"] = _battery(kind.battery)
    return content


def _battery(battery: Battery) -> dict[str, float]:
    content = {"capacity": float(battery.capacity), "reserve": float(battery.reserve)}
    plain = Battery(battery.capacity, battery.reserve)
    for name in ("charging", "full"):
        if getattr(battery, name) != getattr(plain, name):
            content[name] = float(getattr(battery, name))
    return content


def _limits(limits: Limits) -> dict[str, float]:
    return {
        field.name: float(value)
        for field in fields(limits)
        if (value := getattr(limits, field.name)) is not None
    }


def _footprint(footprint: Footprint) -> Any:
    if footprint.radius:
        return {"disc": float(footprint.radius)}
    return footprint.parts[0] if len(footprint.parts) == 1 else footprint.parts


def robot_json(robot: Robot, visits: tuple[Visit, ...]) -> dict[str, Any]:
    """Return a robot with its visits as plan and trace files write it."""
    content: dict[str, Any] = {"id": robot.id, "type": robot.type, "start": robot.start}
    if robot.start_speed:
        content["start_speed"] = float(robot.start_speed)
    content |= _given(start_mode=robot.start_mode)
    if robot.energy != 1.0:
        content["energy"] = float(robot.energy)
    content["visits"] = [_visit(visit) for visit in visits]
    return content


def _visit(visit: Visit) -> dict[str, Any]:
    content: dict[str, Any] = {"task": visit.task, "pose": visit.pose}
    content["service"] = float(visit.service)
    content |= _given(load=visit.load, needs=visit.needs)
    if visit.together:
        content["with"] = visit.together
    if visit.not_before:
        content["not_before"] = float(visit.not_before)
    if visit.after:
        content["after"] = visit.after
    return content | _given(due=_float(visit.due))


def _track(track: Track, name: str) -> dict[str, Any]:
    content: dict[str, Any] = {}
    for key in ("t", "x", "y", "theta"):
        array = getattr(track, key)
        wrong = np.flatnonzero(~np.isfinite(array))
        if len(wrong):
            raise FormatError(
                "not a finite number",
                key=f"trajectories.{name}.{key}[{wrong[0]}]",
                value=float(array[wrong[0]]),
                mend="plans hold finite numbers only",
            )
        content[key] = array.tolist()
    content["mode"] = track.mode
    return content


def _path(path: Trajectory) -> dict[str, Any]:
    pieces = [
        [
            piece.id,
            piece.mode,
            *_point(piece.start),
            *_point(piece.twist),
            piece.loaded,
            first,
            last,
        ]
        for piece, (first, last) in zip(path.pieces, path.timing, strict=True)
    ]
    stops = [[stop.visit, stop.arrive, stop.leave] for stop in path.stops]
    return {"start": _point(path.start), "pieces": pieces, "stops": stops}
