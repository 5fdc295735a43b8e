"""Instances of car-like fleets in the CL-CBS format, read strictly into scenarios.

Wen, Liu, Li, "CL-MAPF: Multi-agent path finding for car-like robots with kinematic and
spatiotemporal constraints", Robotics and Autonomous Systems 150 (2022). Positions are those of
the rear axle, angles are clockwise, obstacles are discs, the car is always the same.
"""

from pathlib import Path
from typing import Any

import yaml

from clearway.formats.atomic import FormatError
from clearway.formats.json_node import Node
from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Order,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
    wrap,
)
from clearway.model.site import Border

DISC_RADIUS = 0.8
MOST_BYTES, MOST_DISCS, MOST_ROBOTS = 4_000_000, 20_000, 5_000
LARGEST_SIDE = 5_000.0
CAR = RobotType(
    name="car",
    footprint=Footprint.rectangle(3.0, 2.0, rear=1.0),
    kinematics="ackermann",
    limits=Limits(speed=1.0, turning_radius=3.0),
)


def read_instance(path: Path, border: Border = "closed") -> Scenario:
    """Return a CL-CBS instance as a scenario with one task per robot, kept for that robot.

    Parameters
    ----------
    border
        ``closed``: bodies stay inside the map; ``open`` drops that.

    Raises
    ------
    FormatError
        If the file is not such an instance; names file, place, value and mend.
    """
    return _scenario(Node(_content(path), "", str(path)), path.stem, border)


def _content(path: Path) -> Any:
    file = str(path)
    size = path.stat().st_size
    if size > MOST_BYTES:
        raise FormatError(
            f"the file has {size:,} bytes, more than {MOST_BYTES:,}",
            file=file,
            mend=f"give at most {MOST_DISCS:,} obstacles and {MOST_ROBOTS:,} agents",
        )
    try:
        return yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)
    except UnicodeDecodeError as error:
        raise FormatError(
            f"byte {error.start} is not UTF-8 text", file=file, mend="give a YAML text file"
        ) from None
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}" if mark else None
        problem = str(getattr(error, "problem", None) or error).splitlines()[0]
        raise FormatError(
            f"not YAML: {problem}", file=file, key=place, mend="repair or fetch it anew"
        ) from None


def _scenario(top: Node, name: str, border: Border) -> Scenario:
    area, agents = top["map"], top["agents"].elements()
    width, height = (
        _between(node, 0.0, LARGEST_SIDE, "a side of the map")
        for node in area["dimensions"].elements(2)
    )
    discs = area["obstacles"].elements()
    if len(discs) > MOST_DISCS:
        area["obstacles"].fail_key(
            f"{len(discs):,} obstacles, more than {MOST_DISCS:,}", "split the map"
        )
    if not agents:
        top["agents"].fail("there are no agents", "give at least one")
    if len(agents) > MOST_ROBOTS:
        top["agents"].fail_key(f"{len(agents):,} agents, more than {MOST_ROBOTS:,}", "give fewer")
    robots, orders = [], []
    seen: set[str] = set()
    for agent in agents:
        id_ = agent["name"].text()
        if id_ in seen or not id_:
            agent["name"].fail("an agent needs a name of its own", "name each agent differently")
        seen.add(id_)
        start, goal = _pose(agent["start"]), _pose(agent["goal"])
        robots.append(Robot(id_, CAR.name, start))
        orders.append(Order(Task(f"{id_}-goal", (Visit(f"{id_}-goal", goal),), robot=id_)))
    return Scenario(
        name=name,
        site=Site(
            bounds=((0.0, 0.0), (width, 0.0), (width, height), (0.0, height)),
            obstacles=tuple(Obstacle(disc=(*_point(disc), DISC_RADIUS)) for disc in discs),
            border=border,
        ),
        robot_types={CAR.name: CAR},
        robots=tuple(robots),
        orders=tuple(orders),
        settings={"park": "never"},
    )


def _between(node: Node, low: float, high: float, what: str) -> float:
    value = node.number()
    if not low < value <= high:
        node.fail(f"{what} must be above {low:g} and at most {high:g} m", "give metres")
    return value


def _point(node: Node) -> tuple[float, float]:
    x, y = (part.number() for part in node.elements(2))
    return x, y


def _pose(node: Node) -> Pose:
    x, y, yaw = (part.number() for part in node.elements(3))
    return Pose(x, y, wrap(-yaw))
