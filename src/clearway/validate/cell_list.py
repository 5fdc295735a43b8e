"""Cells that a robot comes through, found from its sampled motion alone."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from clearway.world.lane_grid import Cell

DRIVE, STAND, ASTRAY = "drive", "stand", "astray"

LATERAL = 0.01  # how far (cells) from the line through the middles a robot may be
STILL = 1e-5  # less (cells) from sample to sample is no motion
REACHED = 1e-4  # a middle is reached when it is so near (cells)


class Entry(NamedTuple):
    """From ``t_enter`` (s) on a robot has to do with cell (x, y).

    ``drive``: it has set out for its middle, which it reaches at the next entry. ``astray``: it is
    somewhere within, off the lines through the middles. Any other state: it stands in its middle.
    """

    t_enter: float
    x: int
    y: int
    state: str

    @property
    def cell(self) -> Cell:
        """Where it is."""
        return self.x, self.y


class _Run(NamedTuple):
    """Samples of a motion one way along one axis, which are ``at`` so far along it (cells)."""

    t: NDArray[np.float64]
    at: NDArray[np.float64]
    beside: NDArray[np.float64]
    axis: int
    sign: int


def cells_of(t: ArrayLike, x: ArrayLike, y: ArrayLike, side: float) -> list[Entry]:
    """Return the cells that a robot comes through, from middle to middle.

    A robot that passes a middle without stopping has no entry for standing there; one that stops
    between two middles goes on driving.

    Parameters
    ----------
    t
        Shape ``(n,)``, s, not falling; motion is linear between samples.
    x, y
        Shape ``(n,)``, m, of the reference point.
    side
        Of a cell (m); the middle of cell (0, 0) lies at half of it.
    """
    times = np.asarray(t, np.float64)
    middles = np.stack([np.asarray(x), np.asarray(y)]) / side - 0.5
    cell = _nearest(middles[:, 0])
    stands = bool(np.abs(middles[:, 0] - cell).max() <= LATERAL)
    entries = [Entry(float(times[0]), *cell, STAND if stands else ASTRAY)]
    for run in _runs(times, middles):
        _follow(entries, run)
    return entries


def _nearest(at: NDArray[np.float64]) -> Cell:
    return round(float(at[0])), round(float(at[1]))


def _runs(t: NDArray[np.float64], middles: NDArray[np.float64]) -> Iterator[_Run]:
    steps = np.diff(middles, axis=1)
    axis = np.abs(steps).argmax(axis=0)
    along = np.take_along_axis(steps, axis[None, :], axis=0)[0]
    label = np.where(np.abs(along) <= STILL, 0, np.sign(along) * (axis + 1)).astype(int)
    bounds = np.flatnonzero(np.diff(label)) + 1
    for first, end in zip([0, *bounds], [*bounds, len(label)], strict=True):
        if first < end and label[first]:
            k, part = int(abs(label[first])) - 1, np.s_[first : end + 1]
            sign = 1 if label[first] > 0 else -1
            yield _Run(t[part], middles[k][part], middles[1 - k][part], k, sign)


def _follow(entries: list[Entry], run: _Run) -> None:
    """Add what a run passes to what was before."""
    line = round(float(run.beside[0]))
    last = entries[-1]
    at = last.cell[run.axis]
    if last.state == DRIVE:
        # On its way to a middle it must go on.
        before = entries[-2].cell
        on_its_way = at - before[run.axis] == run.sign
        aim = at
    else:
        on_its_way = last.state == STAND and abs(float(run.at[0]) - at) <= LATERAL
        aim = at + run.sign
    on_its_way = on_its_way and last.cell[1 - run.axis] == line
    if not on_its_way or np.abs(run.beside - line).max() > LATERAL:
        _lose(entries, run)
        return
    if last.state != DRIVE:
        if entries[-1].t_enter >= run.t[0] and len(entries) > 1:
            entries.pop()  # it has not stopped
        entries.append(_entry(run, float(run.t[0]), aim, line, DRIVE))
    # Rounding may bring a sample back a little within a run; times never fall.
    reach = np.maximum.accumulate(run.at * run.sign)
    end = float(reach[-1]) + REACHED
    while aim * run.sign <= end:
        time = float(np.interp(aim * run.sign, reach, run.t))
        goes_on = (aim * run.sign) + REACHED < float(reach[-1])
        aim_next = aim + run.sign if goes_on else aim
        entries.append(_entry(run, time, aim_next, line, DRIVE if goes_on else STAND))
        if not goes_on:
            break
        aim = aim_next


def _lose(entries: list[Entry], run: _Run) -> None:
    """Note a run off the lines; where it ends in a middle, the robot is found again."""
    end = (float(run.at[-1]), float(run.beside[-1]))
    at, beside = (round(value) for value in end)
    start = round(float(run.at[0])), round(float(run.beside[0]))
    entries.append(_entry(run, float(run.t[0]), *start, ASTRAY))
    if math.dist(end, (at, beside)) <= LATERAL:
        entries.append(_entry(run, float(run.t[-1]), at, beside, STAND))


def _entry(run: _Run, t: float, at: int, beside: int, state: str) -> Entry:
    return Entry(t, *((at, beside) if run.axis == 0 else (beside, at)), state)


def step_between(a: Cell, b: Cell) -> Cell:
    """Return by how many cells one lies east and north of the other."""
    return b[0] - a[0], b[1] - a[1]
