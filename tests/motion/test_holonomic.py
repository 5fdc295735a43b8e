"""The table of the holonomic robot is what its velocity in the body frame comes to."""

import math
from dataclasses import replace

import pytest
from tests.motion.tables import STARTS, check_curves, check_limits, connect, length_of
from tests.motion.wheels import apart, integrate

from clearway.model import Footprint, Limits, Piece, Pose, RobotType
from clearway.motion import holonomic

FLOAT = RobotType("float", Footprint(radius=0.5), "holonomic", Limits(speed=1.0, yaw_rate=0.8))
TYPES = {
    "float": FLOAT,
    "slow back": replace(FLOAT, limits=replace(FLOAT.limits, reverse_speed=0.3)),
    "free to turn": replace(FLOAT, limits=Limits(speed=2.0)),
    "never back": replace(FLOAT, limits=replace(FLOAT.limits, reverse_speed=0.0)),
    "quick back": replace(
        FLOAT, limits=replace(FLOAT.limits, reverse_speed=3.0, turning_radius=1.5)
    ),
    "curving": replace(FLOAT, limits=replace(FLOAT.limits, turning_radius=1.5)),
}


@pytest.fixture(params=[16, 32])
def headings(request):
    return request.param


@pytest.fixture(params=TYPES)
def robot_type(request):
    return TYPES[request.param]


def float_along(start, velocity, yaw, seconds):
    """Keep a velocity in the body frame (m/s): dx = R(th) u dt, dth = w dt."""
    course, speed = math.atan2(velocity[1], velocity[0]), math.hypot(*velocity)
    return integrate(start, course, speed, yaw, seconds, 2000)


@pytest.mark.parametrize("start", STARTS)
def test_keeping_a_velocity_ends_where_the_table_says(robot_type, headings, start):
    """Each motion by its velocity and yaw rate."""
    for motion in holonomic(robot_type, headings).motions:
        a, b, c = (value / motion.duration for value in motion.twist)
        end = float_along(start, (a, b), c, motion.duration)
        assert apart(end, Piece(0, motion.mode, start, motion.twist).end) < 1e-6


def test_keeping_a_velocity_ends_where_curves_say(robot_type):
    """Also where it turns on its way."""
    model = holonomic(robot_type)
    for i in range(40):
        start, goal = Pose(0.0, 0.0, 0.3 * i), Pose(3.0 * math.cos(i), 2.0, -0.2 * i)
        for piece, seconds in connect(model, start, goal):
            a, b, c = (value / seconds for value in piece.twist)
            assert apart(float_along(piece.start, (a, b), c, seconds), piece.end) < 1e-5


def test_limits_are_kept(robot_type, headings):
    """By motions and by curves; backwards only a part of the velocity counts."""
    check_limits(holonomic(robot_type, headings), robot_type.limits)


def test_curves_end_at_their_goals(robot_type):
    """What may not go backwards turns first where it must."""
    check_curves(holonomic(robot_type), all_reached=robot_type.limits.reverse_speed != 0.0)


def test_it_goes_in_sixteen_directions_in_one_mode(headings):
    """Without turning, each as far as the next; and it turns on the spot both ways."""
    model = holonomic(FLOAT, headings)
    drives = [m for m in model.motions if m.mode == "drive"]
    courses = sorted(math.atan2(m.twist[1], m.twist[0]) % (2.0 * math.pi) for m in drives)
    assert courses == pytest.approx([math.pi / 8.0 * k for k in range(16)])
    assert {m.turn_steps for m in drives} == {0}
    assert [m.turn_steps for m in model.motions if not length_of(m)] == [1, -1]


@pytest.mark.parametrize(
    ("name", "slowest", "count"), [("slow back", 0.3, 16), ("never back", 1, 9)]
)
def test_backwards_is_what_a_reverse_speed_binds(headings, name, slowest, count):
    """Right to the side it is as fast as ahead; straight back at 0.3 m/s, or not at all."""
    drives = [m for m in holonomic(TYPES[name], headings).motions if m.mode == "drive"]
    speeds = [length_of(m) / m.duration for m in drives]
    assert min(speeds) == pytest.approx(slowest)
    assert len(drives) == count
    sideways = [m for m in drives if abs(m.twist[0]) < 1e-9]
    assert [length_of(m) / m.duration for m in sideways] == pytest.approx([1.0, 1.0])


def test_with_a_turning_radius_it_never_turns_on_the_spot(headings):
    """It turns along arcs, and still goes to any side."""
    motions = holonomic(TYPES["curving"], headings).motions
    assert all(length_of(motion) for motion in motions)
    assert {motion.turn_steps for motion in motions} == {-1, 0, 1}


def test_the_quickest_way_turns_on_its_way():
    """3 m to the side with an eighth of a turn: an arc of 3 (pi/8) / sin(pi/8) m at 1 m/s."""
    ((piece, seconds),) = connect(holonomic(FLOAT), STARTS[0], Pose(0.0, 3.0, math.pi / 4.0))
    assert piece.mode == "drive"
    assert seconds == pytest.approx(3.0 * (math.pi / 8.0) / math.sin(math.pi / 8.0), abs=1e-3)
