"""Charts drawn with matplotlib, on light and on dark ground."""

import io
import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from clearway.plot.palette import line_colour
from clearway.study.findings import Chart, Panel

# Inches of a panel beside others, of one alone, and of one above others.
PANEL, ONE_PANEL, WIDE_PANEL = (5.6, 3.7), (8.0, 4.4), (11.0, 2.7)
DOTS = 130
MARKS = "osD^vPX"
# A line of more points than this has no marks and no bars.
MOST_MARKS = 20


@dataclass(frozen=True)
class Ground:
    """Colours of page, letters and lines."""

    page: str
    ink: str
    faint: str
    is_dark: bool


LIGHT = Ground("#ffffff", "#161b22", "#dde1e7", False)
DARK = Ground("#171c22", "#e7eaee", "#333c46", True)


def draw(chart: Chart, ground: Ground = LIGHT) -> bytes:
    """Return a chart as PNG; the same chart gives the same bytes."""
    columns = min(chart.columns, len(chart.panels))
    rows = math.ceil(len(chart.panels) / columns)
    width, height = ONE_PANEL if rows == columns == 1 else WIDE_PANEL if columns == 1 else PANEL
    figure = Figure(
        figsize=(width * columns, height * rows + 0.7),
        dpi=DOTS,
        layout="constrained",
        facecolor=ground.page,
    )
    named = {}
    for number, panel in enumerate(chart.panels, start=1):
        axes = figure.add_subplot(rows, columns, number)
        _dress(axes, panel, ground)
        _draw(axes, panel, ground)
        handles, labels = axes.get_legend_handles_labels()
        named.update(dict(zip(labels, handles, strict=True)))
    figure.suptitle(_plain(chart.title), color=ground.ink, fontsize=13)
    if named:
        figure.legend(
            named.values(),
            named,
            loc="outside lower center",
            ncols=_columns(named, width * columns),
            frameon=False,
            labelcolor=ground.ink,
            fontsize=9.5,
        )
    content = io.BytesIO()
    figure.savefig(content, format="png", metadata={"Software": None})
    return content.getvalue()


def _columns(labels: Collection[str], inches: float) -> int:
    """Return how many labels stand side by side; each has a column as wide as the widest."""
    widest = 0.6 + 0.075 * max(len(label) for label in labels)
    return max(1, min(len(labels), int(inches / widest)))


def _dress(axes: Axes, panel: Panel, ground: Ground) -> None:
    axes.set_facecolor(ground.page)
    axes.set_xlabel(_plain(panel.x_label), color=ground.ink)
    axes.set_ylabel(_plain(panel.y_label), color=ground.ink)
    axes.set_title(_plain(panel.title), color=ground.ink, fontsize=11, loc="left")
    axes.tick_params(colors=ground.ink)
    axes.grid(axis="y", color=ground.faint, linewidth=0.8)
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(ground.ink)
    if panel.log:
        axes.set_yscale("log")
    if panel.ticks:
        places, names = zip(*panel.ticks, strict=True)
        axes.set_xticks(places, [_plain(name) for name in names])


def _draw(axes: Axes, panel: Panel, ground: Ground) -> None:
    shifts = _shifts(panel)
    for series, shift in zip(panel.series, shifts, strict=True):
        colour = line_colour(series.colour, ground.is_dark)
        x, y = np.array(series.x) + shift, _drawn(series.y)
        bars = np.abs([y - _drawn(series.low), _drawn(series.high) - y]) if series.low else None
        name, mark = _plain(series.label), MARKS[series.colour % len(MARKS)]
        if series.style == "paper":
            axes.plot(x, y, "D", mfc="none", mec=ground.ink, mew=1.5, ms=7, label=name, zorder=5)
        elif len(x) > MOST_MARKS and series.style == "line":
            axes.plot(x, y, color=colour, lw=1.7, label=name, zorder=3)
        else:
            axes.errorbar(
                x,
                y,
                bars,
                fmt=mark if series.style == "points" else f"{mark}-",
                color=colour,
                lw=1.5,
                elinewidth=1.1,
                capsize=2.5,
                ms=5,
                label=name,
                zorder=4,
            )
    _shade(axes, panel, ground)
    if panel.from_zero:
        axes.set_ylim(bottom=0.0)


def _shade(axes: Axes, panel: Panel, ground: Ground) -> None:
    """Shade the spans; of words that would cover each other only the first is written."""
    low, high = axes.get_xlim()
    written = low - (high - low)
    for span in panel.spans:
        axes.axvspan(span.begin, span.end, color=ground.ink, alpha=0.12, linewidth=0)
        middle = 0.5 * (span.begin + span.end)
        if middle - written > 0.025 * (high - low):
            written = middle
            axes.annotate(
                _plain(span.label),
                (middle, 0.98),
                xycoords=("data", "axes fraction"),
                ha="center",
                va="top",
                rotation=90,
                color=ground.ink,
                fontsize=8,
                path_effects=[withStroke(linewidth=2.5, foreground=ground.page)],
                zorder=6,
            )


def _shifts(panel: Panel) -> list[float]:
    """Return by how much each series is moved along x, so that intervals stand side by side."""
    places = np.unique([x for series in panel.series for x in series.x])
    beside = [bool(series.low) and len(series.x) <= MOST_MARKS for series in panel.series]
    count = sum(beside)
    if count < 2 or len(places) < 2:
        return [0.0] * len(panel.series)
    step = min(0.05, 0.5 / count) * float(np.diff(places).min())
    order = np.cumsum(beside) - 1
    return [
        step * (float(number) - 0.5 * (count - 1)) if moved else 0.0
        for number, moved in zip(order, beside, strict=True)
    ]


def _drawn(values: tuple[float, ...]) -> NDArray[np.float64]:
    """Return values with gaps where they are infinite."""
    array = np.array(values, dtype=np.float64)
    return np.where(np.isfinite(array), array, np.nan)


def _plain(text: str) -> str:
    """Return text in which no dollar begins a formula."""
    return text.replace("$", r"\$")
