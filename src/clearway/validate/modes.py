"""Whether the steps of a four-wheel-steered robot are what their modes say."""

import numpy as np

from clearway.model import FOUR_WHEEL_MODES, Robot, RobotType, Track
from clearway.validate.displacement import Displacement
from clearway.validate.episodes import tell
from clearway.validate.steps import REST_STEP, Bools, moves
from clearway.validate.violation import Violation

FORWARD = ("forward", "forward-left", "forward-right")
REVERSE = ("reverse", "reverse-left", "reverse-right")
LATERAL = ("lateral-left", "lateral-right")
ROTATING = ("rotate-left", "rotate-right")
STRAIGHT = ("forward", "reverse")
# "Left" means that the turn's centre is on the body's left, in reverse too.
TURNING_LEFT = ("forward-left", "reverse-right", "rotate-left")
TURNING_RIGHT = ("forward-right", "reverse-left", "rotate-right")
STANDING = "stop"
ON_THE_SPOT = 5e-3
# A bend of this share of the tightest arc counts as straight.
STRAIGHT_SHARE = 0.04


def mode_mask(track: Track, names: tuple[str, ...]) -> Bools:
    """Return for each step whether its mode is one of ``names``."""
    return np.array([mode in names for mode in track.mode[:-1]], dtype=bool)


def judge_modes(
    robot: Robot, kind: RobotType, track: Track, motion: Displacement
) -> list[Violation]:
    """Return steps whose mode is not allowed or not what is driven."""
    if kind.kinematics != "four_wheel":
        return []
    moving = moves(track)
    known = mode_mask(track, (*(kind.modes or FOUR_WHEEL_MODES), STANDING))
    # A robot at rest may leave its mode unsaid.
    unsaid = np.array([mode is None for mode in track.mode[:-1]], dtype=bool) & ~moving
    foreign = ~known & ~unsaid
    otherwise = moving & known & ~_as_said(kind, track, motion)
    return [
        *tell(
            "mode",
            robot.id,
            track,
            foreign,
            foreign.astype(float),
            lambda i: f"mode {track.mode[i]} is not one of its type's modes",
        ),
        *tell(
            "mode",
            robot.id,
            track,
            otherwise,
            otherwise.astype(float),
            lambda i: (
                f"a step of mode {track.mode[i]} goes {motion.along[i]:.6f} m along and "
                f"{motion.across[i]:.6f} m across the body and turns by {motion.turn[i]:.6f} rad"
            ),
        ),
    ]


def _as_said(kind: RobotType, track: Track, motion: Displacement) -> Bools:
    along, across, turn = motion.along, motion.across, motion.turn
    radius = kind.limits.turning_radius or 1.0
    # Seen over its length a step may bend by a little, and stored figures are off by 1e-6.
    bend = STRAIGHT_SHARE * motion.length / radius + REST_STEP
    lengthwise, crosswise = np.abs(along) >= np.abs(across), np.abs(across) >= np.abs(along)
    right = np.ones(len(turn), dtype=bool)
    right &= ~mode_mask(track, (STANDING,))
    right &= ~mode_mask(track, FORWARD) | (lengthwise & (along > 0.0))
    right &= ~mode_mask(track, REVERSE) | (lengthwise & (along < 0.0))
    right &= ~mode_mask(track, ("lateral-left",)) | (crosswise & (across > 0.0))
    right &= ~mode_mask(track, ("lateral-right",)) | (crosswise & (across < 0.0))
    right &= ~mode_mask(track, STRAIGHT) | (np.abs(turn) <= bend)
    right &= ~mode_mask(track, TURNING_LEFT) | (turn >= -bend)
    right &= ~mode_mask(track, TURNING_RIGHT) | (turn <= bend)
    rotating = mode_mask(track, ROTATING)
    right &= ~rotating | (_strayed(track, rotating) <= ON_THE_SPOT + REST_STEP)
    return right


def _strayed(track: Track, rotating: Bools) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """Return how far (m) the reference point is from where its run of rotating began."""
    away = np.zeros(len(rotating))
    edges = np.flatnonzero(np.diff(rotating.astype(np.int8), prepend=0, append=0))
    for first, end in edges.reshape(-1, 2):
        after = slice(first + 1, end + 1)
        away[first:end] = np.hypot(track.x[after] - track.x[first], track.y[after] - track.y[first])
    return away
