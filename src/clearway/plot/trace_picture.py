"""A still picture of a run: where its robots drove, and how often, as PNG."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.ticker import LogLocator
from numpy.typing import NDArray

from clearway.model import Pose, Robot, Site, Trace, Track, tracks_of
from clearway.plot.palette import robot_colour
from clearway.plot.picture import axes_of, save, title
from clearway.plot.scenery import draw_body, draw_floor, write

# Cells along the longer side of the site.
_CELLS = 220
_TRAFFIC = LinearSegmentedColormap.from_list("traffic", ["#d9e8f5", "#3b8ac4", "#08306b"])


def draw_trace(trace: Trace, path_png: Path) -> None:
    """Draw how often each part of the floor was passed, and where the robots stand in the end.

    The picture is 1600 pixels wide; the same trace gives the same bytes.
    """
    axes = axes_of(trace.site)
    draw_floor(axes, trace.site)
    tracks = tracks_of(trace)
    _draw_traffic(axes, trace.site, list(tracks.values()))
    for index, robot in enumerate(trace.robots):
        track = tracks[robot.id]
        last = Pose(float(track.x[-1]), float(track.y[-1]), float(track.theta[-1]))
        shape = trace.robot_types[robot.type].footprint
        draw_body(axes, shape, last, robot_colour(index), filled=True, order=5)
        write(axes, last.x, last.y, _label(robot, trace), 7.5)
    title(axes, trace.scenario, _told(trace))
    save(axes, path_png)


def passages(site: Site, tracks: list[Track]) -> tuple[NDArray[np.float64], float]:
    """Return how often reference points passed each cell, indexed ``[y, x]``, and its side (m).

    A point that goes straight through a cell passes it once; one that turns back within, once
    for each cell's length driven.
    """
    (left, right), (low, high) = ((min(v), max(v)) for v in zip(*site.bounds, strict=True))
    side = max(right - left, high - low) / _CELLS
    shape = (int(np.ceil((high - low) / side)), int(np.ceil((right - left) / side)))
    counts = np.zeros(shape)
    for track in tracks:
        lengths = np.hypot(np.diff(track.x), np.diff(track.y))
        # Steps are cut so that none leaves out a cell that it crosses for long.
        parts = np.maximum(1, np.ceil(lengths / (0.25 * side))).astype(int)
        step = np.repeat(np.arange(len(lengths)), parts)
        rank = np.arange(len(step)) - np.repeat(np.cumsum(parts) - parts, parts)
        share = (rank + 0.5) / parts[step]
        x = track.x[step] + share * np.diff(track.x)[step]
        y = track.y[step] + share * np.diff(track.y)[step]
        column = np.clip(((x - left) / side).astype(int), 0, shape[1] - 1)
        row = np.clip(((y - low) / side).astype(int), 0, shape[0] - 1)
        np.add.at(counts, (row, column), (lengths / parts)[step] / side)
    return counts, side


def _draw_traffic(axes: Axes, site: Site, tracks: list[Track]) -> None:
    counts, side = passages(site, tracks)
    if counts.max() < 0.5:
        return
    left, low = (min(values) for values in zip(*site.bounds, strict=True))
    rows, columns = counts.shape
    picture = axes.imshow(
        np.ma.masked_less(counts, 0.5),
        origin="lower",
        extent=(left, left + columns * side, low, low + rows * side),
        cmap=_TRAFFIC,
        norm=LogNorm(vmin=0.5, vmax=max(counts.max(), 1.0)),
        interpolation="nearest",
        zorder=1.5,
        aspect="equal",
    )
    figure = axes.get_figure(root=True)
    assert figure is not None
    ticks = LogLocator(subs=(1.0, 2.0, 5.0))
    bar = figure.colorbar(picture, ax=axes, shrink=0.6, pad=0.01, format="%g", ticks=ticks)
    bar.ax.minorticks_off()
    bar.set_label("passages")


def _label(robot: Robot, trace: Trace) -> str:
    """Return what tells a robot's id from the others': without the word all begin with."""
    heads = {other.id.rpartition("-")[0] for other in trace.robots}
    head, _, tail = robot.id.rpartition("-")
    return tail if len(heads) == 1 and head else robot.id


def _told(trace: Trace) -> str:
    orders = {event["order"]: event["state"] for event in trace.of("order")}
    done = sum(state == "done" for state in orders.values())
    end = max((float(np.max(event["t"])) for event in trace.events), default=0.0)
    return f"{len(trace.robots)} robots, {done} of {len(orders)} orders done in {end:.0f} s"
