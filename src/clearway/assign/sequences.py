"""Which robot does which orders next, in which order, by ruin and recreate on driving times."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from clearway import _core
from clearway.assign.native import native_costs
from clearway.assign.ruin_recreate import RuinRecreateParams
from clearway.protocols import AssignmentProblem, Weights

Floats = NDArray[np.float64]


def improve_sequences(
    far: Floats,
    at: Sequence[int],
    busy: Sequence[float],
    places: Sequence[int],
    inner: Floats,
    first: Sequence[Sequence[int]],
    weights: Weights,
    params: RuinRecreateParams,
    seed: int,
    due: Floats | None = None,
) -> list[list[int]]:
    """Return better sequences of orders than those to begin with.

    Parameters
    ----------
    far
        Driving times between endpoints (s), ``(endpoints, endpoints)``.
    at, busy
        Endpoint at which each robot will be free, and in how many seconds.
    places
        Endpoint at which each order's shelf is, and is believed to be stored again.
    inner
        Time (s) that each order takes from its shelf on, ``(orders,)``.
    first
        One sequence of order numbers per robot, all orders in them.
    due
        Seconds from now in which each order should be done, ``(orders,)``; infinite: at any time.
        ``weights.tardiness`` is what a second after that costs.
    """
    m, n = len(at), len(places)
    start = far[np.ix_(at, places)] + np.asarray(busy)[:, None]
    problem = AssignmentProblem(
        tuple(map(str, range(m))),
        tuple(map(str, range(n))),
        start,
        far[np.ix_(places, places)],
        np.zeros((m, n)),
        np.zeros((n, n)),
        inner=inner[None, :],
        weights=weights,
        due=np.full(n, np.inf) if due is None else due,
    )
    costs = native_costs(problem)
    return _core.ruin_recreate(costs, [list(route) for route in first], n, params, seed)
