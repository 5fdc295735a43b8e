"""Tracks made small: whole millimetres, and only the samples that a straight line misses."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.model import Track

Floats = NDArray[np.float64]

# With rounding to 1 mm on two axes this keeps the replay within 5 mm and 0.5 degree.
POSITION_ERROR = 0.0023
HEADING_ERROR = 0.0075
# At a speed that is even to this (m/s, rad/s), samples go unlooked at for so many steps of 0.1 s:
# they lie within 0.5 mm and 0.5 mrad of the line.
_EVEN = 1e-4
_UNLOOKED = 50


@dataclass(frozen=True)
class ThinTrack:
    """Kept samples as whole numbers: milliseconds, millimetres, milliradians (unwrapped).

    Each list begins with a value and goes on with differences.
    """

    t: list[int]
    x: list[int]
    y: list[int]
    theta: list[int]


def thin(track: Track) -> ThinTrack:
    """Keep the samples between which the rest lie, to within 5 mm and 0.5 degree."""
    heading = np.unwrap(track.theta)
    channels = (track.x, track.y, heading)
    looked = _changes(track.t, channels)
    kept = looked[
        _corners(
            track.t[looked].tolist(),
            tuple(values[looked].tolist() for values in channels),
            (POSITION_ERROR, POSITION_ERROR, HEADING_ERROR),
        )
    ]

    def steps(values: Floats) -> list[int]:
        whole = np.rint(values[kept] * 1000.0).astype(np.int64)
        differences: list[int] = np.diff(whole, prepend=0).tolist()
        return differences

    return ThinTrack(steps(track.t), steps(track.x), steps(track.y), steps(heading))


def _changes(times: Floats, channels: tuple[Floats, ...]) -> NDArray[np.intp]:
    """Return the samples at which a speed changes, and every so many between."""
    step = np.diff(times)
    is_kept = np.ones(len(times), dtype=bool)
    is_kept[1:-1] = (step[:-1] <= 0.0) | (step[1:] <= 0.0) | (step[:-1] > 0.2)
    is_kept[::_UNLOOKED] = True
    for values in channels:
        speed = np.diff(values) / np.where(step > 0.0, step, 1.0)
        band = np.rint(speed / _EVEN)
        is_kept[1:-1] |= band[1:] != band[:-1]
    return np.flatnonzero(is_kept)


def _corners(
    times: list[float], channels: tuple[list[float], ...], errors: tuple[float, ...]
) -> list[int]:
    """Return the samples to keep, the first and the last among them.

    The swinging door: from the last kept sample, each later one leaves through a window of
    slopes that closes as samples go by; where a sample no longer fits through, the one
    before it is kept. Linear in time.
    """
    kept = [0]
    low, high = [-np.inf] * len(channels), [np.inf] * len(channels)
    for now in range(1, len(times)):
        anchor = kept[-1]
        if now - 1 > anchor:
            span = times[now] - times[anchor]
            fits = span > 0.0 and all(
                low[i] <= (values[now] - values[anchor]) / span <= high[i]
                for i, values in enumerate(channels)
            )
            if not fits:
                anchor = now - 1
                kept.append(anchor)
                low, high = [-np.inf] * len(channels), [np.inf] * len(channels)
        span = times[now] - times[anchor]
        if span <= 0.0:  # a jump: two poses at one time
            kept.append(now)
            low, high = [-np.inf] * len(channels), [np.inf] * len(channels)
            continue
        for i, values in enumerate(channels):
            rise = values[now] - values[anchor]
            low[i] = max(low[i], (rise - errors[i]) / span)
            high[i] = min(high[i], (rise + errors[i]) / span)
    if kept[-1] != len(times) - 1:
        kept.append(len(times) - 1)
    return kept
