"""The exact pieces behind a plan file's samples."""

import math
from collections.abc import Mapping

from clearway.formats.json_node import Node
from clearway.formats.plan_parts import built, pose_of
from clearway.model import TICKS_PER_SECOND, Piece, Pose, Stop, Track, Trajectory

AGREEMENT = 1e-6


def paths_of(node: Node, tracks: Mapping[str, Track]) -> dict[str, Trajectory]:
    """Return the trajectories; refuse those that disagree with their samples."""
    return {name: _path(name, inner, tracks) for name, inner in node.items()}


def _path(name: str, node: Node, tracks: Mapping[str, Track]) -> Trajectory:
    if name not in tracks:
        node.fail_key("pieces of a robot that has no trajectory", "remove them, or add its samples")
    rows = [row.elements(11) for row in node["pieces"].elements()]
    pieces = tuple(_piece(row) for row in rows)
    timing = tuple((row[9].integer(), row[10].integer()) for row in rows)
    stops = tuple(_stop(row) for row in node["stops"].elements()) if node["stops"].given else ()
    start = pose_of(node["start"])
    path = built(node["pieces"], lambda: Trajectory(name, start, pieces, timing, stops))
    _compare(node, path, tracks[name])
    return path


def _piece(row: list[Node]) -> Piece:
    ident, mode, x, y, theta, a, b, c, loaded, _, _ = row
    if not isinstance(loaded.value, bool):
        loaded.fail("true or false is expected", "say whether the robot is loaded")
    return Piece(
        id=ident.integer(),
        mode=mode.text() if mode.given else None,
        start=Pose(x.figure(), y.figure(), theta.figure()),
        twist=(a.figure(), b.figure(), c.figure()),
        loaded=loaded.value,
    )


def _stop(node: Node) -> Stop:
    visit, arrive, leave = (n.integer() for n in node.elements(3))
    return built(node, lambda: Stop(visit, arrive, leave))


def _compare(node: Node, path: Trajectory, track: Track) -> None:
    mend = "the file was edited by hand: remove pieces, or write the plan again"
    for what, pose, k in (("begin", path.start, 0), ("end", path.final_pose, -1)):
        x, y, theta = float(track.x[k]), float(track.y[k]), float(track.theta[k])
        turn = math.remainder(theta - pose.theta, 2.0 * math.pi)
        if max(abs(x - pose.x), abs(y - pose.y), abs(turn)) > AGREEMENT:
            Node(list(pose), node.key, node.file).fail(
                f"pieces {what} elsewhere than the samples, at {[x, y, theta]}", mend
            )
    end = path.end / TICKS_PER_SECOND
    if abs(float(track.t[-1]) - end) > AGREEMENT:
        Node(end, node.key, node.file).fail(
            f"pieces end at another time than the samples, {float(track.t[-1])!r}", mend
        )
