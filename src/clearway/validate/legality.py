"""What can be known of a scenario without solving it: legal poses, room, ways."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import shapely

from clearway.model import Pose, Scenario
from clearway.validate.endurance import check_endurance
from clearway.validate.finding import Finding, Severity
from clearway.validate.floors import OUTSIDE, OVERLAP, Floors, Spot
from clearway.validate.reachability import Shut, find_reachable
from clearway.validate.suitability import able_robots, load_states, visit_key
from clearway.world.shapes import Shape, ShapeIndex, body_shape, obstacle_shape


@dataclass(frozen=True)
class Legality:
    """All findings; truthy when none of them is an error.

    Parameters
    ----------
    clearances
        Least gap (m) at each start and visit pose by key path, to obstacles, closed bounds
        and, at starts, to other starts; negative where bodies overlap. At visits the
        tightest of the robot types that may come.
    reachable
        Task ids by robot id: may do the task and no visit is provably out of its reach.
    """

    findings: tuple[Finding, ...]
    clearances: Mapping[str, float] = field(default_factory=dict)
    reachable: Mapping[str, frozenset[str]] = field(default_factory=dict)

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that are errors."""
        return tuple(finding for finding in self.findings if finding.severity == "error")

    def __bool__(self) -> bool:
        """Whether no finding is an error."""
        return not self.errors


def check_scenario(scenario: Scenario) -> Legality:
    """Check starts, visits, parking, room, final rests, ways and what a run through time needs.

    All geometry is the judge's own.
    """
    floors = Floors(scenario)
    clearances: dict[str, float] = {}
    spots = _visit_spots(scenario, floors)
    findings = [
        *_check_starts(scenario, floors, clearances),
        *_check_room(scenario),
        *_check_zones(scenario, floors),
        *_check_visits(scenario, spots),
        *_check_rests(scenario),
    ]
    for (i, j), by_type in spots.items():
        clearances[visit_key(scenario, i, j)] = min(spot.gap for spot in by_type.values())
    unfit = {(i, n) for (i, _), by in spots.items() for n, spot in by.items() if not spot.is_legal}
    reachable, shut = find_reachable(scenario, unfit)
    misplaced = {f.robots[0] for f in findings if f.kind in ("start_in_obstacle", "start_outside")}
    ways = [(i, way) for i, way in sorted(shut.items()) if not misplaced.issuperset(way.robots)]
    findings += [_unreachable(scenario, i, way) for i, way in ways]
    findings += check_endurance(scenario)
    return Legality(tuple(findings), clearances, reachable)


def _unreachable(scenario: Scenario, order: int, way: Shut) -> Finding:
    task = scenario.orders[order].task
    pose = task.visits[way.visit].pose
    text = (
        f"no robot that may do task {task.id} can come here: even a disc of radius "
        f"{way.radius:.2f} m, the largest in its body, has no way; "
        "open a passage or move the pose"
    )
    key, place = visit_key(scenario, order, way.visit), (pose.x, pose.y)
    return Finding("unreachable", "error", key, text, way.robots, place, None, way.proof)


def _misplaced(what: str, subject: str, spot: Spot) -> tuple[str, str, float]:
    """Return kind, text and depth of a body that stands where it must not."""
    depth = -spot.gap
    if spot.is_outside:
        text = f"{subject} is {depth:.3f} m outside the bounds; move it inside"
        return f"{what}_outside", f"{text} or set site.border = 'open'", depth
    text = f"{subject} overlaps {spot.key} by {depth:.3f} m; move one of them"
    return f"{what}_in_obstacle", text, depth


def _check_starts(
    scenario: Scenario, floors: Floors, clearances: dict[str, float]
) -> Iterator[Finding]:
    robots = scenario.robots
    bodies = [body_shape(scenario.type_of(r).footprint, r.start) for r in robots]
    index = ShapeIndex(bodies)
    for i, (robot, body) in enumerate(zip(robots, bodies, strict=True)):
        key, place = f"robots[{i}].start", (robot.start.x, robot.start.y)
        spot = floors.tightest(scenario.type_of(robot), False, body)
        clearances[key] = spot.gap
        if not spot.is_legal:
            kind, text, depth = _misplaced("start", f"the start of robot {robot.id}", spot)
            yield Finding(kind, "error", key, text, (robot.id,), place, depth, True)
        nearest = index.nearest(body, but=i)
        if nearest is None:
            continue
        clearances[key] = min(clearances[key], nearest[0])
        for _, j in index.near(body):
            depth = body.overlap(bodies[j]) if j != i else 0.0
            if depth <= OVERLAP:
                continue
            clearances[key] = min(clearances[key], -depth)
            if j > i:
                text = (
                    f"robots {robot.id} and {robots[j].id} overlap at their starts by {depth:.3f} m"
                )
                pair = (robot.id, robots[j].id)
                mend = "move one of them"
                yield Finding(
                    "starts_overlap", "error", key, f"{text}; {mend}", pair, place, depth, True
                )


def _check_room(scenario: Scenario) -> Iterator[Finding]:
    """Bodies that may overlap by 1 mm are apart when each is eroded by the tolerance."""
    site = scenario.site
    if site.border == "open":
        return
    names = {robot.type for robot in scenario.robots}
    stopping = [o for o in site.obstacles if all(o.stops(name, False) for name in names)]
    free = shapely.Polygon(site.bounds)
    if stopping:
        shapes = [obstacle_shape(obstacle) for obstacle in stopping]
        free = free.difference(shapely.union_all([s.geometry.buffer(s.radius) for s in shapes]))
    at_origin = Pose(0.0, 0.0, 0.0)
    area = {
        name: body_shape(scenario.robot_types[name].footprint, at_origin).eroded(OUTSIDE).area
        for name in names
    }
    needed = sum(area[robot.type] for robot in scenario.robots)
    if needed > free.area:
        text = (
            f"{len(scenario.robots)} robots cover {needed:.1f} m^2 and the site has "
            f"{free.area:.1f} m^2 free; take fewer robots or a larger site"
        )
        yield Finding("no_room", "error", "robots", text, proof=True)


def _check_zones(scenario: Scenario, floors: Floors) -> Iterator[Finding]:
    """Parking, stations and chargers must fit at least one robot type of the fleet."""
    kinds = [scenario.robot_types[name] for name in sorted({r.type for r in scenario.robots})]
    for i, zone in enumerate(scenario.site.zones):
        if zone.pose is None or not kinds:
            continue
        spots = [(k, floors.tightest(k, False, body_shape(k.footprint, zone.pose))) for k in kinds]
        bad = [(kind, spot) for kind, spot in spots if not spot.is_legal]
        if bad:
            names = ", ".join(kind.name for kind, _ in bad)
            subject = f"a body of type {names} at {zone.kind} {zone.name}"
            what, text, depth = _misplaced("zone", subject, bad[0][1])
            severity: Severity = "error" if len(bad) == len(kinds) else "warning"
            place = (zone.pose.x, zone.pose.y)
            yield Finding(what, severity, f"site.zones[{i}].pose", text, (), place, depth)


def _visit_spots(scenario: Scenario, floors: Floors) -> dict[tuple[int, int], dict[str, Spot]]:
    """Return the tightest spot by order and visit, then by type that may come.

    Where the load changes, a body stands before and after; the worse of both counts.
    """
    spots: dict[tuple[int, int], dict[str, Spot]] = {}
    for i, order in enumerate(scenario.orders):
        names = sorted({robot.type for robot in able_robots(scenario, order.task)})
        kinds = [scenario.robot_types[name] for name in names]
        for j, states in enumerate(load_states(order.task)):
            pose = order.task.visits[j].pose
            for kind in kinds:
                stands = [
                    floors.tightest(kind, loaded, body_shape(kind.shape(loaded), pose))
                    for loaded in sorted(set(states))
                ]
                worst = min(stands, key=lambda spot: (spot.is_legal, spot.gap))
                spots.setdefault((i, j), {})[kind.name] = worst
    return spots


def _check_visits(
    scenario: Scenario, spots: Mapping[tuple[int, int], Mapping[str, Spot]]
) -> Iterator[Finding]:
    for i, order in enumerate(scenario.orders):
        task = order.task
        if not able_robots(scenario, task):
            text = f"no robot has the capabilities and the capacity for task {task.id}; add one"
            yield Finding("no_robot", "error", f"tasks[{i}]", text, proof=True)
            continue
        for j, visit in enumerate(task.visits):
            bad = {name: spot for name, spot in spots[i, j].items() if not spot.is_legal}
            if not bad:
                continue
            worst = min(bad.values(), key=lambda spot: spot.gap)
            kind, text, depth = _misplaced(
                "visit", f"type {', '.join(bad)} at task {task.id}", worst
            )
            nobody_fits = len(bad) == len(spots[i, j])
            severity: Severity = "error" if nobody_fits else "warning"
            key, place = visit_key(scenario, i, j), (visit.pose.x, visit.pose.y)
            robots = () if task.robot is None else (task.robot,)
            yield Finding(kind, severity, key, text, robots, place, depth, nobody_fits)


def _check_rests(scenario: Scenario) -> Iterator[Finding]:
    """Two tasks whose last poses overlap cannot both be where a robot rests for ever."""
    bodies: list[Shape] = []
    owner: list[int] = []
    for i, order in enumerate(scenario.orders):
        if not order.task.visits:
            continue
        last, loaded = order.task.visits[-1], load_states(order.task)[-1][1]
        for name in sorted({robot.type for robot in able_robots(scenario, order.task)}):
            bodies.append(body_shape(scenario.robot_types[name].shape(loaded), last.pose))
            owner.append(i)
    index = ShapeIndex(bodies)
    # A robot that could do something else afterwards need not rest at the pose.
    fixed = [order.task.robot for order in scenario.orders]
    may_leave = None in fixed or bool(scenario.site.zones_of("parking"))
    deepest: dict[tuple[int, int], float] = {}
    for a, body in enumerate(bodies):
        for _, b in index.near(body):
            pair = (owner[a], owner[b])
            if pair[0] < pair[1] and (fixed[pair[0]] is None or fixed[pair[0]] != fixed[pair[1]]):
                depth = body.overlap(bodies[b])
                if depth > OVERLAP:
                    deepest[pair] = max(depth, deepest.get(pair, 0.0))
    for (i, j), depth in sorted(deepest.items()):
        first, second = scenario.orders[i].task, scenario.orders[j].task
        is_last = not may_leave and fixed.count(first.robot) == fixed.count(second.robot) == 1
        key = visit_key(scenario, i, len(first.visits) - 1)
        pose = first.visits[-1].pose
        text = f"bodies at the ends of tasks {first.id} and {second.id} overlap by {depth:.3f} m"
        mend = "move one of the poses" if is_last else "only one of them can be a final rest"
        robots = tuple(r for r in (first.robot, second.robot) if r is not None)
        severity: Severity = "error" if is_last else "warning"
        place = (pose.x, pose.y)
        yield Finding("rests_overlap", severity, key, f"{text}; {mend}", robots, place, depth)
