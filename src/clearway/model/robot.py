"""Robot types with their limits, and the robots of a fleet."""

import math
from dataclasses import dataclass, field
from typing import Literal

from clearway.model.footprint import Footprint
from clearway.model.pose import Pose, check_pose

Kinematics = Literal["ackermann", "four_wheel", "differential", "holonomic"]
KINEMATICS: tuple[Kinematics, ...] = ("ackermann", "four_wheel", "differential", "holonomic")

FOUR_WHEEL_MODES = (
    "stop",
    "forward",
    "reverse",
    "forward-left",
    "forward-right",
    "reverse-left",
    "reverse-right",
    "lateral-left",
    "lateral-right",
    "rotate-left",
    "rotate-right",
)


@dataclass(frozen=True)
class Limits:
    """What a robot type cannot exceed; ``None`` does not bind.

    Parameters
    ----------
    speed
        Top speed of the reference point (m/s).
    reverse_speed
        Top speed backwards (m/s); ``None``: ``speed`` binds both ways; 0 forbids reversing.
    yaw_rate
        Turning rate (rad/s).
    turning_radius
        Least radius of the reference point's arc (m).
    acceleration, deceleration
        Along the path (m/s^2).
    """

    speed: float
    reverse_speed: float | None = None
    yaw_rate: float | None = None
    turning_radius: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None

    def __post_init__(self) -> None:
        for name in ("speed", "yaw_rate", "turning_radius", "acceleration", "deceleration"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} must be above 0 and finite, got {value}")
        if self.reverse_speed is not None and not (
            math.isfinite(self.reverse_speed) and self.reverse_speed >= 0.0
        ):
            raise ValueError(f"reverse_speed must be 0 or above, got {self.reverse_speed}")

    @property
    def has_ramps(self) -> bool:
        """Whether speed takes time to change."""
        return self.acceleration is not None or self.deceleration is not None

    @property
    def speed_backwards(self) -> float:
        """Top speed in reverse (m/s)."""
        return self.speed if self.reverse_speed is None else self.reverse_speed


@dataclass(frozen=True)
class Battery:
    """Energy store of a robot type.

    ``capacity`` is the running time on a full charge (s). A robot seeks a charger
    below ``reserve`` (fraction of capacity); too low strands it in a queue. It charges up to
    ``full`` (fraction); ``charging`` is the time (s) from empty to capacity.
    """

    capacity: float
    reserve: float = 0.2
    charging: float = 500.0
    full: float = 0.95

    def __post_init__(self) -> None:
        if not (math.isfinite(self.capacity) and self.capacity > 0.0):
            raise ValueError(f"capacity must be above 0 and finite, got {self.capacity}")
        if not (math.isfinite(self.charging) and self.charging > 0.0):
            raise ValueError(f"charging must be above 0 and finite, got {self.charging}")
        if not 0.0 <= self.reserve < 1.0:
            raise ValueError(f"reserve must be in [0, 1), got {self.reserve}")
        if not self.reserve < self.full <= 1.0:
            raise ValueError(f"full must be above reserve and at most 1, got {self.full}")


@dataclass(frozen=True)
class RobotType:
    """What all robots of one make share.

    Parameters
    ----------
    loaded_footprint
        Shape while carrying; ``None``: the same as empty.
    clearance
        Gap (m) planned for on top of the footprint wherever the scenario's own poses leave it.
    motion
        Name of its motion model, one of `clearway.motion.MODELS`; ``None``: the kinematics'.
    modes
        Motion modes that may be used; empty: all that the kinematics knows.
    mode_switch
        Time at rest (s) that a change of moving mode takes.
    capacity
        Number of loads carried at once.
    """

    name: str
    footprint: Footprint
    kinematics: Kinematics
    limits: Limits
    loaded_footprint: Footprint | None = None
    clearance: float = 0.0
    modes: tuple[str, ...] = ()
    mode_switch: float = 0.0
    capacity: int = 1
    capabilities: frozenset[str] = field(default_factory=frozenset)
    battery: Battery | None = None
    motion: str | None = None

    def __post_init__(self) -> None:
        if self.kinematics not in KINEMATICS:
            raise ValueError(
                f"kinematics must be one of {', '.join(KINEMATICS)}, got {self.kinematics!r}"
            )
        for name in ("clearance", "mode_switch"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f"{name} must be 0 or above and finite, got {value}")
        if self.modes and self.kinematics != "four_wheel":
            raise ValueError("modes belong to four_wheel robots only")
        for mode in self.modes:
            if mode not in FOUR_WHEEL_MODES:
                raise ValueError(f"unknown mode {mode!r}; known: {', '.join(FOUR_WHEEL_MODES)}")
        if self.capacity < 0:
            raise ValueError(f"capacity must be 0 or above, got {self.capacity}")

    def shape(self, loaded: bool) -> Footprint:
        """Return the footprint with or without a load."""
        return self.loaded_footprint if loaded and self.loaded_footprint else self.footprint


@dataclass(frozen=True)
class Robot:
    """One robot and its start; ``start_speed`` (m/s) and ``start_mode`` where it is moving.

    ``energy`` is the level of its battery at the start, in [0, 1].
    """

    id: str
    type: str
    start: Pose
    start_speed: float = 0.0
    start_mode: str | None = None
    energy: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", check_pose(self.start, f"start of robot {self.id}"))
        if not 0.0 <= self.energy <= 1.0:
            raise ValueError(f"energy of robot {self.id} must be in [0, 1], got {self.energy}")
