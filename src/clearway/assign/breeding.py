"""Children of a swarm: whose they are, and which of them take a particle's place."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from clearway.assign.parameters import check_share
from clearway.assign.permutation import crossover, mutate

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class BreedingParams:
    """Choices of A-13 to A-15 that the paper leaves open.

    Parameters
    ----------
    parents
        Cross the particles' ``bests`` so far or the ``positions`` they have moved to.
    survival
        A child takes its particle's place if it is ``better`` than the position there, or
        ``always``.
    p_crossover
        Share of pairs that exchange fragments; more mix the swarm faster.
    p_mutation
        Share of children in which two tasks change places; more scatter it.
    """

    parents: Literal["bests", "positions"] = "bests"
    survival: Literal["better", "always"] = "better"
    p_crossover: float = 1.0
    p_mutation: float = 0.1

    def __post_init__(self) -> None:
        for name, known in (
            ("parents", ("bests", "positions")),
            ("survival", ("better", "always")),
        ):
            if getattr(self, name) not in known:
                raise ValueError(
                    f"{name} must be {' or '.join(known)}, got {getattr(self, name)!r}"
                )
        check_share("p_crossover", self.p_crossover)
        check_share("p_mutation", self.p_mutation)


# The two readings of the paper: children must be better, or Algorithm 1 to the letter.
ELITIST = BreedingParams()
LITERAL = BreedingParams(parents="positions", survival="always")


def breed(
    rng: np.random.Generator,
    params: BreedingParams,
    positions: Ints,
    bests: Ints,
    price: Callable[[Ints], Floats],
) -> tuple[Ints, Floats]:
    """Return what stands in each particle's place after breeding, and its value.

    Positions are priced only where children have to be better than they are.
    """
    parents = bests if params.parents == "bests" else positions
    children = mutate(rng, crossover(rng, parents, params.p_crossover), params.p_mutation)
    value = price(children)
    if params.survival == "always":
        return children, value
    before = price(positions)
    is_better = value < before
    return np.where(is_better[:, None], children, positions), np.where(is_better, value, before)
