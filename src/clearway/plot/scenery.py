"""Floors and bodies drawn with matplotlib, all lengths in metres."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle, Patch
from matplotlib.patches import Polygon as Outline
from matplotlib.patheffects import withStroke

from clearway.model import Footprint, Obstacle, Pose, Site, Zone

INK = "#161b22"
MUTED = "#535d6a"
# Where a site has more zones, names that do not fit would hide each other.
_FEW_ZONES = 40
# Widths of a letter of a zone's name, and of the picture (points).
_LETTER = 4.8
_PICTURE = 1000.0
_HALO = [withStroke(linewidth=2.6, foreground="white")]


def draw_floor(axes: Axes, site: Site) -> None:
    """Draw bounds, zones with their names, and obstacles."""
    xs, ys = (np.array(values) for values in zip(*site.bounds, strict=True))
    axes.set_facecolor("#eceef2")
    axes.add_patch(Outline(site.bounds, facecolor="white", edgecolor="none", zorder=0))
    for faint, zones in (
        ("#f6ddd0", [zone for zone in site.zones if zone.kind == "closed"]),
        ("#e6f0f7", [zone for zone in site.zones if zone.kind != "closed"]),
    ):
        areas = PolyCollection([zone.polygon for zone in zones], facecolor=faint)
        areas.set(edgecolor="#6f9dbd", linestyle="--", zorder=1)
        axes.add_collection(areas, autolim=False)
    for zone in site.zones:
        if len(site.zones) <= _FEW_ZONES or _fits(zone, float(np.ptp(xs))):
            x, y = np.mean(zone.polygon, axis=0)
            name = zone.name.replace("$", r"\$")
            # Without a rim, which takes most of the time where there are hundreds.
            axes.text(x, y, name, size=8, color="#3d6280", ha="center", va="center", zorder=2)
    for obstacle in site.obstacles:
        axes.add_patch(_obstacle(obstacle))
    axes.add_patch(Outline(site.bounds, fill=False, edgecolor="#77818e", linewidth=1.6, zorder=2))
    margin = 0.015 * max(np.ptp(xs), np.ptp(ys))
    axes.set_xlim(xs.min() - margin, xs.max() + margin)
    axes.set_ylim(ys.min() - margin, ys.max() + margin)
    axes.set_aspect("equal")
    axes.set_xlabel("x (m)", color=MUTED)
    axes.set_ylabel("y (m)", color=MUTED)
    axes.tick_params(colors=MUTED)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _fits(zone: Zone, width: float) -> bool:
    """Whether a zone's name lies within it where the site is ``width`` wide (m)."""
    xs = [x for x, _ in zone.polygon]
    return _LETTER * len(zone.name) * width < (max(xs) - min(xs)) * _PICTURE


def draw_body(
    axes: Axes, shape: Footprint, pose: Pose, colour: str, filled: bool, order: int = 4
) -> None:
    """Draw a body at a pose with a triangle at its front; not filled, its edge is dashed."""
    for patch in _body(shape, pose):
        patch.set(
            facecolor=colour if filled else "none",
            edgecolor=INK if filled else colour,
            linewidth=1.2 if filled else 1.5,
            linestyle="-" if filled else (0, (3, 1.5)),
            zorder=order,
        )
        axes.add_patch(patch)
    front = shape.radius or max(x for part in shape.parts for x, _ in part)
    half = shape.radius or max(abs(y) for part in shape.parts for _, y in part)
    size = min(0.16 * shape.length, 0.45 * half)
    tip = front - 0.3 * size
    arrow = [(tip, 0.0), (tip - size, size), (tip - size, -size)]
    corners = [pose.compose(Pose(x, y, 0.0))[:2] for x, y in arrow]
    axes.add_patch(Outline(corners, facecolor=INK if filled else colour, zorder=order))


def write(
    axes: Axes,
    x: float,
    y: float,
    text: str,
    size: float,
    colour: str = INK,
    lift: float = 0.0,
    order: int = 8,
) -> None:
    """Write with a white rim; ``lift`` moves the text up (points). No sign is a formula."""
    axes.annotate(
        text.replace("$", r"\$"),
        (x, y),
        (0.0, lift),
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=size,
        color=colour,
        path_effects=_HALO,
        zorder=order,
        clip_on=True,
    )


def draw_marks(axes: Axes, marks: Sequence[tuple[float, float, str]]) -> None:
    """Draw a red ring with its number at each place."""
    for x, y, label in marks:
        axes.plot(x, y, "o", markersize=20, fillstyle="none", color="#c22f10", mew=2.4, zorder=9)
        write(axes, x, y, label, size=10, colour="#9c2200", lift=17.0)


def _body(shape: Footprint, pose: Pose) -> list[Patch]:
    if shape.radius:
        return [Circle((pose.x, pose.y), shape.radius)]
    return [Outline([pose.compose(Pose(x, y, 0.0))[:2] for x, y in part]) for part in shape.parts]


def _obstacle(obstacle: Obstacle) -> Patch:
    """Return an obstacle's patch, hatched or dashed where only some robots must avoid it."""
    if obstacle.wall is not None:
        patch: Patch = Outline(obstacle.wall, closed=False, fill=False)
        patch.set(edgecolor="#5d6672", linewidth=2.0, linestyle="--" if obstacle.blocks else "-")
    elif obstacle.disc is not None:
        x, y, radius = obstacle.disc
        patch = Circle((x, y), radius)
    else:
        assert obstacle.polygon is not None
        patch = Outline(obstacle.polygon)
    if obstacle.wall is None:
        patch.set(facecolor="#b3bac4", edgecolor="#808995", linewidth=0.8)
        patch.set_hatch("////" if obstacle.blocks else "")
    patch.set_zorder(2)
    return patch
