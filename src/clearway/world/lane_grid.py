"""Square cells with lanes: where grid robots drive, in which directions, and where they stop."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.model import Pose

Cell = tuple[int, int]  # (x, y), y upward

# Directions of a step, as bits of `LaneGrid.lanes`, counter-clockwise from x.
EAST, NORTH, WEST, SOUTH = 1, 2, 4, 8
STEPS: Mapping[int, Cell] = {EAST: (1, 0), NORTH: (0, 1), WEST: (-1, 0), SOUTH: (0, -1)}

# Regions (paper B, Sec. 5.3): N endpoint, H and L channels, T and R crossings.
VOID, ENDPOINT, HORIZONTAL, LONGITUDINAL, T_CROSSING, CROSSING = range(6)


@dataclass(frozen=True)
class Endpoint:
    """A cell off the channels that one robot at a time owns.

    ``kind`` is ``shelf`` (a place for one), ``station``, ``charger`` or ``parking``.
    """

    name: str
    kind: str
    cell: Cell


@dataclass(frozen=True, eq=False)
class LaneGrid:
    """Channel cells with lanes, and endpoints beside them.

    Parameters
    ----------
    cell
        Side of a cell (m); the centre of cell (x, y) lies at ``((x + 0.5) cell, (y + 0.5) cell)``.
    region
        Shape ``(height, width)``, indexed ``[y, x]``: one of the regions above.
    lanes
        Shape ``(height, width)``: bits of the directions in which traffic leaves a channel cell;
        0 elsewhere. A step follows a lane if the cell that it leaves has its bit and it leads
        to a channel cell.
    endpoints
        By name. A robot enters and leaves one across any side that it shares with a channel.
    """

    name: str
    cell: float
    region: NDArray[np.int8]
    lanes: NDArray[np.uint8]
    endpoints: Mapping[str, Endpoint]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (cells)."""
        height, width = self.region.shape
        return width, height

    def is_channel(self, cell: Cell) -> bool:
        """Whether traffic passes there."""
        x, y = cell
        width, height = self.size
        return 0 <= x < width and 0 <= y < height and int(self.region[y, x]) >= HORIZONTAL

    def centre(self, cell: Cell, theta: float = 0.0) -> Pose:
        """Return the pose at the middle of a cell."""
        return Pose((cell[0] + 0.5) * self.cell, (cell[1] + 0.5) * self.cell, theta)

    def cell_at(self, pose: Pose) -> Cell:
        """Return the cell that a pose lies in."""
        return int(pose.x // self.cell), int(pose.y // self.cell)

    def of_kind(self, kind: str) -> tuple[Endpoint, ...]:
        """Return the endpoints of one kind, in the order given."""
        return tuple(point for point in self.endpoints.values() if point.kind == kind)

    def entrances(self, cell: Cell) -> tuple[Cell, ...]:
        """Return the channel cells beside an endpoint, east, north, west, south."""
        beside = ((cell[0] + dx, cell[1] + dy) for dx, dy in STEPS.values())
        return tuple(other for other in beside if self.is_channel(other))
