"""Still pictures of plans and of sites, as PNG."""

import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from clearway.formats.atomic import write_bytes
from clearway.metrics.motion import track_of
from clearway.model import Footprint, PlanRecord, Pose, Robot, RobotType, Site, Task
from clearway.plot.palette import line_colour, robot_colour
from clearway.plot.scenery import INK, MUTED, draw_body, draw_floor, draw_marks, write

_WIDTH = 16.0
_DOTS = 100
# Room around the floor for title and axes (inches).
_ROOM = 1.5


def draw_plan(record: PlanRecord, path_png: Path) -> None:
    """Draw who drives where: ways, starts (dashed), last poses (filled) and tasks.

    The picture is 1600 pixels wide; the same plan gives the same bytes.
    """
    axes = axes_of(record.site)
    draw_floor(axes, record.site)
    for index, robot in enumerate(record.robots):
        colour = robot_colour(index)
        track = track_of(record, robot)
        shape = record.robot_types[robot.type].footprint
        line = line_colour(index)
        axes.plot(track.x, track.y, color=line, linewidth=1.6, alpha=0.85, zorder=3)
        draw_body(axes, shape, robot.start, line, filled=False)
        last = Pose(float(track.x[-1]), float(track.y[-1]), float(track.theta[-1]))
        draw_body(axes, shape, last, colour, filled=True, order=5)
    crowd = len(record.robots)
    size = 9.0 if crowd <= 12 else 7.5
    for index, robot in enumerate(record.robots):
        for visit in record.tours.get(robot.id, ()):
            x, y, _ = visit.pose
            axes.plot(x, y, "D", color=robot_colour(index), mec=INK, mew=0.7, ms=5, zorder=6)
            if visit.task is not None:
                write(axes, x, y, visit.task, size - 1.0, MUTED, lift=-9.0)
    for robot in record.robots:
        track = track_of(record, robot)
        write(axes, float(track.x[-1]), float(track.y[-1]), robot.id, size + 1.0)
        if np.hypot(track.x[-1] - robot.start.x, track.y[-1] - robot.start.y) > 1e-3:
            write(axes, robot.start.x, robot.start.y, robot.id, size, MUTED)
    title(axes, record.scenario, ", ".join(_figures(record)))
    save(axes, path_png)


def draw_site(
    site: Site,
    robot_types: Mapping[str, RobotType],
    robots: Sequence[Robot],
    tasks: Sequence[Task],
    path_png: Path,
    marks: Sequence[tuple[float, float, str]] = (),
) -> None:
    """Draw a site before any planning: starts (filled) and the poses of all visits (dashed).

    Parameters
    ----------
    marks
        ``(x, y, label)`` of places to look at, ringed in red.
    """
    axes = axes_of(site)
    draw_floor(axes, site)
    size = 9.0 if len(robots) <= 12 else 7.5
    for index, robot in enumerate(robots):
        colour = robot_colour(index)
        draw_body(axes, robot_types[robot.type].footprint, robot.start, colour, filled=True)
        write(axes, robot.start.x, robot.start.y, robot.id, size + 1.0)
    for task in tasks:
        for shape, pose in _outlines(task, robot_types, robots):
            draw_body(axes, shape, pose, INK, filled=False)
            write(axes, pose.x, pose.y, task.id, size, INK)
    draw_marks(axes, marks)
    counted = f"{len(robots)} robots at their starts (filled), {len(tasks)} tasks (dashed)"
    found = f", {len(marks)} places to look at (red)" if marks else ""
    title(axes, "Site", counted + found)
    save(axes, path_png)


def _outlines(
    task: Task, robot_types: Mapping[str, RobotType], robots: Sequence[Robot]
) -> Iterator[tuple[Footprint, Pose]]:
    """Yield the body that stands at each visit: of the robot named, otherwise of one that can."""
    needed = {visit.needs for visit in task.visits if visit.needs}
    able = [
        robot_types[robot.type]
        for robot in robots
        if task.robot in (None, robot.id) and needed <= robot_types[robot.type].capabilities
    ]
    kind = next(iter([*able, *robot_types.values()]))
    loaded = False
    for visit in task.visits:
        yield kind.shape(loaded), visit.pose
        loaded = {"pick": True, "drop": False, None: loaded}[visit.load]


def _figures(record: PlanRecord) -> Iterator[str]:
    yield str(record.status)
    yield f"{len(record.robots)} robots"
    yield f"{sum(len(tasks) for tasks in record.assignment.values())} tasks"
    yield f"makespan {record.makespan:.1f} s"
    yield f"sum of costs {record.sum_of_costs:.1f} s"
    if record.lower_bound:
        yield f"{100.0 * (record.sum_of_costs / record.lower_bound - 1.0):.1f} % above its bound"


def axes_of(site: Site) -> Axes:
    """Return the axes of a new picture, as wide as all and as high as the site asks."""
    width, depth = (max(values) - min(values) for values in zip(*site.bounds, strict=True))
    height = min(max((_WIDTH - 1.0) * depth / width, 4.0), 24.0) + _ROOM
    layout = ConstrainedLayoutEngine(w_pad=0.15, h_pad=0.15)
    figure = Figure(figsize=(_WIDTH, height), dpi=_DOTS, layout=layout)
    return figure.add_subplot()


def title(axes: Axes, name: str, figures: str) -> None:
    """Write a headline and the figures below it."""
    axes.set_title(name.replace("$", r"\$"), loc="left", fontsize=17, color=INK, pad=26)
    axes.annotate(
        figures,
        (0.0, 1.0),
        (0.0, 10.0),
        xycoords="axes fraction",
        textcoords="offset points",
        fontsize=11.5,
        color=MUTED,
        annotation_clip=False,
    )


def save(axes: Axes, path: Path) -> None:
    """Write the picture, the same bytes for the same picture."""
    content = io.BytesIO()
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.savefig(content, format="png", metadata={"Software": None})
    write_bytes(path, content.getvalue())
