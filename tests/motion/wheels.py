"""The kinematic equation of the 4WIDS robot, driven by fine steps: the truth for its tables.

Zhang et al., eq. 1: dx = v cos(th) dt, dy = v sin(th) dt, dth = v (2 tan(delta) / L) dt, where
L / (2 tan(delta)) is the turning radius. Extended here by travel across the body, and by
turning on the spot.
"""

import math

from clearway.model import Pose, wrap

# Direction of travel in the body frame; on which side of the body the turn's centre lies.
MEANING = {
    "forward": (0.0, 0),
    "reverse": (math.pi, 0),
    "forward-left": (0.0, 1),
    "forward-right": (0.0, -1),
    "reverse-left": (math.pi, 1),
    "reverse-right": (math.pi, -1),
    "lateral-left": (math.pi / 2.0, 0),
    "lateral-right": (-math.pi / 2.0, 0),
}
SPINS = {"rotate-left": 1, "rotate-right": -1}


def drive(
    start: Pose, mode: str, speed: float, seconds: float, radius: float, steps: int = 2000
) -> Pose:
    """Drive a mode of travel along an arc of ``radius`` (m) if it turns; return the end.

    With the centre on the left the heading rises ahead and falls in reverse.
    """
    direction, side = MEANING[mode]
    sense = 1.0 if math.cos(direction) > 0.0 else -1.0
    yaw = sense * side * speed / radius if side else 0.0
    return integrate(start, direction, speed, yaw, seconds, steps)


def spin(start: Pose, mode: str, yaw_rate: float, seconds: float) -> Pose:
    """Turn on the spot; return the end."""
    return integrate(start, 0.0, 0.0, SPINS[mode] * yaw_rate, seconds, 1)


def integrate(
    start: Pose, direction: float, speed: float, yaw: float, seconds: float, steps: int
) -> Pose:
    """Sum up steps at their middle headings: the error falls with the square of their number."""
    x, y, theta = start
    dt = seconds / steps
    for _ in range(steps):
        course = theta + 0.5 * yaw * dt + direction
        x += speed * math.cos(course) * dt
        y += speed * math.sin(course) * dt
        theta += yaw * dt
    return Pose(x, y, wrap(theta))


def apart(one: Pose, other: Pose) -> float:
    """Largest difference of two poses (m, rad)."""
    turn = abs(wrap(one.theta - other.theta))
    return max(abs(one.x - other.x), abs(one.y - other.y), turn)
