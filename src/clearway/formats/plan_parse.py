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
    types = {name: _robot_type(name, node) for name, node in root["robot_types"].items()}
    robots = tuple(_robot(node, types) for node in root["robots"].elements())
    ids = [robot.id for robot in robots]
    for node, name in zip(root["robots"].elements(), ids, strict=True):
        if ids.count(name) > 1:
            node["id"].fail("two robots have this id", "give each its own")
    tours = {
        robot.id: visits_of(node["visits"], set(ids))
        for robot, node in zip(robots, root["robots"].elements(), strict=True)
    }
    tracks = {name: _track(node, name, ids) for name, node in root["trajectories"].items()}
    until = root["conflict_free_until"]
    if until.given and until.number() < 0.0:
        until.fail("must be 0 or above", "null means for ever")
    return PlanRecord(
        scenario=_text_or(root["scenario"], ""),
        system=_text_or(root["system"], ""),
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
        discrete_bound=_free(root["discrete_bound"]) if root["discrete_bound"].given else None,
        conflict_free_until=until.number_or_none(),
        paths=paths_of(root["pieces"], tracks) if root["pieces"].given else {},
        parameters=_free(root["parameters"]) if root["parameters"].given else {},
        timings=_free(root["timings"]) if root["timings"].given else {},
        version=_text_or(root["clearway"], ""),
    )


def _text_or(node: Node, default: str) -> str:
    return node.text() if node.given else default


def _free(node: Node) -> dict[str, object]:
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
    reserve = node["reserve"]
    if not reserve.given:
        return Battery(node["capacity"].number())
    return Battery(node["capacity"].number(), reserve.number())


def _robot(node: Node, types: dict[str, RobotType]) -> Robot:
    kind, speed, mode = node["type"], node["start_speed"], node["start_mode"]
    if kind.text() not in types:
        kind.fail("unknown robot type", f"known: {', '.join(types) or 'none'}")
    return Robot(
        id=node["id"].text(),
        type=kind.text(),
        start=pose_of(node["start"]),
        start_speed=speed.number() if speed.given else 0.0,
        start_mode=mode.text() if mode.given else None,
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
