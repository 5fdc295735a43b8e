"""How particles fly: eq. 16 on coordinates that are task numbers."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from clearway.assign.parameters import check_amount

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Coefficients:
    """What moves a particle, w, c1 and c2 in the paper.

    Parameters
    ----------
    inertia
        Share of its velocity that it keeps; above 1 it speeds up.
    cognitive
        Pull of its own best; more searches near it.
    social
        Pull of the swarm's best; more draws all together sooner.
    """

    inertia: float = 0.7298
    cognitive: float = 1.49618
    social: float = 1.49618

    def __post_init__(self) -> None:
        for name in ("inertia", "cognitive", "social"):
            check_amount(name, getattr(self, name))


@dataclass(frozen=True)
class FlightParams:
    """Choices of A-9 and A-11 that the paper leaves open.

    Parameters
    ----------
    position
        Moved by the velocity before the step, as ``printed``, or after it, as in a
        ``textbook``.
    velocity_bound
        Most task numbers that a coordinate moves in a step; infinite for no bound.
    """

    position: Literal["printed", "textbook"] = "printed"
    velocity_bound: float = math.inf

    def __post_init__(self) -> None:
        if self.position not in ("printed", "textbook"):
            raise ValueError(f"position must be printed or textbook, got {self.position!r}")
        if not self.velocity_bound >= 0.0:
            raise ValueError(f"velocity_bound must be 0 or above, got {self.velocity_bound}")


def fly(
    rng: np.random.Generator,
    params: FlightParams,
    coefficients: Coefficients,
    positions: Ints,
    velocities: Floats,
    bests: Ints,
    leader: Ints,
) -> tuple[Floats, Floats]:
    """Return moved positions, within [0, length - 1] but neither whole nor mended, and velocities.

    ``positions``, ``velocities`` and ``bests`` have shape ``(N, length)``, the leader, which
    is the swarm's best, ``(length,)``. Every coordinate draws random numbers of its own.
    """
    own, common = rng.random((2, *positions.shape))
    after = (
        coefficients.inertia * velocities
        + coefficients.cognitive * own * (bests - positions)
        + coefficients.social * common * (leader - positions)
    )
    after = np.clip(after, -params.velocity_bound, params.velocity_bound)
    moved = positions + (velocities if params.position == "printed" else after)
    return np.clip(moved, 0.0, max(positions.shape[1] - 1, 0)), after
