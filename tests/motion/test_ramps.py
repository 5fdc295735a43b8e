"""Speeds are modes and ramps are motions: the tables of robots whose acceleration is limited."""

import math
import random
from dataclasses import replace

import pytest
from tests.motion.tables import random_poses
from tests.motion.wheels import apart, integrate

from clearway import _core
from clearway.formats.sampling import sample
from clearway.model import (
    FOUR_WHEEL_MODES,
    Footprint,
    Limits,
    Piece,
    Pose,
    Robot,
    RobotType,
    Trajectory,
    to_seconds,
    to_ticks,
)
from clearway.motion import model_of
from clearway.motion.native import native_table
from clearway.validate.acceleration import judge_acceleration
from clearway.validate.displacement import displacement_of
from clearway.validate.kinematics import judge_kinematics

PORT = RobotType(
    "port",
    Footprint.rectangle(6.0, 3.0),
    "four_wheel",
    Limits(speed=2.5, yaw_rate=0.57, turning_radius=4.7, acceleration=2.31, deceleration=1.16),
)
# Its arcs are slower than its straights, and it stops a long way behind its steps.
HEAVY = RobotType(
    "heavy",
    Footprint.rectangle(2.2, 1.2, rear=0.5),
    "ackermann",
    Limits(speed=2.0, yaw_rate=0.5, turning_radius=1.5, reverse_speed=0.8, deceleration=0.4),
)
STACKER = RobotType(
    "stacker",
    Footprint.rectangle(2.2, 0.9, rear=1.0),
    "ackermann",
    Limits(speed=1.4, reverse_speed=1.0, yaw_rate=0.7, turning_radius=1.2, acceleration=0.6),
    motion="forklift",
)
TUG = RobotType(
    "tug",
    Footprint.rectangle(0.9, 0.6),
    "differential",
    Limits(speed=1.5, yaw_rate=1.2, acceleration=5.0, deceleration=0.5),
)
TYPES = {robot_type.name: robot_type for robot_type in (PORT, HEAVY, STACKER, TUG)}


@pytest.fixture(params=TYPES)
def robot_type(request):
    return TYPES[request.param]


@pytest.fixture(params=[16, 32])
def headings(request):
    return request.param


def drive(robot_type, model, rng, count):
    """A trajectory of random motions, each where it may follow, that ends at rest."""
    pieces, timing, tick, at = [], [], 0, Pose(0.0, 0.0, 0.3)
    before, done = next(mode for mode in model.modes if mode.rest), 0
    while done < count or not before.rest:
        motions = [m for m in model.motions if before.name in m.enters]
        if done >= count:  # slower, as soon as it may be
            motions = [m for m in motions if model.mode(m.mode).pace < before.pace] or motions
        motion = rng.choice(motions)
        before = model.mode(motion.mode)
        for share, seconds in motion.pieces or ((1.0, motion.duration),):
            twist = tuple(share * value for value in motion.twist)
            pieces.append(Piece(len(pieces), before.moving, at, twist))
            timing.append((tick, tick + to_ticks(seconds)))
            tick, at = timing[-1][1], pieces[-1].end
        done += 1
    return Trajectory("r", pieces[0].start, tuple(pieces), tuple(timing))


def judged(robot_type, trajectory):
    """What the judge of speeds and that of accelerations find."""
    robot = Robot("r", robot_type.name, trajectory.start)
    track = sample(trajectory, robot_type.kinematics == "four_wheel")
    motion = displacement_of(track)
    return [
        *judge_acceleration(robot, robot_type, track, motion),
        *judge_kinematics(robot, robot_type, track, motion),
    ]


def test_a_ramp_goes_up_and_down():
    """4 m from rest to rest at 1 m/s^2 take 2 s up to 2 m/s and 2 s down; 0.1 s cover 5 mm."""
    steps = _core.ramp(4.0, 0.0, 0.0, 9.0, 1.0, 1.0)
    assert [ticks for _, ticks in steps] == [100] * 40
    assert math.fsum(way for way, _ in steps) == pytest.approx(4.0)
    assert [way for way, _ in steps[:3]] == pytest.approx([0.005, 0.015, 0.025])
    assert steps[-1][0] == pytest.approx(0.005)


def test_a_ramp_holds_its_top_speed():
    """At most 1 m/s on 3 m, at 1 and 0.5 m/s^2: 0.5 m up, 1 m down, so 1.5 m are held."""
    steps = _core.ramp(3.0, 0.0, 0.0, 1.0, 1.0, 0.5)
    assert (1500, pytest.approx(1.5)) in [(ticks, way) for way, ticks in steps]
    assert sum(ticks for _, ticks in steps) == 1000 + 1500 + 2000


def test_who_cannot_stop_in_time_has_no_ramp():
    """From 2 m/s at 1 m/s^2 it takes 2 m to stop, and as many to come to 2 m/s."""
    assert _core.ramp(1.9, 2.0, 0.0, 2.0, 1.0, 1.0) == []
    assert _core.ramp(1.9, 0.0, 2.0, 2.0, 1.0, 1.0) == []
    assert _core.ramp(2.0, 2.0, 0.0, 2.0, 1.0, 1.0) != []


def test_motions_end_where_driving_their_pieces_ends(robot_type, headings):
    """Each piece integrated in fine steps at its own even speed, one after the other."""
    for motion in model_of(robot_type, headings).motions:
        start = end = Pose(3.0, -2.0, 0.7)
        for share, seconds in motion.pieces or ((1.0, motion.duration),):
            a, b, c = (share * value / seconds for value in motion.twist)
            end = integrate(end, math.atan2(b, a), math.hypot(a, b), c, seconds, 400)
        assert apart(end, Piece(0, None, start, motion.twist).end) < 1e-6


def test_motions_begin_and_end_at_the_speed_of_their_modes(robot_type, headings):
    """Within what speed changes in half of 0.12 s, and they change it no faster in between."""
    model = model_of(robot_type, headings)
    up, down = model.acceleration, model.deceleration
    for motion in (m for m in model.motions if m.length):
        speeds = [share * motion.length / seconds for share, seconds in motion.pieces]
        enters = {model.mode(name).pace for name in motion.enters}
        (enter,) = enters
        leave = model.mode(motion.mode).pace
        assert abs(speeds[0] - enter) <= 0.06 * max(up, down) + 1e-6
        assert abs(speeds[-1] - leave) <= 0.06 * max(up, down) + 1e-6
        times = [seconds for _, seconds in motion.pieces]
        for k in range(1, len(speeds)):
            apart_in_time = 0.5 * (times[k - 1] + times[k])
            assert -down * 1.001 <= (speeds[k] - speeds[k - 1]) / apart_in_time <= up * 1.001


def test_waiting_is_possible_only_at_rest(robot_type, headings):
    """Speed levels are no rest; from rest to rest every motion without limits is left."""
    model = model_of(robot_type, headings)
    free = replace(robot_type.limits, acceleration=None, deceleration=None)
    base = model_of(replace(robot_type, limits=free), headings)
    assert {mode.name for mode in model.modes if mode.rest} == {mode.name for mode in base.modes}
    assert all(mode.pace > 0.0 for mode in model.modes if not mode.rest)
    assert {mode.moving for mode in model.modes} == {mode.name for mode in base.modes}
    resting = {name for name in (mode.name for mode in model.modes if mode.rest)}
    stop_and_go = [
        (m.mode, pytest.approx(m.twist))
        for m in model.motions
        if m.mode in resting and set(m.enters) == resting
    ]
    for motion in base.motions:
        assert (motion.mode, motion.twist) in stop_and_go


def test_a_turn_round_needs_rest(headings):
    """At speed forward goes over into forward arcs alone, and from nowhere else."""
    model = model_of(PORT, headings)
    for motion in model.motions:
        fast = {name for name in motion.enters if not model.mode(name).rest}
        if fast:
            directions = {model.mode(name).direction for name in fast}
            assert directions == {model.mode(motion.mode).direction}
            assert all(not model.mode(name).rest for name in motion.enters)
    assert {mode.moving for mode in model.modes} == set(FOUR_WHEEL_MODES)


def test_where_changes_of_mode_take_time_they_need_rest():
    """Then a speed level is entered at rest or from the same mode."""
    model = model_of(replace(PORT, mode_switch=1.0), 16)
    for motion in model.motions:
        for name in motion.enters:
            before = model.mode(name)
            assert before.rest or before.moving == model.mode(motion.mode).moving


@pytest.mark.parametrize("seed", range(12))
def test_whatever_is_driven_passes_the_judge(robot_type, headings, seed):
    """Random chains of 40 motions, with turns round and changes of mode at speed."""
    model = model_of(robot_type, headings)
    trajectory = drive(robot_type, model, random.Random(seed), 40)
    assert [str(violation) for violation in judged(robot_type, trajectory)] == []


def test_without_ramps_the_judge_objects(robot_type):
    """The same robots driven at even speed from rest."""
    free = replace(robot_type.limits, acceleration=None, deceleration=None)
    base = model_of(replace(robot_type, limits=free), 16)
    motion = next(m for m in base.motions if m.length)
    piece = Piece(0, motion.mode, Pose(0.0, 0.0, 0.3), motion.twist)
    once = Trajectory("r", piece.start, (piece,), ((0, to_ticks(motion.duration)),))
    kinds = {violation.kind for violation in judged(robot_type, once)}
    assert kinds & {"acceleration", "deceleration"}


def shot(model, start, goal, mode):
    """The best curve from a mode, as a trajectory."""
    number = [known.name for known in model.modes].index(mode)
    steps = _core.connect(
        native_table(model), _core.Objective(), _core.Pose(*start), _core.Pose(*goal), number
    )
    pieces, timing, tick, at = [], [], 0, start
    for step in steps:
        twist = (step.twist.a, step.twist.b, step.twist.c)
        pieces.append(Piece(len(pieces), model.modes[step.mode].name, at, twist))
        timing.append((tick, tick + step.duration))
        tick, at = tick + step.duration, pieces[-1].end
    return Trajectory("r", start, tuple(pieces), tuple(timing))


def test_curves_from_rest_keep_the_limits(robot_type):
    """From anywhere to anywhere within 12 m, at rest at both ends."""
    model = model_of(robot_type, 16)
    for start, goal in zip(random_poses(100, 2), random_poses(100, 3), strict=True):
        trajectory = shot(model, start, goal, model.modes[0].name)
        assert apart(trajectory.pieces[-1].end, goal) < 1e-6
        assert judged(robot_type, trajectory) == []


def test_curves_from_speed_go_on_at_that_speed(robot_type):
    """Whoever comes at the speed of arcs goes on ahead, and stops in no less than v^2 / 2 d."""
    model = model_of(robot_type, 16)
    on_arcs = model.yaw_rate * model.curves[0].radius + 1e-9
    levels = [m for m in model.modes if m.moving == "forward" and m.pace <= on_arcs]
    fast = max(levels, key=lambda mode: mode.pace)
    braking = fast.pace**2 / (2.0 * model.deceleration)
    found = 0
    for start, goal in zip(random_poses(100, 4), random_poses(100, 5), strict=True):
        trajectory = shot(model, start, goal, fast.name)
        if not trajectory.pieces:
            continue
        found += 1
        first, (_, end) = trajectory.pieces[0], trajectory.timing[0]
        assert first.twist[0] > 0.0
        assert first.length / to_seconds(end) >= fast.pace - 0.06 * model.deceleration - 0.05
        ahead = 0.0
        for piece in trajectory.pieces:
            if piece.twist[0] <= 0.0:
                break
            ahead += piece.length
        assert ahead >= braking * (1.0 - 1e-6)
        assert apart(trajectory.pieces[-1].end, goal) < 1e-6
    assert found > 20


def test_a_robot_that_drives_in_any_direction_has_no_ramps():
    """Its one mode has no direction in which it could go on at speed."""
    floating = replace(TUG, kinematics="holonomic")
    with pytest.raises(ValueError, match="one direction"):
        model_of(floating, 16)
