"""Whether steps keep the limits on speed, turning and slip."""

import numpy as np

from clearway.model import Robot, RobotType, Track
from clearway.validate.displacement import Displacement
from clearway.validate.episodes import tell
from clearway.validate.modes import LATERAL, ROTATING, mode_mask
from clearway.validate.steps import REST_STEP
from clearway.validate.violation import Violation

SPEED_SLACK = 1.02
YAW_SLACK = 1.02
CURVATURE_SLACK = 1.04
SLIP = 5e-3
SLIP_WINDOW = 0.1


def judge_kinematics(
    robot: Robot, kind: RobotType, track: Track, motion: Displacement
) -> list[Violation]:
    """Return steps that break a limit of the robot's type."""
    return [
        *_speed(robot, kind, track, motion),
        *_yaw_rate(robot, kind, track, motion),
        *_curvature(robot, kind, track, motion),
        *_slip(robot, kind, track, motion),
    ]


def _speed(robot: Robot, kind: RobotType, track: Track, motion: Displacement) -> list[Violation]:
    limits, dt = kind.limits, motion.dt
    holonomic = kind.kinematics == "holonomic"
    # A holonomic robot goes backwards with a part of its motion, the others with all of it.
    back = -motion.along if holonomic else motion.length
    backwards = -motion.along > REST_STEP
    if kind.kinematics == "four_wheel":
        # Across the body and on the spot there is no backwards.
        backwards &= np.abs(motion.along) > np.abs(motion.across)
        backwards &= ~mode_mask(track, LATERAL + ROTATING)
    over = motion.length - SPEED_SLACK * limits.speed * dt
    over_back = back - SPEED_SLACK * limits.speed_backwards * dt
    fast = (over > REST_STEP) & (dt > 0.0)
    too_fast_back = backwards & (over_back > REST_STEP) & (dt > 0.0)
    if limits.reverse_speed is None:
        too_fast_back[:] = False
    elif not holonomic:
        fast &= ~backwards
    return [
        *tell(
            "speed",
            robot.id,
            track,
            fast,
            over,
            lambda i: f"{motion.length[i] / dt[i]:.3f} m/s, limit {limits.speed:.3f} m/s",
        ),
        *tell(
            "reverse_speed",
            robot.id,
            track,
            too_fast_back,
            over_back,
            lambda i: (
                f"{back[i] / dt[i]:.3f} m/s backwards, limit {limits.speed_backwards:.3f} m/s"
            ),
        ),
    ]


def _yaw_rate(robot: Robot, kind: RobotType, track: Track, motion: Displacement) -> list[Violation]:
    limit = kind.limits.yaw_rate
    if limit is None:
        return []
    turn = np.abs(motion.turn)
    over = turn - YAW_SLACK * limit * motion.dt
    return tell(
        "yaw_rate",
        robot.id,
        track,
        (over > REST_STEP) & (motion.dt > 0.0),
        over,
        lambda i: f"{turn[i] / motion.dt[i]:.3f} rad/s, limit {limit:.3f} rad/s",
    )


def _curvature(
    robot: Robot, kind: RobotType, track: Track, motion: Displacement
) -> list[Violation]:
    radius = kind.limits.turning_radius
    if radius is None:
        return []
    turn = np.abs(motion.turn)
    over = turn * radius - CURVATURE_SLACK * motion.length
    # Stored positions and headings may each be off by some 1e-6.
    broken = over > REST_STEP * (1.0 + radius)
    if kind.kinematics == "four_wheel":
        broken &= ~mode_mask(track, ROTATING)
    return tell(
        "turning_radius",
        robot.id,
        track,
        broken,
        over,
        lambda i: f"radius {motion.length[i] / turn[i]:.3f} m, least {radius:.3f} m",
    )


def _slip(robot: Robot, kind: RobotType, track: Track, motion: Displacement) -> list[Violation]:
    if kind.kinematics == "holonomic":
        return []
    sideways = np.abs(motion.across)
    if kind.kinematics == "four_wheel":
        # Whether it is the axis that the mode names is asked elsewhere.
        sideways = np.minimum(sideways, np.abs(motion.along))
        sideways[mode_mask(track, ROTATING)] = 0.0
    sideways[(sideways < REST_STEP) | (motion.dt == 0.0)] = 0.0
    slip = np.concatenate([[0.0], np.cumsum(sideways)])
    # The slip in a window is greatest where the window begins or ends at a sample.
    after = np.interp(track.t + SLIP_WINDOW, track.t, slip) - slip
    before = slip - np.interp(track.t - SLIP_WINDOW, track.t, slip)
    worst = np.maximum(after, before)
    return tell(
        "slip",
        robot.id,
        track,
        worst > SLIP + REST_STEP,
        worst,
        lambda i: (
            f"it slips {worst[i] * 1e3:.1f} mm within {SLIP_WINDOW} s, limit {SLIP * 1e3:.0f} mm"
        ),
    )
