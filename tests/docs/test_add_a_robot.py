"""The page on adding a robot."""

import math

import pytest
from tests.docs.run_page import DOCS, run_page
from tests.motion.wheels import apart, integrate

from clearway.formats.scenario_file import parse_scenario
from clearway.model import Footprint, Limits, Piece, Pose, RobotType, Status
from clearway.motion import MODELS

NAME = "how-to/add-a-robot.md"


@pytest.fixture(scope="module")
def page():
    """The page, run; the models are left as they were."""
    before = dict(MODELS)
    try:
        yield run_page(NAME)
    finally:
        MODELS.clear()
        MODELS.update(before)


def test_the_page_runs_and_its_robots_change_sides(page):
    """The plan is solved and judged right, with the robots that the page describes."""
    run = page["run"]
    assert run.plan.status is Status.SOLVED
    assert run.violations == ()
    assert {robot.type for robot in run.record.robots} == {"mover"}
    modes = {piece.mode for path in run.plan.trajectories.values() for piece in path.pieces}
    assert modes <= {*page["COURSES"], "turn-left", "turn-right"}


@pytest.mark.parametrize("headings", [16, 32])
def test_its_motions_end_where_driving_them_ends(page, headings):
    """Eight courses at 1.2 m/s and a turn at 0.8 rad/s, integrated in fine steps."""
    mover = RobotType(
        "mover", Footprint.rectangle(1.2, 0.8), "holonomic", Limits(speed=1.2, yaw_rate=0.8)
    )
    model = page["pallet_mover"](mover, headings)
    start = Pose(3.0, -2.0, 0.7)
    assert len(model.motions) == 10
    for motion in model.motions:
        mode = model.mode(motion.mode)
        speed = 0.0 if mode.direction is None else 1.2
        yaw = 0.8 * mode.turn if mode.direction is None else 0.0
        end = integrate(start, mode.direction or 0.0, speed, yaw, motion.duration, 1000)
        assert apart(end, Piece(0, motion.mode, start, motion.twist).end) < 1e-9
        assert math.hypot(*motion.twist[:2]) <= 1.2 * motion.duration + 1e-9


def test_the_table_of_the_page_is_a_robot_type():
    """What the page writes in TOML is read as it stands."""
    text = (DOCS / NAME).read_text(encoding="utf-8")
    table = text.split("```toml\n")[1].split("```")[0]
    scenario = parse_scenario(
        'format = "clearway.scenario/1"\nname = "yard"\n'
        'robots = [{id = "r1", type = "tractor", start = [5, 5, 0]}]\n'
        "site = {bounds = [[0, 0], [20, 0], [20, 20], [0, 20]]}\n" + table
    )
    assert scenario.robot_types["tractor"].limits.reverse_speed == 0.5


def test_the_page_names_files_that_exist():
    """Tests, models and rules are where the page says."""
    text = (DOCS / NAME).read_text(encoding="utf-8")
    for name in (
        "tests/motion/test_four_wheel.py",
        "tests/plan/rooms.py",
        "src/clearway/validate/kinematics.py",
        "src/clearway/motion/__init__.py",
    ):
        assert name in text
        assert (DOCS.parent / name).is_file()
