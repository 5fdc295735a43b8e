"""Makes the pictures of docs/how-it-plans.md with the planner that they explain.

    python docs/make_how_it_plans.py [NAME ...] [--out FOLDER]

Without names all are made. Every plan in them has been judged.
"""

import argparse
import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clearway import _core, solve, validate_plan
from clearway.formats.recording import record_plan
from clearway.model import (
    TICKS_PER_SECOND,
    Obstacle,
    Order,
    Piece,
    Plan,
    Pose,
    Problem,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Trajectory,
    Visit,
    to_seconds,
)
from clearway.motion import Motion, MotionModel, car, four_wheel
from clearway.plan import TeamParams
from clearway.plan.bounds import lower_bounds
from clearway.plan.native_team import NativeTeam
from clearway.plot.palette import line_colour, robot_colour
from clearway.plot.scenery import INK, MUTED, draw_body, draw_floor, write
from clearway.protocols import Budget
from clearway.systems.solve import Run
from clearway.validate import separations
from clearway.world.fleets import CAR, CARRIER, SHUTTLE
from clearway.world.generate import generate
from clearway.world.shapes import body_shape

IMAGES = Path(__file__).parent / "images"
GREEN, RED, GREY = "#007F5C", "#c22f10", "#c9ced6"
ORDER = "viridis_r"  # light first, dark last
EFFORTS = (2, 4, 8, 16, 32, 64)  # in expansions up to the first plan

Floats = NDArray[np.float64]


def judged(scenario: Scenario, budget: Budget | None = None) -> Run:
    """Return a run whose plan is complete and right; else the script ends here."""
    run = solve(scenario, budget=budget)
    assert run.plan, run.plan.reason
    assert not run.violations, run.violations
    return run


def trace(
    scenario: Scenario, plan: Plan, params: TeamParams, robot: int
) -> tuple[list[_core.Expanded], Trajectory]:
    """Return the states that a robot's search expands, in order, and its way, which is judged.

    All others move as the planner makes them move; the search is the robot's last one.
    """
    problem = Problem(scenario.site, scenario.robot_types, scenario.robots, plan.tours)
    team = NativeTeam(problem, lower_bounds(problem))
    tours = _core.plan_team(team.models, team.agents, params, scenario.seed).tours
    tour, states = _core.trace_tour(team.models, team.agents, params, tours, robot)
    way = team.trajectory(robot, tour)
    changed = replace(plan, trajectories={**plan.trajectories, way.robot: way})
    violations = validate_plan(record_plan(scenario, changed, seed=scenario.seed, version=""))
    assert not violations, violations
    return states, way


def weighted(weight: float, greed: float) -> TeamParams:
    """Return parameters of the search with these weights on the current leg and on later ones."""
    params = TeamParams()
    search = params.search
    search.weight, search.greed = weight, greed
    params.search = search
    return params


def pose_at(path: Trajectory, seconds: float) -> Pose:
    """Return where a robot is at a time (s)."""
    pose = path.start
    for piece, (first, last) in zip(path.pieces, path.timing, strict=True):
        begin, end = to_seconds(first), to_seconds(last)
        if seconds < begin:
            break
        pose = piece.at(min(1.0, (seconds - begin) / (end - begin)))
    return pose


def places(path: Trajectory, begin: float = 0.0, step: float = 0.1) -> Floats:
    """Return where a robot is from ``begin`` to its final rest: rows of x, y, theta."""
    times = np.append(np.arange(begin, to_seconds(path.end), step), to_seconds(path.end))
    return np.array([pose_at(path, t) for t in times])


def waits(path: Trajectory) -> float:
    """Return how long a robot stands before its final rest (s)."""
    return to_seconds(path.end - sum(last - first for first, last in path.timing))


def gap_between(types: Sequence[RobotType], poses: Sequence[Pose]) -> float:
    """Return the gap of two bodies (m), minus their depth where they overlap."""
    one, other = (body_shape(t.footprint, p) for t, p in zip(types, poses, strict=True))
    return one.gap(other) or -one.overlap(other)


def boxes(*corners: tuple[float, float, float, float]) -> tuple[Obstacle, ...]:
    """Return rectangular obstacles from ``(x0, y0, x1, y1)``."""
    return tuple(
        Obstacle(polygon=((x0, y0), (x1, y0), (x1, y1), (x0, y1))) for x0, y0, x1, y1 in corners
    )


def instance(name: str, kind: RobotType, site: Site, tours: Sequence[Sequence[Visit]]) -> Scenario:
    """Return a scenario; the first pose of each tour is the robot's start."""
    robots = tuple(Robot(f"r{i}", kind.name, tour[0].pose) for i, tour in enumerate(tours, 1))
    orders = tuple(
        Order(Task(f"t{i}", tuple(replace(v, task=f"t{i}") for v in tour[1:]), f"r{i}"))
        for i, tour in enumerate(tours, 1)
    )
    return Scenario(name, site, {kind.name: kind}, robots, orders, settings={"park": "never"})


def site_of(width: float, height: float, obstacles: Sequence[Obstacle]) -> Site:
    """Return a rectangular site."""
    return Site(((0.0, 0.0), (width, 0.0), (width, height), (0.0, height)), tuple(obstacles))


def picture(width: float, height: float) -> Figure:
    """Return an empty figure (inches)."""
    return Figure(figsize=(width, height), dpi=100, layout="constrained")


def plain(axes: Axes, title: str) -> None:
    """Leave out the frame and write a title above the left edge."""
    axes.set_title(title, loc="left", fontsize=11, color=INK)
    axes.tick_params(colors=MUTED, labelsize=8)
    axes.xaxis.label.set(color=MUTED, fontsize=9)
    axes.yaxis.label.set(color=MUTED, fontsize=9)
    for spine in axes.spines.values():
        spine.set_visible(False)


def draw_motions(path_png: Path) -> None:
    """Draw each motion of a car's and of a four-wheel robot's table with true footprints."""
    figure = picture(11.0, 5.9)
    grid = figure.subplots(3, 6).flat
    for kind, build, colour in ((CAR, car, 0), (CARRIER, four_wheel, 1)):
        model = build(kind, 16)
        for mode in model.modes:
            axes = next(grid)
            motions = [motion for motion in model.motions if motion.mode == mode.name]
            _draw_motion(axes, kind, motions, colour)
            told = f"{motions[0].duration:.2f} s" if motions else "at rest"
            axes.set_title(f"{kind.name}: {mode.name}, {told}", fontsize=8.0, color=INK)
    _draw_depth(next(grid), CARRIER, four_wheel(CARRIER, 16), 3)
    save(figure, path_png)


def _draw_motion(axes: Axes, kind: RobotType, motions: Sequence[Motion], colour: int) -> None:
    start = Pose(0.0, 0.0, math.pi / 2.0)
    draw_body(axes, kind.footprint, start, MUTED, filled=False)
    for motion in motions:
        piece = Piece(0, motion.mode, start, motion.twist)
        draw_body(axes, kind.footprint, piece.end, robot_colour(colour), filled=True, order=3)
        way = np.array([piece.at(p) for p in np.linspace(0.0, 1.0, 20)])
        axes.plot(way[:, 0], way[:, 1], color=RED, linewidth=2.0, zorder=6)
    axes.plot(0.0, 0.0, "o", color=INK, ms=3.5, zorder=7)
    axes.set(xlim=(-3.3, 3.3), ylim=(-3.4, 3.6), aspect="equal")
    axes.axis("off")


def _draw_depth(axes: Axes, kind: RobotType, model: MotionModel, depth: int) -> None:
    """Draw every way of so many motions, one after another."""
    level = [Pose(0.0, 0.0, math.pi / 2.0)]
    draw_body(axes, kind.footprint, level[0], MUTED, filled=False)
    for _ in range(depth):
        pieces = [Piece(0, m.mode, pose, m.twist) for pose in level for m in model.motions]
        lines = [[piece.at(p)[:2] for p in (0.0, 0.5, 1.0)] for piece in pieces]
        axes.add_collection(LineCollection(lines, colors=RED, linewidths=0.4, zorder=5))
        ends = {tuple(round(v, 3) for v in piece.end): piece.end for piece in pieces}
        level = list(ends.values())
    xy = np.array(level)
    axes.plot(xy[:, 0], xy[:, 1], ".", color=INK, ms=1.5, zorder=6)
    axes.set_title(f"{len(level)} poses after {depth} motions", fontsize=8.0, color=INK)
    axes.set(xlim=(-4.6, 4.6), ylim=(-4.3, 4.3), aspect="equal")
    axes.axis("off")


def draw_search(path_png: Path) -> None:
    """Draw the states that a car's search expands: with plain A* weights, and as it is done."""
    scenario = generate("shelves", robots=1, size=(50.0, 40.0), density=0.3, seed=5)
    plan = judged(scenario).plan
    figure = picture(12.0, 4.9)
    left, right = figure.subplots(1, 2)
    for axes, params, name in (
        (left, weighted(1.0, 0.0), "weight 1"),
        (right, TeamParams(), "weight 1.1, growing"),
    ):
        states, way = trace(scenario, plan, params, 0)
        draw_floor(axes, scenario.site)
        dots = _draw_states(axes, states)
        _draw_way(axes, states, way)
        for pose, filled in ((way.start, True), (way.final_pose, True)):
            draw_body(axes, CAR.footprint, pose, robot_colour(0), filled)
        arrival = to_seconds(way.end)
        plain(axes, f"{name}: {len(states)} states expanded, arrival at {arrival:.1f} s")
        bar = figure.colorbar(dots, ax=axes, shrink=0.8, pad=0.01)
        bar.set_label("order of expansion", color=MUTED, fontsize=9)
        bar.ax.tick_params(colors=MUTED, labelsize=8)
    save(figure, path_png)


def _draw_states(axes: Axes, states: Sequence[_core.Expanded]) -> PathCollection:
    poses = np.array([(s.pose.x, s.pose.y, s.pose.theta) for s in states])
    order = np.arange(len(states))
    ends = poses[:, :2] + 0.55 * np.column_stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])])
    ticks = LineCollection(
        list(np.stack([poses[:, :2], ends], axis=1)), cmap=ORDER, linewidths=0.9, zorder=3
    )
    ticks.set_array(order)
    axes.add_collection(ticks)
    return axes.scatter(poses[:, 0], poses[:, 1], c=order, cmap=ORDER, s=7.0, zorder=3)


def _draw_way(axes: Axes, states: Sequence[_core.Expanded], way: Trajectory) -> None:
    """Draw the way found, and in red the analytic curve at its end."""
    shot = max(s.begin for s in states if _lies_on(s, way)) / TICKS_PER_SECOND
    xy = places(way)
    axes.plot(xy[:, 0], xy[:, 1], color=INK, linewidth=2.2, zorder=5)
    xy = places(way, shot)
    axes.plot(xy[:, 0], xy[:, 1], color=RED, linewidth=3.2, zorder=6)
    write(axes, *pose_at(way, (shot + to_seconds(way.end)) / 2.0)[:2], "shot", 10, RED, lift=12.0)
    for t in np.arange(4.0, to_seconds(way.end) - 2.0, 4.0):
        draw_body(axes, CAR.footprint, pose_at(way, float(t)), MUTED, filled=False)


def _lies_on(state: _core.Expanded, way: Trajectory) -> bool:
    x, y, _ = pose_at(way, to_seconds(state.begin))
    return math.hypot(x - state.pose.x, y - state.pose.y) < 1e-6


def draw_intervals(path_png: Path) -> None:
    """Draw a lane with crossing traffic: safe intervals at one place, and the search in time."""
    streets = ((13.0, 17.0), (27.0, 31.0))
    lane = (10.8, 13.2)
    walls = ((0.0, 13.0), (17.0, 27.0), (31.0, 44.0))
    blocks = boxes(
        *((x0, 0.0, x1, lane[0]) for x0, x1 in walls),
        *((x0, lane[1], x1, 24.0) for x0, x1 in walls),
    )
    x1, x2 = (sum(street) / 2.0 for street in streets)
    y = sum(lane) / 2.0
    up, down = math.pi / 2.0, -math.pi / 2.0
    scenario = instance(
        "lane",
        CAR,
        site_of(44.0, 24.0, blocks),
        (
            (
                Visit(None, Pose(x1, 2.0, up)),
                Visit(None, Pose(x1, 20.5, up), 5.0),
                Visit(None, Pose(x1, 2.0, up)),
            ),
            (
                Visit(None, Pose(x2, 21.5, down)),
                Visit(None, Pose(x2, 21.5, down), 18.0),
                Visit(None, Pose(x2, 3.0, down)),
            ),
            (Visit(None, Pose(2.0, y, 0.0)), Visit(None, Pose(40.0, y, 0.0))),
        ),
    )
    run = judged(scenario)
    states, way = trace(scenario, run.plan, TeamParams(), 2)
    others = [path for name, path in run.plan.trajectories.items() if name != way.robot]
    end = to_seconds(way.end) + 3.0
    figure = picture(12.0, 8.6)
    floor, line, chart = figure.subplots(3, 1, height_ratios=(3.0, 0.7, 4.6))

    draw_floor(floor, scenario.site)
    for i, (robot, path) in enumerate(run.plan.trajectories.items()):
        xy = places(path)
        floor.plot(xy[:, 0], xy[:, 1], color=line_colour(i), linewidth=1.8, zorder=3)
        draw_body(floor, CAR.footprint, path.start, robot_colour(i), filled=True)
        write(floor, path.start.x, path.start.y, robot, 9)
    here = Pose(x1, y, 0.0)
    draw_body(floor, CAR.footprint, here, GREEN, filled=False)
    plain(floor, f"r3 crosses two streets; dashed: the place x = {x1:g} m of the time axis below")

    times = np.arange(0.0, end, 0.05)
    free = np.array([_is_free(here, others, t) for t in times])
    _draw_intervals(line, times, free)
    plain(line, f"safe intervals (green) of a body that stands at x = {x1:g} m")

    xs = np.arange(0.0, 44.0, 0.25)
    slices = times[::4]
    taken = [[not _is_free(Pose(float(x), y, 0.0), others, t) for x in xs] for t in slices]
    chart.pcolormesh(xs, slices, np.array(taken), cmap=ListedColormap(["white", GREY]))
    _draw_space_time(chart, states, y, end)
    xt = places(way)
    arrivals = np.append(np.arange(0.0, to_seconds(way.end), 0.1), to_seconds(way.end))
    chart.plot(xt[:, 0], arrivals, color=RED, linewidth=2.4, zorder=6)
    chart.axvline(x1, color=GREEN, linestyle=(0, (4, 3)), linewidth=1.2, zorder=2)
    chart.set(xlim=(0.0, 44.0), ylim=(0.0, end), xlabel="x (m)", ylabel="time (s)")
    plain(
        chart,
        f"in the lane: occupied (grey), {len(states)} states with their intervals, way (red)",
    )
    save(figure, path_png)


def _is_free(pose: Pose, others: Sequence[Trajectory], seconds: float) -> bool:
    poses = (pose_at(path, seconds) for path in others)
    return all(
        pose.distance(other) > 2.0 * CAR.footprint.circumradius
        or gap_between((CAR, CAR), (pose, other)) >= TeamParams().margin
        for other in poses
    )


def _draw_intervals(axes: Axes, times: Floats, free: NDArray[np.bool_]) -> None:
    edges = np.flatnonzero(np.diff(free)) + 1
    cuts = [0, *edges.tolist(), len(times) - 1]
    for a, b in itertools.pairwise(cuts):
        colour = GREEN if free[a] else GREY
        axes.axvspan(times[a], times[b], 0.15, 0.85, color=colour, linewidth=0.0)
        if free[a]:
            since = f"from {times[a]:.1f} s" if a else ""
            until = f"to {times[b]:.1f} s" if b < len(times) - 1 else "on"
            label = f"{since} {until}".strip()
            axes.text((times[a] + times[b]) / 2.0, 0.5, label, ha="center", va="center", c="white")
    axes.set(xlim=(0.0, times[-1]), ylim=(0.0, 1.0), yticks=[], xlabel="time (s)")


def _draw_space_time(axes: Axes, states: Sequence[_core.Expanded], y: float, end: float) -> None:
    """Draw states in the lane: a dot at the arrival, a line for as long as it may stay."""
    shown = [(i, s) for i, s in enumerate(states) if abs(s.pose.y - y) < 1.0]
    order = np.array([i for i, _ in shown])
    stays = [
        [(s.pose.x, to_seconds(s.begin)), (s.pose.x, min(to_seconds(s.end), end))] for _, s in shown
    ]
    lines = LineCollection(stays, cmap=ORDER, linewidths=1.0, alpha=0.55, zorder=3)
    lines.set_array(order)
    axes.add_collection(lines)
    x, begin = np.array([stay[0] for stay in stays]).T
    axes.scatter(x, begin, c=order, cmap=ORDER, s=16.0, zorder=4)


def draw_conflict(path_png: Path) -> None:
    """Draw two robots that swap ends of a corridor: each alone, then as a team."""
    walls = boxes((0.0, 2.4, 8.0, 5.0), (13.0, 2.4, 40.0, 5.0))
    scenario = instance(
        "siding",
        SHUTTLE,
        site_of(40.0, 5.0, walls),
        (
            (Visit(None, Pose(2.0, 1.2, 0.0)), Visit(None, Pose(38.0, 1.2, 0.0))),
            (Visit(None, Pose(38.0, 1.2, math.pi)), Visit(None, Pose(2.0, 1.2, math.pi))),
        ),
    )
    run = judged(scenario)
    alone, team = _each_alone(scenario), run.plan.trajectories
    record = record_plan(scenario, replace(run.plan, trajectories=alone), seed=0, version="")
    assert {violation.kind for violation in validate_plan(record)} == {"conflict"}
    [(_, _, depth, collision)] = separations(record)
    [(_, _, least, nearest)] = separations(run.record)

    figure = picture(12.0, 6.6)
    top, middle, chart = figure.subplots(3, 1, height_ratios=(1.0, 1.0, 1.5))
    told = f"each alone: at {collision:.1f} s the bodies are {-depth:.2f} m in each other"
    _draw_meeting(top, scenario, alone, collision, told)
    waiter, wait = max(((name, waits(p)) for name, p in team.items()), key=lambda each: each[1])
    told = (
        f"as a team: {waiter} waits {wait:.1f} s; nearest at {nearest:.1f} s, {least:.2f} m apart"
    )
    _draw_meeting(middle, scenario, team, nearest, told)

    end = max(to_seconds(path.end) for path in team.values())
    times = np.arange(0.0, end, 0.05)
    for paths, colour, name in (
        (alone, MUTED, "each alone"),
        (team, GREEN, "as a team"),
    ):
        both = list(paths.values())
        gaps = [gap_between((SHUTTLE,) * 2, [pose_at(p, t) for p in both]) for t in times]
        chart.plot(times, gaps, color=colour, linewidth=2.0, label=name)
    chart.axhline(0.0, color=RED, linewidth=1.2)
    chart.plot([collision, nearest], [depth, least], "o", color=RED, zorder=5)
    chart.set(xlabel="time (s)", ylabel="gap (m)", ylim=(-2.0, 10.0), xlim=(0.0, end))
    chart.legend(frameon=False, fontsize=9, loc="upper right")
    plain(chart, "gap of the true footprints over time; below the red line they overlap")
    save(figure, path_png)


def _each_alone(scenario: Scenario) -> dict[str, Trajectory]:
    paths: dict[str, Trajectory] = {}
    for robot, order in zip(scenario.robots, scenario.orders, strict=True):
        paths |= judged(replace(scenario, robots=(robot,), orders=(order,))).plan.trajectories
    return paths


def _draw_meeting(
    axes: Axes,
    scenario: Scenario,
    paths: Mapping[str, Trajectory],
    moment: float,
    title: str,
) -> None:
    draw_floor(axes, scenario.site)
    for i, (robot, path) in enumerate(paths.items()):
        xy = places(path)
        axes.plot(xy[:, 0], xy[:, 1], color=line_colour(i), linewidth=1.5, zorder=3)
        draw_body(axes, SHUTTLE.footprint, path.start, line_colour(i), filled=False)
        pose = pose_at(path, moment)
        draw_body(axes, SHUTTLE.footprint, pose, robot_colour(i), filled=True, order=5)
        write(axes, path.start.x, path.start.y, robot, 9)
    axes.set(xlabel="", yticks=[], ylabel="")
    plain(axes, title)


def draw_improvement(path_png: Path) -> None:
    """Draw the sum of costs of one run's best plan against its expansions."""
    scenario = generate("open", robots=20, size=(40.0, 40.0), seed=1)
    first = judged(scenario)
    spent, costs = [first.plan.counters["first_expansions"]], [first.record.sum_of_costs]
    for effort in EFFORTS:
        expansions = effort * spent[0]
        run = judged(scenario, Budget(expansions=expansions))
        spent.append(expansions)
        costs.append(run.record.sum_of_costs)
    bound = first.plan.lower_bound
    assert bound is not None
    figure = picture(9.0, 4.2)
    axes = figure.subplots()
    axes.plot(spent, costs, "o-", color=line_colour(0), linewidth=1.0, ms=6)
    axes.axhline(bound, color=GREEN, linewidth=2.0)
    for x, y in zip(spent, costs, strict=True):
        axes.annotate(
            f"{y:.0f} s\n+{100.0 * (y / bound - 1.0):.1f} %",
            (x, y),
            (0.0, -9.0),
            textcoords="offset points",
            ha="center",
            va="top",
            fontsize=9,
            color=INK,
        )
    axes.text(spent[0], bound, f"lower bound {bound:.0f} s", va="bottom", color=GREEN, fontsize=9)
    axes.set_xscale("log")
    axes.set_xticks(spent, [f"{x:,}" for x in spent])
    axes.minorticks_off()
    low, high = bound, max(costs)
    axes.set_ylim(low - 0.05 * (high - low), high + 0.1 * (high - low))
    axes.set(xlabel="expansions", ylabel="sum of costs (s)")
    plain(axes, "20 cars on 40 m x 40 m: the best plan so far")
    save(figure, path_png)


def save(figure: Figure, path_png: Path) -> None:
    """Write a picture; the same picture gives the same bytes."""
    figure.savefig(path_png, format="png", metadata={"Software": None})


PICTURES: dict[str, Callable[[Path], None]] = {
    "motions": draw_motions,
    "search": draw_search,
    "intervals": draw_intervals,
    "conflict": draw_conflict,
    "improvement": draw_improvement,
}


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the pictures named."""
    parser = argparse.ArgumentParser(description="Make the pictures of docs/how-it-plans.md.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument("--out", type=Path, default=IMAGES, help="folder of the pictures")
    chosen = parser.parse_args(arguments)
    unknown = set(chosen.names) - set(PICTURES)
    if unknown:
        parser.error(f"there is no {', '.join(sorted(unknown))}; take {', '.join(PICTURES)}")
    for name in chosen.names or PICTURES:
        PICTURES[name](chosen.out / f"how-it-plans-{name}.png")


if __name__ == "__main__":
    main()
