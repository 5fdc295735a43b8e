"""Plan files: what is written is read again, and what is malformed is named."""

import json
import math
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from clearway.formats import plan_file
from clearway.formats.atomic import FormatError, write_bytes, write_text
from clearway.formats.plan_file import dump_plan, parse_plan, read_plan, write_plan
from clearway.formats.sampling import sample
from clearway.model import (
    Battery,
    Footprint,
    Limits,
    Obstacle,
    Piece,
    PlanRecord,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Stop,
    Trajectory,
    Visit,
    Zone,
)


def full_record() -> PlanRecord:
    """A plan in which every field holds something."""
    square = ((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0))
    site = Site(
        square,
        (
            Obstacle(polygon=((1.0, 1.0), (2.0, 1.0), (1.0, 2.0)), blocks=("lift:loaded",)),
            Obstacle(disc=(7.0, 7.0, 0.5)),
            Obstacle(wall=((0.0, 5.0), (1.0, 5.0))),
        ),
        (
            Zone("dock", "station", square, Pose(1.0, 1.0, 0.0)),
            Zone("slow", "speed", square, value=0.5),
        ),
        "open",
    )
    two = Footprint(
        parts=(
            ((0.5, 0.3), (0.0, 0.3), (0.0, -0.3), (0.5, -0.3)),
            ((0.0, 0.1), (-0.5, 0.1), (-0.5, -0.1)),
        )
    )
    lift = RobotType(
        "lift",
        two,
        "four_wheel",
        Limits(1.5, 0.5, 0.57, 3.0, 1.0, 2.0),
        Footprint.rectangle(1.0, 1.0),
        0.05,
        ("stop", "forward"),
        0.5,
        2,
        frozenset({"lift", "fork"}),
        Battery(3600.0, 0.3, 600.0, 0.9),
        "four_wheel",
    )
    puck = RobotType("puck", Footprint(radius=0.25), "holonomic", Limits(1.0))
    start = Pose(3.0, 3.0, 0.1)
    piece = Piece(7, "forward", start, (1.0, 0.0, 0.0), True)
    path = Trajectory("r1", start, (piece,), ((500, 1700),), (Stop(0, 1700, 3700),))
    return PlanRecord(
        scenario="Lager Süd",
        system="hierarchical",
        seed=3,
        status=Status.STOPPED,
        site=site,
        robot_types={"lift": lift, "puck": puck},
        robots=(Robot("r1", "lift", start, 0.25, "forward", 0.4), Robot("r2", "puck", start)),
        tours={
            "r1": (Visit("t1", path.final_pose, 2.0, "pick", "lift", ("r2",), 1.5, ("t0",), 3.0),),
            "r2": (Visit(None, start),),
        },
        tracks={"r1": sample(path, modes=True)},
        assignment={"r1": ("t1",), "r2": ()},
        sum_of_costs=1.7,
        makespan=1.7,
        reason="the budget ended",
        lower_bound=1.0 / 3.0,
        cost=1e-17,
        cost_name="paper",
        cost_lower_bound=0.5,
        discrete_bound={"graph": "lattice", "value": 1.5, "factor": 1.0},
        conflict_free_until=12.5,
        paths={"r1": path},
        parameters={"weight": 1.5, "list": [1, "a", None, True]},
        timings={"plan": 0.25},
        version="0.1.0",
    )


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    """Reading gives the record back, writing what was read the same bytes."""
    record = full_record()
    write_plan(record, tmp_path / "plan.json")
    again = read_plan(tmp_path / "plan.json")
    assert again == record
    assert dump_plan(again).encode() == (tmp_path / "plan.json").read_bytes()
    assert os.listdir(tmp_path) == ["plan.json"]


def test_whole_numbers_are_written_as_floats() -> None:
    """A record built with 1 instead of 1.0 gives the same bytes, before and after reading."""
    record = full_record()
    puck = replace(record.robot_types["puck"], limits=Limits(speed=1), clearance=0)
    wall = Obstacle(wall=((0, 5), (1, 5)))
    site = replace(record.site, obstacles=(*record.site.obstacles[:2], wall))
    types = {**record.robot_types, "puck": puck}
    whole = replace(record, makespan=2, robot_types=types, site=site)
    text = dump_plan(whole)
    assert text == dump_plan(replace(record, makespan=2.0))
    assert dump_plan(parse_plan(text)) == text


def test_the_file_is_json_with_the_promised_keys() -> None:
    """Names and shapes are those that outsiders rely on."""
    content = json.loads(dump_plan(full_record()))
    assert content["format"] == "clearway.plan/1"
    assert content["status"] == "stopped"
    assert content["robots"][0]["visits"][0] == {
        "task": "t1",
        "pose": [3.0 + math.cos(0.1), 3.0 + math.sin(0.1), 0.1],
        "service": 2.0,
        "load": "pick",
        "needs": "lift",
        "with": ["r2"],
        "not_before": 1.5,
        "after": ["t0"],
        "due": 3.0,
    }
    assert set(content["robots"][1]["visits"][0]) == {"task", "pose", "service"}
    assert content["pieces"]["r1"]["pieces"] == [
        [7, "forward", 3.0, 3.0, 0.1, 1.0, 0.0, 0.0, True, 500, 1700]
    ]
    assert content["pieces"]["r1"]["stops"] == [[0, 1700, 3700]]
    assert content["trajectories"]["r1"]["mode"][:2] == ["stop", "forward"]
    assert content["robot_types"]["puck"]["footprint"] == {"disc": 0.25}
    assert content["site"]["obstacles"][0]["blocks"] == ["lift:loaded"]


def test_a_foreign_plan_may_leave_out_what_is_optional() -> None:
    """Shapes, robots, samples and figures are enough; the assignment follows the visits."""
    content = json.loads(dump_plan(full_record()))
    for key in (
        "pieces",
        "parameters",
        "timings",
        "assignment",
        "clearway",
        "scenario",
        "system",
        "seed",
        "reason",
        "lower_bound",
        "cost",
        "cost_name",
        "cost_lower_bound",
        "discrete_bound",
        "conflict_free_until",
    ):
        del content[key]
    del content["site"]["zones"], content["site"]["border"], content["site"]["obstacles"]
    del content["trajectories"]["r1"]["mode"]
    content["added"] = {"freely": [1, 2]}
    content["robot_types"]["puck"]["limits"]["speed"] = None
    record = parse_plan(json.dumps(content), "plan.json")
    assert record.assignment == {"r1": ("t1",), "r2": ()}
    assert set(record.tracks["r1"].mode) == {None}
    assert record.site.border == "closed"
    assert record.conflict_free_until is None
    assert record.robot_types["puck"].limits.speed > 1e3


NAN, MISSING = math.nan, object()


@pytest.mark.parametrize(
    ("path", "value", "key"),
    [
        ("format", "clearway.plan/2", "format"),
        ("format", MISSING, "format"),
        ("status", "done", "status"),
        ("seed", 1.5, "seed"),
        ("seed", True, "seed"),
        ("scenario", 3, "scenario"),
        ("sum_of_costs", MISSING, "sum_of_costs"),
        ("makespan", NAN, "makespan"),
        ("makespan", 10**400, "makespan"),
        ("lower_bound", "1", "lower_bound"),
        ("conflict_free_until", -1.0, "conflict_free_until"),
        ("site", MISSING, "site"),
        ("site.bounds", [[0, 0], [1, 0]], "site.bounds"),
        ("site.bounds.1", [1.0], "site.bounds[1]"),
        ("site.bounds", [[0, 0], [4, 4], [4, 0], [0, 4], [-1, 2]], "site.bounds"),
        ("site.border", "ajar", "site.border"),
        ("site.obstacles.0", {}, "site.obstacles[0]"),
        ("site.obstacles.1.disc", [1, 2, -1], "site.obstacles[1]"),
        ("site.obstacles.2.wall", [[1, 2]], "site.obstacles[2].wall"),
        ("site.obstacles.0.blocks", [], "site.obstacles[0].blocks"),
        ("site.zones.0.kind", MISSING, "site.zones[0].kind"),
        ("robot_types.puck.kinematics", "hover", "robot_types.puck.kinematics"),
        ("robot_types.puck.modes", ["forward"], "robot_types.puck"),
        ("robot_types.puck.footprint.disc", 0, "robot_types.puck.footprint"),
        (
            "robot_types.lift.loaded_footprint",
            [[0, 0], [1, 0], [0.1, 0.1], [0, 1]],
            "robot_types.lift.loaded_footprint",
        ),
        ("robot_types.lift.limits.speed", 0, "robot_types.lift.limits"),
        ("robot_types.lift.limits.yaw_rate", [1], "robot_types.lift.limits.yaw_rate"),
        ("robot_types.lift.limits", MISSING, "robot_types.lift.limits"),
        ("robots", {}, "robots"),
        ("robots.1.id", "r1", "robots[0].id"),
        ("robots.0.type", "tank", "robots[0].type"),
        ("robots.0.start", [1, 2], "robots[0].start"),
        ("robots.0.visits.0.pose.2", NAN, "robots[0].visits[0].pose[2]"),
        ("robots.0.visits.0.service", -1, "robots[0].visits[0].service"),
        ("robots.0.visits.0.not_before", -1, "robots[0].visits[0].not_before"),
        ("robots.0.visits.0.due", "soon", "robots[0].visits[0].due"),
        ("robots.0.visits.0.after", "t0", "robots[0].visits[0].after"),
        ("robots.0.visits.0.load", "carry", "robots[0].visits[0].load"),
        ("robots.0.visits.0.with", ["r9"], "robots[0].visits[0].with[0]"),
        ("assignment.r9", ["t1"], "assignment.r9"),
        ("trajectories", MISSING, "trajectories"),
        ("trajectories.r9", {}, "trajectories.r9"),
        ("trajectories.r1.x", MISSING, "trajectories.r1.x"),
        ("trajectories.r1.x.3", NAN, "trajectories.r1.x[3]"),
        ("trajectories.r1.x.3", 1e300, "trajectories.r1.x[3]"),
        ("robots.0.start.0", 1e12, "robots[0].start[0]"),
        ("trajectories.r1.x.3", "3", "trajectories.r1.x[3]"),
        ("trajectories.r1.y.2", True, "trajectories.r1.y[2]"),
        ("trajectories.r1.theta", [0.0], "trajectories.r1.theta"),
        ("trajectories.r1.mode.1", 1, "trajectories.r1.mode[1]"),
        ("trajectories.r1.t.0", 0.1, "trajectories.r1.t[0]"),
        ("trajectories.r1.t.4", 0.0, "trajectories.r1.t[4]"),
        ("parameters.weight", NAN, "parameters.weight"),
        ("parameters", [], "parameters"),
        ("pieces.r2", {}, "pieces.r2"),
        ("pieces.r1.pieces.0.5", 1.001, "pieces.r1"),
        ("pieces.r1.pieces.0.10", 1800, "pieces.r1"),
        ("pieces.r1.pieces.0.10", 1700.5, "pieces.r1.pieces[0][10]"),
        ("pieces.r1.pieces.0.9", 1701, "pieces.r1.pieces"),
        ("pieces.r1.start.0", 3.001, "pieces.r1"),
        ("pieces.r1.stops.0.2", 0, "pieces.r1.stops[0]"),
    ],
)
def test_a_malformed_place_is_named(path: str, value: object, key: str) -> None:
    """The error names file and key, and says what to do."""
    content = json.loads(dump_plan(full_record()))
    place = content
    *steps, last = [int(s) if s.isdigit() else s for s in path.split(".")]
    for step in steps:
        place = place[step]
    if value is MISSING:
        del place[last]
    else:
        place[last] = value
    with pytest.raises(FormatError) as caught:
        parse_plan(json.dumps(content), "run/plan.json")
    error = caught.value
    assert (error.file, error.key) == ("run/plan.json", key)
    assert error.mend
    assert str(error).startswith(f"run/plan.json: {key}: ")
    assert "\n" not in str(error)


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", "not json", "[" * 100_000, '{"a": 1, "a": 2}', "1" * 5000],
)
def test_texts_that_are_no_plan_are_refused(text: str) -> None:
    """Whatever is no plan ends in one kind of error, which names the file."""
    with pytest.raises(FormatError, match=r"^plan\.json: "):
        parse_plan(text, "plan.json")


def test_a_cut_file_is_refused_wherever_it_is_cut() -> None:
    """No beginning of a plan file is a plan file."""
    text = dump_plan(full_record())
    for end in range(0, len(text.rstrip()), 37):
        with pytest.raises(FormatError, match="ends too early"):
            parse_plan(text[:end], "plan.json")


def test_files_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Missing files, folders, bytes that are no text and giants are refused by name."""
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
    for name in ("none.json", "", "bytes.json"):
        with pytest.raises(FormatError) as caught:
            read_plan(tmp_path / name)
        assert caught.value.file == str(tmp_path / name)
    write_plan(full_record(), tmp_path / "plan.json")
    monkeypatch.setattr(plan_file, "LARGEST_FILE", 100)
    with pytest.raises(FormatError, match="at most 100"):
        read_plan(tmp_path / "plan.json")


def test_numbers_that_are_not_finite_are_not_written() -> None:
    """The sample, or else the key, is named."""
    record = full_record()
    track = record.tracks["r1"]
    x = track.x.copy()
    x[3] = np.nan
    with pytest.raises(FormatError, match=r"trajectories\.r1\.x\[3\]"):
        dump_plan(replace(record, tracks={"r1": replace(track, x=x)}))
    with pytest.raises(FormatError, match="makespan"):
        dump_plan(replace(record, makespan=math.inf))


def test_a_file_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    """If a name cannot be replaced, what was there stays, and nothing is left beside it."""
    write_text(tmp_path / "a.txt", "one\r\n")
    write_bytes(tmp_path / "a.txt", b"two\r\n")
    assert (tmp_path / "a.txt").read_bytes() == b"two\r\n"
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError):
        write_text(tmp_path / "folder", "three")
    assert sorted(os.listdir(tmp_path)) == ["a.txt", "folder"]
    with pytest.raises(OSError):
        write_text(tmp_path / "none" / "a.txt", "four")
