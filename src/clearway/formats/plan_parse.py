"""A plan record from the text of a plan file, refused by name where it is malformed."""

import numpy as np

from clearway.formats.json_node import Node, parse_json
from clearway.formats.plan_dump import PLAN_FORMAT
from clearway.formats.plan_parts import built, footprint_of, limits_of, pose_of, site_of, visits_of
from clearway.formats.plan_paths import paths_of
from clearway.model import Battery, PlanRecord, Robot, RobotType, Status, Track, Visit
from clearway.model.robot import KINEMATICS


def parse_plan(text: str, file: str = "plan.json") -> PlanRecord:
    """Return the record of a plan file's text; ``file`` is named in errors.

    ``assignment`` is taken from the visits where it is absent; unknown keys are passed over.

    Raises
    ------
    FormatError
        If anything is missing, of the wrong type or at odds with itself.
    """
    root = parse_json(text, file)
    form = root["format"]
    if form.value != PLAN_FORMAT:
        form.fail("not a plan file", f'plan files say "format": "{PLAN_FORMAT}"')
    site = site_of(root["site"])
    types = robot_types_of(root["robot_types"])
    robots = robots_of(root["robots"], types)
    ids = [robot.id for robot in robots]
    tours = {
        robot.id: visits_of(node["visits"], set(ids))
        for robot, node in zip(robots, root["robots"].elements(), strict=True)
    }
    tracks = {name: _track(node, name, ids) for name, node in root["trajectories"].items()}
    until = root["conflict_free_until"]
    if until.given and until.number() < 0.0:
        until.fail("must be 0 or above", "null means for ever")
    return PlanRecord(
        scenario=text_or(root["scenario"], ""),
        system=text_or(root["system"], ""),
        seed=root["seed"].integer() if root["seed"].given else 0,
        status=_status(root["status"]),
        site=site,
        robot_types=types,
        robots=robots,
        tours=tours,
        tracks=tracks,
        assignment=_assignment(root["assignment"], tours),
        sum_of_costs=root["sum_of_costs"].number(),
        makespan=root["makespan"].number(),
        reason=root["reason"].text() if root["reason"].given else None,
        lower_bound=root["lower_bound"].number_or_none(),
        cost=root["cost"].number_or_none(),
        cost_name=root["cost_name"].text() if root["cost_name"].given else None,
        cost_lower_bound=root["cost_lower_bound"].number_or_none(),
        discrete_bound=free_of(root["discrete_bound"]) if root["discrete_bound"].given else None,
        conflict_free_until=until.number_or_none(),
        paths=paths_of(root["pieces"], tracks) if root["pieces"].given else {},
        parameters=free_of(root["parameters"]) if root["parameters"].given else {},
        timings=free_of(root["timings"]) if root["timings"].given else {},
        version=text_or(root["clearway"], ""),
    )


def robot_types_of(node: Node) -> dict[str, RobotType]:
    """Return the robot types by name."""
    return {name: _robot_type(name, inner) for name, inner in node.items()}


def robots_of(node: Node, types: dict[str, RobotType]) -> tuple[Robot, ...]:
    """Return the robots, each of one of ``types`` and with an id of its own."""
    robots = tuple(_robot(inner, types) for inner in node.elements())
    ids = [robot.id for robot in robots]
    for inner, name in zip(node.elements(), ids, strict=True):
        if ids.count(name) > 1:
            inner["id"].fail("two robots have this id", "give each its own")
    return robots


def text_or(node: Node, default: str) -> str:
    """Return a string, or ``default`` where there is none."""
    return node.text() if node.given else default


def free_of(node: Node) -> dict[str, object]:
    """Return an object of any JSON values."""
    return {name: inner.free() for name, inner in node.items()}


def _status(node: Node) -> Status:
    known = [status.value for status in Status]
    if node.text() not in known:
        node.fail("unknown status", f"one of {', '.join(known)}")
    return Status(node.text())


def _robot_type(name: str, node: Node) -> RobotType:
    kinematics = node["kinematics"]
    if kinematics.text() not in KINEMATICS:
        kinematics.fail("unknown kinematics", f"one of {', '.join(KINEMATICS)}")
    loaded, battery, modes = node["loaded_footprint"], node["battery"], node["modes"]
    skills, none = node["capabilities"], frozenset[str]()
    clearance, switch, capacity = node["clearance"], node["mode_switch"], node["capacity"]
    motion = node["motion"]
    return built(
        node,
        lambda: RobotType(
            name=name,
            footprint=footprint_of(node["footprint"]),
            kinematics=next(k for k in KINEMATICS if k == kinematics.value),
            limits=limits_of(node["limits"]),
            loaded_footprint=footprint_of(loaded) if loaded.given else None,
            clearance=clearance.number() if clearance.given else 0.0,
            modes=tuple(m.text() for m in modes.elements()) if modes.given else (),
            mode_switch=switch.number() if switch.given else 0.0,
            capacity=capacity.integer() if capacity.given else 1,
            capabilities=frozenset(c.text() for c in skills.elements()) if skills.given else none,
            battery=built(battery, lambda: _battery(battery)) if battery.given else None,
            motion=motion.text() if motion.given else None,
        ),
    )


def _battery(node: Node) -> Battery:
    names = ("reserve", "charging", "full")
    given = {name: node[name].number() for name in names if node[name].given}
    return Battery(node["capacity"].number(), **given)


def _robot(node: Node, types: dict[str, RobotType]) -> Robot:
    kind, speed, mode = node["type"], node["start_speed"], node["start_mode"]
    energy = node["energy"]
    if kind.text() not in types:
        kind.fail("unknown robot type", f"known: {', '.join(types) or 'none'}")
    return built(
        node,
        lambda: Robot(
            id=node["id"].text(),
            type=kind.text(),
            start=pose_of(node["start"]),
            start_speed=speed.number() if speed.given else 0.0,
            start_mode=mode.text() if mode.given else None,
            energy=energy.number() if energy.given else 1.0,
        ),
    )


def _track(node: Node, name: str, ids: list[str]) -> Track:
    if name not in ids:
        node.fail_key("a trajectory of an unknown robot", f"known: {', '.join(ids) or 'none'}")
    t, x, y, theta = (node[key].array() for key in ("t", "x", "y", "theta"))
    modes = node["mode"]
    mode = modes.texts_or_none() if modes.given else (None,) * len(t)
    for key, array in (("x", x), ("y", y), ("theta", theta), ("mode", mode)):
        if len(array) != len(t):
            node[key].fail_key(
                f"{len(array)} samples where t has {len(t)}", "give all arrays one length"
            )
    if len(t) == 0:
        node["t"].fail("no samples", "give at least one, or leave the trajectory out")
    if t[0] != 0.0:
        node["t"].elements()[0].fail("a trajectory starts at t = 0", "write 0.0")
    falls = np.flatnonzero(np.diff(t) < 0.0)
    if len(falls):
        node["t"].elements()[int(falls[0]) + 1].fail(
            f"time falls from {t[falls[0]]!r}", "sort the samples by time"
        )
    return Track(t, x, y, theta, mode)


def _assignment(node: Node, tours: dict[str, tuple[Visit, ...]]) -> dict[str, tuple[str, ...]]:
    if not node.given:
        return {
            name: tuple(dict.fromkeys(v.task for v in visits if v.task is not None))
            for name, visits in tours.items()
        }
    for name, inner in node.items():
        if name not in tours:
            inner.fail_key("work for an unknown robot", f"known: {', '.join(tours) or 'none'}")
    return {name: tuple(t.text() for t in inner.elements()) for name, inner in node.items()}
