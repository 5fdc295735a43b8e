"""The cost that system A's paper minimises, of a planned trajectory.

Zhang et al., Sec. 3.2, eq. 21, in a form that does not depend on how finely a motion is
chopped: metres, twice while turning, 3 for each change of moving mode, 0.1 per second of
waiting. Standing turns no wheel, so ``stop`` is no moving mode and service is no waiting.
"""

from clearway.model import RobotType, Trajectory, to_seconds

TURNING, MODE_SWITCH, WAITING = 2.0, 3.0, 0.1


STANDING = "stop"


def paper_cost(
    trajectory: Trajectory, robot_type: RobotType, start_mode: str | None = None
) -> float:
    """Return the cost (m) up to the trajectory's last arrival, of a robot that starts in a mode.

    Turning on the spot counts as an arc of half the body's length.
    """
    arm = robot_type.footprint.length / 2.0
    has_modes = robot_type.kinematics == "four_wheel"
    cost, mode = 0.0, None if start_mode == STANDING else start_mode
    moving = 0
    for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
        turning = piece.twist[2] != 0.0
        length = piece.length or abs(piece.twist[2]) * arm
        cost += length * (TURNING if turning else 1.0)
        if has_modes and mode is not None and piece.mode != mode:
            cost += MODE_SWITCH
        mode = piece.mode
        moving += end - begin
    service = sum(
        stop.leave - stop.arrive for stop in trajectory.stops if stop.leave <= trajectory.end
    )
    return cost + WAITING * to_seconds(trajectory.end - moving - service)
