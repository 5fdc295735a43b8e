"""How far a robot has driven, and how long it has stood, up to any moment of a trace."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from clearway.metrics.motion import REST, step_kinds, step_lengths
from clearway.model import Track

Floats = NDArray[np.float64]
Span = tuple[float, float]


class Course:
    """Sums over a robot's track, from second 0 to ``end`` (s) or its last sample."""

    def __init__(self, track: Track, end: float) -> None:
        self._t = np.append(track.t, max(float(track.t[-1]), end))
        stands = np.append(step_kinds(track) == REST, True)
        self._stood = _sums(np.diff(self._t) * stands)
        self._driven = _sums(np.append(step_lengths(track), 0.0))

    @property
    def distance(self) -> float:
        """All that it drives (m)."""
        return float(self._driven[-1])

    def driven(self, spans: Floats) -> float:
        """Return how far (m) it drives in spans of time, shape ``(n, 2)``."""
        return self._over(self._driven, spans)

    def stood(self, spans: Floats) -> float:
        """Return how long (s) it stands in spans of time, shape ``(n, 2)``."""
        return self._over(self._stood, spans)

    def _over(self, sums: Floats, spans: Floats) -> float:
        return float(np.diff(np.interp(spans, self._t, sums), axis=1).sum())


def spans_of(pairs: Iterable[Span]) -> Floats:
    """Return spans of time (s) as an array of shape ``(n, 2)``."""
    return np.array(list(pairs), dtype=np.float64).reshape(-1, 2)


def common(some: Floats, others: Floats) -> Floats:
    """Return the spans that lie in both of two sets of spans, shape ``(n, 2)``."""
    begin = np.maximum(some[:, None, 0], others[None, :, 0])
    end = np.minimum(some[:, None, 1], others[None, :, 1])
    return np.stack([begin, end], axis=-1)[end > begin]


def _sums(values: Floats) -> Floats:
    return np.concatenate([[0.0], np.cumsum(values)])
