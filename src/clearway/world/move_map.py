"""Moves between cells as bits: which are legal out of each."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from clearway.world.lane_grid import EAST, HORIZONTAL, NORTH, SOUTH, STEPS, WEST, LaneGrid

# Shape (height, width): bits of the directions in which a robot may move on.
MoveMap = NDArray[np.uint8]


def moves_into(free: NDArray[np.bool_]) -> MoveMap:
    """Return the moves that lead to free cells; ``free`` has shape ``(height, width)``."""
    moves = np.zeros(free.shape, np.uint8)
    moves[:, :-1] |= free[:, 1:] * np.uint8(EAST)
    moves[:-1, :] |= free[1:, :] * np.uint8(NORTH)
    moves[:, 1:] |= free[:, :-1] * np.uint8(WEST)
    moves[1:, :] |= free[:-1, :] * np.uint8(SOUTH)
    return moves


def moves_along_lanes(grid: LaneGrid) -> MoveMap:
    """Return the moves from channel cells to channel cells that follow a lane."""
    return grid.lanes & moves_into(grid.region >= HORIZONTAL)


def cut_off(grid: LaneGrid) -> NDArray[np.bool_]:
    """Mark channel cells outside the largest part whose cells lanes all connect, both ways.

    Returns
    -------
    Shape ``(height, width)``.
    """
    channel = grid.region >= HORIZONTAL
    moves = moves_along_lanes(grid).ravel()
    ahead = {bit: dy * grid.size[0] + dx for bit, (dx, dy) in STEPS.items()}
    tails = {bit: np.flatnonzero(moves & bit) for bit in ahead}
    tail = np.concatenate([tails[bit] for bit in ahead])
    head = np.concatenate([tails[bit] + ahead[bit] for bit in ahead])
    graph = coo_array((np.ones(len(tail)), (tail, head)), shape=(moves.size, moves.size))
    parts = connected_components(graph, connection="strong")[1].reshape(channel.shape)
    outside: NDArray[np.bool_] = parts != np.bincount(parts[channel]).argmax()
    return channel & outside
