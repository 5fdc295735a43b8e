"""Where a body is and which way it points."""

import math
from typing import NamedTuple


def wrap(angle: float) -> float:
    """Wrap an angle (rad) into (-pi, pi]."""
    wrapped = math.remainder(angle, 2.0 * math.pi)
    return math.pi if wrapped == -math.pi else wrapped


class Pose(NamedTuple):
    """Planar pose: position (m) and heading (rad, counter-clockwise from x)."""

    x: float
    y: float
    theta: float

    def compose(self, local: "Pose") -> "Pose":
        """Return the pose reached from this one by a body-frame pose ``local``."""
        c, s = math.cos(self.theta), math.sin(self.theta)
        return Pose(
            self.x + c * local.x - s * local.y,
            self.y + s * local.x + c * local.y,
            wrap(self.theta + local.theta),
        )

    def distance(self, other: "Pose") -> float:
        """Straight distance between the reference points (m)."""
        return math.hypot(self.x - other.x, self.y - other.y)


def check_pose(pose: Pose, what: str) -> Pose:
    """Return ``pose`` if it is finite, otherwise raise ``ValueError`` naming ``what``."""
    if len(pose) != 3 or not all(math.isfinite(v) for v in pose):
        raise ValueError(f"{what} must be three finite numbers [x, y, theta], got {tuple(pose)}")
    return Pose(*(float(v) for v in pose))
