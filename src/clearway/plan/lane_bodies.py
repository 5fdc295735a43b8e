"""Whether bodies fit the cells of a lane grid."""

from clearway.model import Footprint, RobotType
from clearway.world.lane_grid import LaneGrid


def turns_alone(grid: LaneGrid, robot_type: RobotType) -> bool:
    """Return whether a robot that turns keeps its neighbours from turning.

    Squares up to 0.70 of a cell may turn side by side; with larger ones up to 0.82 a robot may
    pass beside another that turns. Where turns take no time nothing is swept.

    Raises
    ------
    ValueError
        If a body leaves its cell while it drives, or reaches its neighbour while it turns.
    """
    shapes = [robot_type.shape(loaded) for loaded in (False, True)]
    side = max(_half_side(shape) for shape in shapes)
    reach = max(shape.circumradius for shape in shapes)
    turns = robot_type.limits.yaw_rate is not None
    if 2.0 * side > grid.cell or (turns and side + reach > grid.cell):
        raise ValueError(
            f"robot type {robot_type.name} is too large for cells of {grid.cell} m: it reaches "
            f"{side:.3f} m to a side and {reach:.3f} m when it turns; shrink it"
        )
    return turns and 2.0 * reach > grid.cell


def _half_side(shape: Footprint) -> float:
    """Return how far a shape reaches along its axes (m)."""
    corners = (abs(value) for part in shape.parts for point in part for value in point)
    return shape.radius or max(corners)
