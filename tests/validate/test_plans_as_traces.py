"""Motion is judged in traces as in plans: wrong plans told as traces are wrong in the same way."""

from itertools import pairwise
from pathlib import Path

import pytest

from clearway.formats.plan_file import read_plan
from clearway.model import PlanRecord, Trace
from clearway.validate import validate_trace

DATA = Path(__file__).parents[1] / "data"
MOTION = (
    "start",
    "step",
    "turn",
    "jump",
    "speed",
    "reverse_speed",
    "yaw_rate",
    "turning_radius",
    "acceleration",
    "deceleration",
    "slip",
    "mode",
    "obstacle",
    "bounds",
    "zone",
    "conflict",
)
# Loads are told by visits in plans, by events in traces; a trace is judged to its end.
OTHERWISE = {"obstacle--loaded", "conflict-after-the-window"}
WRONG = sorted(
    path
    for path in (DATA / "bad_plans").glob("*.json")
    if path.stem.split("--")[0] in MOTION and path.stem not in OTHERWISE
)
RIGHT = sorted(path for path in (DATA / "right_plans").glob("*.json") if path.stem not in OTHERWISE)


def as_trace(plan: PlanRecord, pieces: int) -> Trace:
    """Tell a plan's motion in pieces, cut anywhere."""
    events = []
    for robot, track in plan.tracks.items():
        cuts = [k * (len(track.t) - 1) // pieces for k in range(pieces + 1)]
        for first, last in pairwise(cuts):
            part = slice(first, last + 1)
            arrays = {name: getattr(track, name)[part] for name in ("t", "x", "y", "theta")}
            events.append({"event": "motion", "robot": robot, **arrays, "mode": track.mode[part]})
    return Trace(
        scenario=plan.scenario,
        system=plan.system,
        seed=plan.seed,
        site=plan.site,
        robot_types=plan.robot_types,
        robots=plan.robots,
        events=tuple(events),
        is_whole=False,
        parameters={},
    )


@pytest.mark.parametrize("pieces", [1, 3])
@pytest.mark.parametrize("path", WRONG, ids=lambda path: path.stem)
def test_wrong_motion_is_wrong_in_a_trace(path: Path, pieces: int) -> None:
    """However it is cut into pieces, one violation of the kind in the file's name is found."""
    trace = as_trace(read_plan(path), pieces)
    assert [violation.kind for violation in validate_trace(trace)] == [path.stem.split("--")[0]]


@pytest.mark.parametrize("pieces", [1, 3])
@pytest.mark.parametrize("path", RIGHT, ids=lambda path: path.stem)
def test_right_motion_is_right_in_a_trace(path: Path, pieces: int) -> None:
    """Contact, jumps of heading where allowed, and ramps are no violations."""
    assert validate_trace(as_trace(read_plan(path), pieces)) == []
