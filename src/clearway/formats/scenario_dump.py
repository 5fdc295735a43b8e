"""Writing scenarios as TOML text, one robot, task, corner, obstacle or zone a line."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from clearway.formats.scenario_error import key_path
from clearway.model import (
    Disturbances,
    Footprint,
    Obstacle,
    Order,
    OrderStream,
    Robot,
    RobotType,
    Scenario,
    Simulation,
    Site,
    Visit,
    Zone,
)

FORMAT = "clearway.scenario/1"


def dump_scenario(scenario: Scenario, comment: str = "") -> str:
    """Return the scenario as TOML text that reads back as an equal scenario.

    Stations are written as the poses they stood for, fleets as their robots, and orders from
    files as tasks. ``comment`` goes on top.

    Raises
    ------
    ValueError
        If a setting is not a string, number or boolean, or is called ``name``; if a site is
        not what its layout makes.
    """
    lines = [f"# {line}".rstrip() for line in comment.splitlines()]
    lines += _keys({"format": FORMAT, "name": scenario.name, "seed": scenario.seed})
    lines += _rows("robots", map(_robot, scenario.robots))
    lines += _rows("tasks", map(_order, scenario.orders))
    lines += ["", "[site]", *_site(scenario.site)]
    for name, kind in scenario.robot_types.items():
        lines += ["", f"[{key_path(('robot_types', name))}]", *_keys(_robot_type(kind))]
    lines += ["", "[system]", *_keys({"name": scenario.system} | _settings(scenario.settings))]
    lines += _simulation(scenario.simulation)
    return "\n".join(lines) + "\n"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, int):
        return str(int(value))
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, Mapping):
        inner = ", ".join(f"{key_path((k,))} = {_value(v)}" for k, v in value.items())
        return f"{{{inner}}}"
    return "[" + ", ".join(_value(item) for item in value) + "]"


def _keys(table: Mapping[str, Any]) -> list[str]:
    return [f"{key_path((key,))} = {_value(value)}" for key, value in table.items()]


def _rows(key: str, rows: Iterable[Any]) -> list[str]:
    listed = [f"  {_value(row)}," for row in rows]
    return [f"{key} = [", *listed, "]"] if listed else []


def _given(**keys: Any) -> dict[str, Any]:
    """Keep what is neither absent nor empty nor 0, the values that leaving out means."""
    return {k: v for k, v in keys.items() if v is not None and v != () and v != 0.0}


def _settings(settings: Mapping[str, Any]) -> dict[str, Any]:
    for key, value in settings.items():
        if key == "name" or not isinstance(value, str | int | float | bool):
            raise ValueError(f"system.{key} = {value!r} cannot be written; use one plain value")
    return dict(settings)


def _robot(robot: Robot) -> dict[str, Any]:
    moving = _given(start_speed=robot.start_speed, start_mode=robot.start_mode)
    energy = {} if robot.energy == 1.0 else {"energy": robot.energy}
    return {"id": robot.id, "type": robot.type, "start": robot.start, **moving, **energy}


def _order(order: Order) -> dict[str, Any]:
    visits = [_visit(visit) for visit in order.task.visits]
    fetches = {} if order.task.fetches is None else {"fetches": order.task.fetches}
    several = {"visits": visits} if visits else {}
    return {
        "id": order.task.id,
        **fetches,
        **(visits[0] if len(visits) == 1 else several),
        **_given(robot=order.task.robot, release=order.release),
        **({} if order.due is None else {"due": order.due}),
        **_given(priority=order.priority, after=order.after),
    }


def _visit(visit: Visit) -> dict[str, Any]:
    rest = _given(
        service=visit.service, load=visit.load, needs=visit.needs, together=visit.together
    )
    return {"pose": visit.pose, **rest}


def _site(site: Site) -> list[str]:
    if site.layout is not None:
        from clearway.world.channels import site_of

        if site != site_of(site.layout):
            mend = "drop the layout, or what was changed since"
            raise ValueError(f"the site is not what its layout makes; {mend}")
        return _keys({"layout": vars(site.layout)})
    lines = [*_rows("bounds", site.bounds), *_keys({"border": site.border})]
    lines += _rows("obstacles", map(_obstacle, site.obstacles))
    return lines + _rows("zones", map(_zone, site.zones))


def _obstacle(obstacle: Obstacle) -> dict[str, Any]:
    return _given(
        polygon=obstacle.polygon, disc=obstacle.disc, wall=obstacle.wall, blocks=obstacle.blocks
    )


def _zone(zone: Zone) -> dict[str, Any]:
    table: dict[str, Any] = {"name": zone.name, "kind": zone.kind, "polygon": zone.polygon}
    if zone.pose is not None:
        table["pose"] = zone.pose
    return table if zone.value is None else {**table, "value": zone.value}


def _footprint(footprint: Footprint | None) -> Any:
    if footprint is None:
        return None
    if footprint.radius:
        return {"disc": footprint.radius}
    return footprint.parts[0] if len(footprint.parts) == 1 else footprint.parts


def _robot_type(kind: RobotType) -> dict[str, Any]:
    limits = {k: v for k, v in vars(kind.limits).items() if v is not None}
    battery = kind.battery
    return {
        "kinematics": kind.kinematics,
        "footprint": _footprint(kind.footprint),
        **_given(
            loaded_footprint=_footprint(kind.loaded_footprint),
            clearance=kind.clearance,
            motion=kind.motion,
            modes=kind.modes,
            mode_switch=kind.mode_switch,
        ),
        "limits": limits,
        "capacity": kind.capacity,
        **_given(capabilities=tuple(sorted(kind.capabilities))),
        **({} if battery is None else {"battery": vars(battery)}),
    }


def _simulation(simulation: Simulation) -> list[str]:
    """Return the lines of what happens; none where nothing does."""
    disturbances = simulation.disturbances
    lines = _keys(_given(until=simulation.until))
    lines += _rows("streams", map(_stream, simulation.streams))
    if disturbances != Disturbances():
        lines += _keys({"disturbances": vars(disturbances)})
    surprises = ({"at": s.at, **_obstacle(s.obstacle)} for s in simulation.surprises)
    lines += _rows("surprises", surprises)
    return ["", "[simulation]", *lines] if lines else []


def _stream(stream: OrderStream) -> dict[str, Any]:
    draws = tuple({"kind": d.kind, **_given(service=d.service, load=d.load)} for d in stream.draws)
    due = {} if stream.due_after is None else {"due_after": stream.due_after}
    return {
        "name": stream.name,
        **_given(rate=stream.rate, open=stream.open, visits=draws, first=stream.first),
        **({"fetch": True} if stream.fetch else {}),
        **_given(last=stream.last, priority=stream.priority),
        **due,
    }
