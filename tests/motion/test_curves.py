"""Analytic curves: as short as the literature's, ending where they are meant to."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.motion.wheels import MEANING, SPINS, apart, drive, spin

from clearway import _core
from clearway.model import Footprint, Limits, Piece, Pose, RobotType, to_seconds, wrap
from clearway.motion import four_wheel
from clearway.motion.native import native_table

CARRIER = RobotType(
    "carrier",
    Footprint.rectangle(3.0, 2.0),
    "four_wheel",
    Limits(speed=2.5, yaw_rate=0.57, turning_radius=3.0),
)
SLOW_BACK = replace(CARRIER, limits=replace(CARRIER.limits, reverse_speed=0.5))
CAR = replace(
    CARRIER,
    modes=(
        "forward",
        "reverse",
        "forward-left",
        "forward-right",
        "reverse-left",
        "reverse-right",
    ),
)
ONLY_AHEAD = replace(CAR, limits=replace(CAR.limits, reverse_speed=0.0))
CRAB = replace(CARRIER, modes=("lateral-left", "lateral-right", "rotate-left", "rotate-right"))
TYPES = {
    "carrier": CARRIER,
    "slow back": SLOW_BACK,
    "car": CAR,
    "only ahead": ONLY_AHEAD,
    "crab": CRAB,
}


def connect(robot_type, start, goal, time=True):
    """Steps of the best connection as pieces with their durations (s)."""
    model = four_wheel(robot_type)
    objective = _core.Objective()
    objective.time = time
    names = [mode.name for mode in model.modes]
    steps = _core.connect(native_table(model), objective, _core.Pose(*start), _core.Pose(*goal))
    pieces, at = [], start
    for step in steps:
        twist = (step.twist.a, step.twist.b, step.twist.c)
        mode = names[step.mode] if step.mode >= 0 else None
        pieces.append((Piece(len(pieces), mode, at, twist), to_seconds(step.duration)))
        at = pieces[-1][0].end
    return pieces


def random_poses(count, seed, reach=12.0):
    rng = np.random.default_rng(seed)
    for row in rng.uniform(-1.0, 1.0, (count, 3)):
        yield Pose(reach * row[0], reach * row[1], math.pi * row[2])


def test_lengths_agree_with_the_open_motion_planning_library():
    """10,000 random poses up to 8 radii away: the distance in OMPL's Reeds-Shepp space."""
    ob = pytest.importorskip(
        "ompl.base", reason="OMPL is not installed: pip install ompl (the oracle for curve lengths)"
    )
    space = ob.ReedsSheppStateSpace(1.0)
    origin, there = space.allocState(), space.allocState()
    origin.setXY(0.0, 0.0)
    origin.setYaw(0.0)
    rng = np.random.default_rng(20)
    worst = 0.0
    for scale, (x, y, turn) in zip(
        rng.choice([0.3, 2.0, 8.0], 10_000), rng.uniform(-1.0, 1.0, (10_000, 3)), strict=True
    ):
        there.setXY(scale * x, scale * y)
        there.setYaw(math.pi * turn)
        ours = _core.reeds_shepp_length(scale * x, scale * y, math.pi * turn)
        worst = max(worst, abs(ours - space.distance(origin, there)))
    assert worst < 1e-6


@pytest.mark.parametrize(
    ("pose", "length"),
    [
        ((5.0, 0.0, 0.0), 5.0),  # straight ahead
        ((-5.0, 0.0, 0.0), 5.0),  # straight back
        ((1.0, 1.0, math.pi / 2.0), math.pi / 2.0),  # a quarter of the unit circle
        ((0.0, 2.0, math.pi), math.pi),  # half of it
        ((0.0, 0.0, math.pi), math.pi),  # three arcs of pi / 3 turn about on the spot
        ((0.0, 0.0, 0.0), 0.0),
    ],
)
def test_lengths_that_can_be_worked_out_by_hand(pose, length):
    """Radius 1, from the origin."""
    assert _core.reeds_shepp_length(*pose) == pytest.approx(length, abs=1e-9)


def test_a_curve_driven_by_the_kinematic_equation_ends_at_its_pose():
    """The word's segments, integrated one after another, lead there, and are as long as told."""
    for goal in random_poses(300, 1, reach=6.0):
        word = _core.reeds_shepp_word(*goal)
        at = Pose(0.0, 0.0, 0.0)
        for side, length in word:
            way = "forward" if length > 0.0 else "reverse"
            mode = way + {1: "-left", -1: "-right", 0: ""}[side]
            at = drive(at, mode, 1.0, abs(length), 1.0)
        assert apart(at, goal) < 1e-5
        assert math.fsum(abs(length) for _, length in word) == pytest.approx(
            _core.reeds_shepp_length(*goal)
        )


@pytest.mark.parametrize("time", [True, False], ids=["time", "paper"])
@pytest.mark.parametrize("name", TYPES)
def test_a_connection_ends_at_its_goal(name, time):
    """From anywhere to anywhere within 12 m, whatever is minimised."""
    connected = 0
    pairs = zip(random_poses(300, 2), random_poses(300, 3), strict=True)
    for start, goal in pairs:
        if pieces := connect(TYPES[name], start, goal, time):
            connected += 1
            assert apart(pieces[-1][0].end, goal) < 1e-6
    # A robot that cannot back up does not reach every pose by one of these curves.
    assert connected == 300 or name == "only ahead"
    assert connected > 100


@pytest.mark.parametrize("name", TYPES)
def test_a_connection_is_driven_in_modes_that_are_what_they_say(name):
    """Each step, driven in the mode it names by the kinematic equation, ends where it should.

    Lateral modes are exempt where they curve: the name tells only the side they move to.
    """
    robot_type = TYPES[name]
    allowed = {mode.name for mode in four_wheel(robot_type).modes}
    for start, goal in zip(random_poses(100, 4), random_poses(100, 5), strict=True):
        for piece, seconds in connect(robot_type, start, goal):
            assert piece.mode in allowed
            a, b, c = piece.twist
            if piece.mode in SPINS:
                end = spin(piece.start, piece.mode, abs(c) / seconds, seconds)
            elif piece.mode.startswith("lateral") and c:
                assert a == pytest.approx(0.0, abs=1e-9)
                assert (b > 0.0) == (piece.mode == "lateral-left")
                continue
            else:
                radius = piece.length / abs(c) if c else math.inf
                speed = piece.length / seconds
                end = drive(piece.start, piece.mode, speed, seconds, radius, steps=4000)
            assert apart(end, piece.end) < 1e-5


@pytest.mark.parametrize("name", TYPES)
def test_a_connection_keeps_the_limits(name):
    """Speed ahead and back, yaw rate and turning radius of each step."""
    limits = TYPES[name].limits
    for start, goal in zip(random_poses(200, 6), random_poses(200, 7), strict=True):
        for piece, seconds in connect(TYPES[name], start, goal):
            back = piece.mode.startswith("reverse")
            top = limits.speed_backwards if back else limits.speed
            turn = abs(piece.twist[2])
            assert piece.length <= top * seconds + 1e-9
            assert turn <= limits.yaw_rate * seconds + 1e-9
            if piece.mode not in SPINS:
                assert turn * limits.turning_radius <= piece.length + 1e-9


def test_sideways_is_the_quickest_way_to_the_side():
    """4 m to the left at 2.5 m/s takes 1.6 s, in one step."""
    ((piece, seconds),) = connect(
        CARRIER, Pose(1.0, 1.0, 0.3), Pose(1.0, 1.0, 0.3).compose(Pose(0.0, 4.0, 0.0))
    )
    assert piece.mode == "lateral-left"
    assert seconds == pytest.approx(1.6)


def test_a_straight_line_needs_no_arcs():
    """A robot that may only go straight comes to what lies straight ahead or behind."""
    train = replace(CARRIER, modes=("forward", "reverse"))
    for theta in np.linspace(-3.0, 3.0, 25):
        start = Pose(2.0, -1.0, float(theta))
        for distance, mode in ((7.0, "forward"), (-0.4, "reverse")):
            goal = start.compose(Pose(distance, 0.0, 0.0))
            assert [piece.mode for piece, _ in connect(train, start, goal)] == [mode]


def test_a_change_of_mode_takes_its_time():
    """Turn by a quarter, drive 5 m, turn back: with 2 s for a change, it stands twice for 2 s."""
    modes = ("forward", "reverse", "rotate-left", "rotate-right")
    slow = replace(CARRIER, modes=modes, mode_switch=2.0)
    pieces = connect(slow, Pose(0.0, 0.0, 0.0), Pose(0.0, 5.0, 0.0))
    told = [(piece.mode, seconds) for piece, seconds in pieces]
    assert told[1:-1] == [(None, 2.0), ("forward", 2.0), (None, 2.0)]
    assert {told[0][0], told[-1][0]} == {"rotate-left", "rotate-right"}


@pytest.mark.parametrize("headings", [16, 32])
def test_durations_are_rounded_up_to_whole_ticks(headings):
    """The core's table is never faster than the model, and at most a tick slower."""
    model = four_wheel(SLOW_BACK, headings)
    table = native_table(model)
    assert table.headings == headings
    for motion, primitive in zip(model.motions, table.primitives, strict=True):
        late = to_seconds(primitive.duration) - motion.duration
        assert -1e-9 <= late < 1e-3
        twist = (primitive.twist.a, primitive.twist.b, primitive.twist.c)
        assert twist == pytest.approx(motion.twist)
        assert model.modes[primitive.mode].name == motion.mode


def test_poses_of_a_piece_agree_with_the_driven_mode():
    """Half-way along an arc is half of its time by the kinematic equation."""
    piece = Piece(0, "forward-left", Pose(1.0, 2.0, 0.4), (3.0, 0.0, 1.0))
    assert apart(piece.at(0.5), drive(piece.start, piece.mode, 1.0, 1.5, 3.0)) < 1e-6
    assert piece.heading_at(0.5) == pytest.approx(wrap(0.9))
    assert set(MEANING) | set(SPINS) | {"stop"} == {m.name for m in four_wheel(CARRIER).modes}
