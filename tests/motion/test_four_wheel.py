"""The table of the 4WIDS robot is what driving it comes to."""

import math
from dataclasses import replace

import pytest
from tests.motion.wheels import MEANING, SPINS, apart, drive, spin

from clearway.model import FOUR_WHEEL_MODES, Footprint, Limits, Piece, Pose, RobotType
from clearway.motion import Mode, Motion, MotionModel, four_wheel

CARRIER = RobotType(
    "carrier",
    Footprint.rectangle(3.0, 2.0),
    "four_wheel",
    Limits(speed=2.5, yaw_rate=0.57, turning_radius=3.0),
)
# Long body, tight radius: an arc as long as half the body is wider than the tightest.
LONG = replace(CARRIER, limits=Limits(speed=1.0, reverse_speed=0.4, yaw_rate=0.9, turning_radius=1))
TYPES = {"carrier": CARRIER, "long": LONG}
STARTS = [Pose(0.0, 0.0, 0.0), Pose(-4.0, 7.0, 2.5)]


@pytest.fixture(params=[16, 32])
def headings(request):
    return request.param


@pytest.fixture(params=TYPES)
def robot_type(request):
    return TYPES[request.param]


def table_end(motion, start):
    return Piece(0, motion.mode, start, motion.twist).end


def test_there_is_a_motion_for_each_of_the_eleven_modes_but_standing(robot_type, headings):
    """Eleven modes, one of which stands still; each of the other ten has a motion."""
    model = four_wheel(robot_type, headings)
    assert [mode.name for mode in model.modes] == list(FOUR_WHEEL_MODES)
    assert sorted(motion.mode for motion in model.motions) == sorted({*MEANING, *SPINS})


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("mode", MEANING)
def test_driving_a_mode_ends_where_the_table_says(robot_type, headings, mode, start):
    """Integrated in 2000 steps, a mode at its speed for its duration ends at the table's pose."""
    model = four_wheel(robot_type, headings)
    for motion in (m for m in model.motions if m.mode == mode):
        speed = math.hypot(*motion.twist[:2]) / motion.duration
        turn = abs(motion.twist[2])
        radius = math.hypot(*motion.twist[:2]) / turn if turn else math.inf
        end = drive(start, mode, speed, motion.duration, radius)
        assert apart(end, table_end(motion, start)) < 1e-6


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("mode", SPINS)
def test_turning_on_the_spot_ends_one_heading_further(robot_type, headings, mode, start):
    """The point of reference stays, and the heading turns by a full turn over the headings."""
    model = four_wheel(robot_type, headings)
    (motion,) = (m for m in model.motions if m.mode == mode)
    end = spin(start, mode, robot_type.limits.yaw_rate, motion.duration)
    assert apart(end, table_end(motion, start)) < 1e-9
    assert motion.twist == pytest.approx((0.0, 0.0, SPINS[mode] * 2.0 * math.pi / headings))


def test_no_motion_exceeds_a_limit(robot_type, headings):
    """Speed, speed in reverse, yaw rate and radius are kept by every motion."""
    limits = robot_type.limits
    for motion in four_wheel(robot_type, headings).motions:
        length, turn = math.hypot(*motion.twist[:2]), abs(motion.twist[2])
        top = limits.speed_backwards if motion.mode.startswith("reverse") else limits.speed
        assert length <= top * motion.duration * (1.0 + 1e-9)
        assert turn <= limits.yaw_rate * motion.duration * (1.0 + 1e-9)
        if motion.mode not in SPINS:
            assert turn * limits.turning_radius <= length * (1.0 + 1e-9)


def test_the_carrier_does_its_tightest_arc_as_fast_as_its_yaw_rate_lets_it(headings):
    """0.57 rad/s on 3 m: 1.71 m/s; straight ahead 2.5 m/s."""
    model = four_wheel(CARRIER, headings)
    assert model.mode("forward-left").speed == pytest.approx(1.71)
    assert model.mode("reverse-right").speed == pytest.approx(1.71)
    assert model.mode("forward").speed == 2.5
    assert model.mode("rotate-left").speed == 0.57


@pytest.mark.parametrize("side", [1, -1])
def test_left_means_that_the_centre_is_on_the_left_also_in_reverse(headings, side):
    """A quarter turn round a centre 3 m to a side ends 3 m off both ways, ahead or behind."""
    model = four_wheel(CARRIER, headings)
    name = "left" if side > 0 else "right"
    for way, ahead in (("forward", 1), ("reverse", -1)):
        (motion,) = (m for m in model.motions if m.mode == f"{way}-{name}")
        pose = STARTS[0]
        for _ in range(headings // 4):
            pose = table_end(motion, pose)
        heading = ahead * side * math.pi / 2.0
        assert apart(pose, Pose(3.0 * ahead, 3.0 * side, heading)) < 1e-9


def test_lateral_left_goes_to_the_left(headings):
    """It is named after where it goes, and the heading stays."""
    model = four_wheel(CARRIER, headings)
    (motion,) = (m for m in model.motions if m.mode == "lateral-left")
    end = table_end(motion, Pose(1.0, 1.0, math.pi / 2.0))
    assert end.x < 1.0
    assert end[1:] == pytest.approx((1.0, math.pi / 2.0))


def test_motions_keep_to_the_headings(robot_type, headings):
    """Wherever a robot starts, a chain of motions has no more headings than the table."""
    step = 2.0 * math.pi / headings
    for motion in four_wheel(robot_type, headings).motions:
        assert motion.twist[2] == pytest.approx(motion.turn_steps * step, abs=1e-12)


@pytest.mark.parametrize(
    "modes",
    [
        ("forward",),
        ("stop", "forward", "forward-left", "forward-right"),
        ("lateral-left", "lateral-right"),
        ("stop", "forward", "rotate-left"),
        FOUR_WHEEL_MODES[:7],
    ],
)
def test_a_robot_moves_only_in_its_own_modes(modes, headings):
    """A subset of the modes leaves the motions and curves of that subset; all may stand."""
    model = four_wheel(replace(CARRIER, modes=modes), headings)
    assert {mode.name for mode in model.modes} == {*modes, "stop"}
    assert {motion.mode for motion in model.motions} == {*modes} - {"stop"}
    for curve in model.curves:
        assert {*curve.ahead, *curve.back, *curve.spin} <= {*modes, None}


def test_a_robot_that_may_not_reverse_has_no_way_back(headings):
    """With a reverse speed of 0 the three modes in reverse are gone, sideways ones stay."""
    forbidden = replace(CARRIER, limits=replace(CARRIER.limits, reverse_speed=0.0))
    model = four_wheel(forbidden, headings)
    names = {mode.name for mode in model.modes}
    assert names == {n for n in FOUR_WHEEL_MODES if not n.startswith("reverse")}
    assert all(m.twist[0] >= -1e-9 for m in model.motions)


def test_a_slower_reverse_is_slower(headings):
    """At 0.4 m/s back and 1 m/s ahead, the way back takes 2.5 times as long."""
    model = four_wheel(LONG, headings)
    (ahead,) = (m for m in model.motions if m.mode == "forward")
    (back,) = (m for m in model.motions if m.mode == "reverse")
    assert back.duration / ahead.duration == pytest.approx(2.5)
    assert back.twist[0] == pytest.approx(-ahead.twist[0])


def test_without_a_turning_radius_there_are_no_arcs(headings):
    """A type that states no radius drives straight and turns on the spot."""
    free = replace(CARRIER, limits=Limits(speed=1.0, yaw_rate=0.5))
    assert {m.mode for m in four_wheel(free, headings).motions} == {
        "forward",
        "reverse",
        "lateral-left",
        "lateral-right",
        "rotate-left",
        "rotate-right",
    }


def one_mode(motion):
    return MotionModel(8, (Mode("go", 0.0, 0, 1.0),), (motion,), (), 1.0, 1.0)


@pytest.mark.parametrize(
    ("motion", "said"),
    [
        (Motion("fly", (1.0, 0.0, 0.0), 0, 1.0), "'fly'"),
        (Motion("go", (1.0, 0.0, 0.3), 1, 1.0), "0.785398"),
        (Motion("go", (1.0, 0.0, 0.0), 0, 0.0), "duration above 0"),
        (Motion("go", (1.0, 0.0, 0.0), 0, 1.0, ("fly",)), "begins in mode 'fly'"),
        (Motion("go", (1.0, 0.0, 0.0), 0, 1.0, (), ((0.5, 0.5),)), "0.500000 of it in 0.5"),
    ],
)
def test_a_table_that_contradicts_itself_is_refused(motion, said):
    """A mode that is not there, a turn between headings, no time, pieces that are not the whole."""
    with pytest.raises(ValueError, match=said):
        one_mode(motion)


def test_two_modes_of_one_name_are_refused():
    """Names are how modes are told apart in files."""
    mode = Mode("go", 0.0, 0, 1.0)
    with pytest.raises(ValueError, match="same name"):
        MotionModel(8, (mode, mode), (), (), 1.0, 1.0)
