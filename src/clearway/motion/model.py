"""A motion model: modes, short body-frame motions and analytic curves, as plain data."""

import math
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Mode:
    """One way of moving.

    Parameters
    ----------
    direction
        Body-frame angle of travel (rad); ``"any"`` where each motion has its own; ``None``
        where the reference point stays.
    turn
        Where the turn's centre lies: 1 on the body's left, -1 on its right, 0 straight.
        For a mode without travel: 1 turns counter-clockwise, -1 clockwise.
    speed
        Top speed of the reference point (m/s); for turning on the spot, the yaw rate (rad/s).
    rest
        Whether the robot may wait in it: only where it can be at rest at once.
    backwards
        Of travel in any direction, top speed of the part that goes backwards (m/s); 0 forbids
        any. ``None``: ``speed``.
    of
        The mode of which this one is a speed level: what plans call it. A level is entered and
        left at ``speed``, a mode that is none of another at rest.
    """

    name: str
    direction: float | Literal["any"] | None
    turn: int
    speed: float
    rest: bool = True
    backwards: float | None = None
    of: str | None = None

    @property
    def moving(self) -> str:
        """The mode without its speed."""
        return self.of or self.name

    @property
    def pace(self) -> float:
        """Speed (m/s) at which motions begin and end in it, where acceleration is limited."""
        return self.speed if self.of else 0.0

    @property
    def is_moving(self) -> bool:
        """Whether anything moves in it."""
        return self.direction is not None or self.turn != 0

    @property
    def part_backwards(self) -> float:
        """Top speed of the part of its velocity that goes backwards (m/s)."""
        return self.speed if self.backwards is None else self.backwards

    def speed_towards(self, direction: float) -> float:
        """Return the top speed (m/s) in a body direction, of a mode that travels in any."""
        part = -math.cos(direction)
        return self.speed if part < 1e-9 else min(self.speed, self.part_backwards / part)


@dataclass(frozen=True)
class Motion:
    """A short motion: whole body-frame displacement ``twist`` (m, m, rad) in ``duration`` (s).

    Parameters
    ----------
    mode
        The mode it ends in; it is driven in that mode, whatever the speed.
    turn_steps
        Change of heading in steps of a full turn over the model's headings.
    enters
        Modes in which it may begin; empty: in any.
    pieces
        Parts of even speed, as shares of the twist and durations (s); empty: it is one part.
    """

    mode: str
    twist: tuple[float, float, float]
    turn_steps: int
    duration: float
    enters: tuple[str, ...] = ()
    pieces: tuple[tuple[float, float], ...] = ()

    @property
    def length(self) -> float:
        """Length (m) of the reference point's way."""
        return math.hypot(self.twist[0], self.twist[1])


@dataclass(frozen=True)
class Curve:
    """A family of analytic curves that reach an exact pose.

    ``reeds_shepp`` drives arcs of ``radius`` (m) and straights along ``direction`` (body-frame
    angle: 0, or pi/2 for transverse curves); ``turn_drive_turn`` turns on the spot, drives
    straight along ``direction`` and turns again; ``slide`` turns on the spot, then drives along
    and across the body in either order, ``sideways`` naming the modes to left and right;
    ``translate`` drives straight in any body direction and turns on the spot before or after,
    or turns evenly on its way.
    ``ahead`` and ``back`` name the modes for straight, left and right; ``spin`` those for
    turning left and right. A way that may not be driven is ``None``.
    """

    family: Literal["reeds_shepp", "turn_drive_turn", "slide", "translate"]
    direction: float
    radius: float
    ahead: tuple[str | None, str | None, str | None]
    back: tuple[str | None, str | None, str | None]
    spin: tuple[str | None, str | None] = (None, None)
    sideways: tuple[str, str] | None = None


@dataclass(frozen=True)
class MotionModel:
    """Modes, motions and curves of one robot type at ``headings`` headings per full turn.

    ``turn_arm`` (m) is the radius of the arc as which turning on the spot is counted in costs
    of length; ``mode_switch`` (s) the standing time of a change of mode. ``acceleration`` and
    ``deceleration`` (m/s^2) are those of the ramps, which curves are driven with too.
    ``has_modes``: changes of mode are seen, and cost what the paper's cost charges for them.
    """

    headings: int
    modes: tuple[Mode, ...]
    motions: tuple[Motion, ...]
    curves: tuple[Curve, ...]
    yaw_rate: float
    turn_arm: float
    mode_switch: float = 0.0
    acceleration: float = math.inf
    deceleration: float = math.inf
    has_modes: bool = False

    def __post_init__(self) -> None:
        names = [mode.name for mode in self.modes]
        if len(set(names)) != len(names):
            raise ValueError("two modes of a motion model have the same name")
        step = 2.0 * math.pi / self.headings
        for motion in self.motions:
            if motion.mode not in names:
                raise ValueError(f"motion in mode {motion.mode!r}, which the model does not have")
            if abs(motion.twist[2] - motion.turn_steps * step) > 1e-9:
                raise ValueError(
                    f"motion in mode {motion.mode!r} turns by {motion.twist[2]:.6f} rad, "
                    f"not by {motion.turn_steps} steps of {step:.6f} rad"
                )
            if motion.duration <= 0.0:
                raise ValueError(f"motion in mode {motion.mode!r} needs a duration above 0")
            if unknown := [name for name in motion.enters if name not in names]:
                raise ValueError(
                    f"motion in mode {motion.mode!r} begins in mode {unknown[0]!r}, which the "
                    "model does not have"
                )
            if not motion.pieces:
                continue
            shares, seconds = (math.fsum(column) for column in zip(*motion.pieces, strict=True))
            if abs(shares - 1.0) > 1e-9 or abs(seconds - motion.duration) > 1e-9:
                raise ValueError(
                    f"the pieces of a motion in mode {motion.mode!r} make {shares:.6f} of it in "
                    f"{seconds:.6f} s, not all of it in {motion.duration:.6f} s"
                )

    @property
    def top_speed(self) -> float:
        """Fastest travel of the reference point (m/s)."""
        return max((mode.speed for mode in self.modes if mode.direction is not None), default=0.0)

    def mode(self, name: str) -> Mode:
        """Return the mode of that name."""
        return next(mode for mode in self.modes if mode.name == name)
