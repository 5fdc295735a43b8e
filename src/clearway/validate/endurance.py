"""What a run through time needs: rest for all, energy for all, work that comes in time."""

import math
from collections import Counter
from collections.abc import Iterator

from clearway.model import Scenario, Simulation
from clearway.validate.finding import Finding, Severity
from clearway.validate.floors import OVERLAP
from clearway.validate.reachability import Ways
from clearway.world.shapes import Shape, body_shape, obstacle_shape

SHOWN = 5


def check_endurance(scenario: Scenario) -> Iterator[Finding]:
    """Yield what keeps a scenario from running through time, or some of its orders from it.

    Nothing, where nothing of it happens in time: neither streams, an end and so on, nor shelves
    that are fetched.
    """
    if not runs_through_time(scenario):
        return
    yield from _check_work(scenario)
    yield from _check_rest(scenario)
    yield from _check_energy(scenario)
    yield from _check_places(scenario)
    yield from _check_ways(scenario)
    yield from _check_times(scenario)
    yield from _check_surprises(scenario)


def runs_through_time(scenario: Scenario) -> bool:
    """Whether anything of a scenario happens in time, or shelves are fetched."""
    return scenario.simulation != Simulation() or _fetches(scenario)


def _check_work(scenario: Scenario) -> Iterator[Finding]:
    if not scenario.orders and not scenario.simulation.streams:
        text = "there are no orders, so nothing happens; name a file in orders, or add a stream"
        yield Finding("no_work", "warning", "orders", text)


def _fetches(scenario: Scenario) -> bool:
    listed = any(order.task.fetches is not None for order in scenario.orders)
    return listed or any(stream.fetch for stream in scenario.simulation.streams)


def _check_rest(scenario: Scenario) -> Iterator[Finding]:
    """Each robot needs a place of its own to rest in, or others must wait for it for ever."""
    kinds = ("parking", "shelf") if _fetches(scenario) or scenario.site.layout else ("parking",)
    zones = [zone for kind in kinds for zone in scenario.site.zones_of(kind)]
    places = sum(zone.pose is not None for zone in zones)
    robots = len(scenario.robots)
    if robots > places:
        text = (
            f"{robots} robots have {places} places to rest in (zones of kind "
            f"{' or '.join(kinds)} with a pose), so {robots - places} may have to stay where they "
            "start, in the way of others; add zones or take fewer robots"
        )
        yield Finding("few_bays", "warning", "site.zones", text)


def _check_energy(scenario: Scenario) -> Iterator[Finding]:
    """Drained in a second if all robots move all the time, against what all chargers give."""
    until = scenario.simulation.until or math.inf
    batteries = {name: kind.battery for name, kind in scenario.robot_types.items() if kind.battery}
    driven = [robot for robot in scenario.robots if robot.type in batteries]
    if all(
        robot.energy - until / batteries[robot.type].capacity
        >= batteries[robot.type].reserve - 1e-9
        for robot in driven
    ):
        return
    counts = Counter(robot.type for robot in driven)
    drain = sum(count / batteries[name].capacity for name, count in counts.items())
    chargers = sum(zone.pose is not None for zone in scenario.site.zones_of("charger"))
    seconds = min(batteries[name].charging for name in counts)
    gain = chargers / seconds
    if drain <= gain:
        return
    terms = " + ".join(f"{n} x 1/{batteries[name].capacity:g} s" for name, n in counts.items())
    gives = f"{chargers} charger gives" if chargers == 1 else f"{chargers} chargers give"
    fleet = "1 robot at most drains" if len(driven) == 1 else f"{len(driven)} robots at most drain"
    missing = math.ceil(drain * seconds - 1e-9) - chargers
    text = (
        f"{fleet} {terms} = {100 * drain:.3g} %/s; {gives} "
        f"{chargers} x 1/{seconds:g} s = {100 * gain:.3g} %/s; "
        f"add {missing} charger{'s' * (missing > 1)}, or robots stand still with empty batteries"
    )
    yield Finding("few_chargers", "warning", "site.zones", text)


def _check_places(scenario: Scenario) -> Iterator[Finding]:
    """On a layout, each robot starts in a place of its own, off the channels."""
    layout = scenario.site.layout
    if layout is None:
        return

    def cell(x: float, y: float) -> tuple[int, int]:
        return int(x // layout.cell), int(y // layout.cell)

    places = {cell(z.pose.x, z.pose.y): z.name for z in scenario.site.zones if z.pose is not None}
    first: dict[str, str] = {}
    for i, robot in enumerate(scenario.robots):
        at = (robot.start.x, robot.start.y)
        name = places.get(cell(*at))
        key = f"robots[{i}].start"
        if name is None:
            text = f"robot {robot.id} starts in no place of the layout; start it in a shelf's place"
            yield Finding("start_off_place", "error", key, text, (robot.id,), at)
        elif name in first:
            text = f"robots {first[name]} and {robot.id} both start in {name}; move one of them"
            pair = (first[name], robot.id)
            yield Finding("starts_overlap", "error", key, text, pair, at)
        else:
            first[name] = robot.id


def _check_ways(scenario: Scenario) -> Iterator[Finding]:
    """Zones that streams draw from must be within reach; stations and chargers better be."""
    drawn = {draw.kind for stream in scenario.simulation.streams for draw in stream.draws}
    drawn |= {"shelf", "station"} if _fetches(scenario) else set()
    ways = Ways(scenario)
    kinds = {robot.type: scenario.type_of(robot) for robot in scenario.robots}
    starts = {
        (robot.type, ways.of(kinds[robot.type], False).component(robot.start))
        for robot in scenario.robots
    }
    for i, zone in enumerate(scenario.site.zones):
        if zone.pose is None or zone.kind not in drawn | {"station", "charger", "parking"}:
            continue
        here = {name: ways.of(kind, False).component(zone.pose) for name, kind in kinds.items()}
        if any(here[name] == component != 0 for name, component in starts):
            continue
        severity: Severity = "error" if zone.kind in drawn else "warning"
        text = f"no robot can come to {zone.kind} {zone.name}; open a passage or move its pose"
        place = (zone.pose.x, zone.pose.y)
        yield Finding("unreachable", severity, f"site.zones[{i}].pose", text, (), place)


def _check_times(scenario: Scenario) -> Iterator[Finding]:
    """Whatever comes only after the end of the run does not happen."""
    simulation = scenario.simulation
    if simulation.until is None:
        return
    late = [order.task.id for order in scenario.orders if order.release >= simulation.until]
    if late:
        names = ", ".join(late[:SHOWN]) + (", ..." if len(late) > SHOWN else "")
        what = f"{len(late)} orders are" if len(late) > 1 else "1 order is"
        text = f"{what} released after the run ends ({names}); raise until or release them before"
        yield Finding("too_late", "warning", "simulation.until", text)
    for i, stream in enumerate(simulation.streams):
        if stream.first >= simulation.until:
            text = f"stream {stream.name} begins after the run ends; raise until or lower first"
            yield Finding("too_late", "warning", f"simulation.streams[{i}].first", text)
    for i, surprise in enumerate(simulation.surprises):
        if surprise.at >= simulation.until:
            text = "the obstacle appears after the run ends; raise until or lower at"
            yield Finding("too_late", "warning", f"simulation.surprises[{i}].at", text)


def _check_surprises(scenario: Scenario) -> Iterator[Finding]:
    """Where an obstacle comes to light, nobody can stand any more."""
    kinds = [scenario.robot_types[name] for name in sorted({r.type for r in scenario.robots})]
    until = scenario.simulation.until or math.inf
    for i, surprise in enumerate(scenario.simulation.surprises):
        if surprise.at >= until:
            continue
        obstacle = obstacle_shape(surprise.obstacle)
        covered = [
            zone.name
            for zone in scenario.site.zones
            if zone.pose is not None
            and all(_is_under(body_shape(k.footprint, zone.pose), obstacle) for k in kinds)
        ]
        key = f"simulation.surprises[{i}]"
        if covered:
            names = ", ".join(covered[:SHOWN]) + (", ..." if len(covered) > SHOWN else "")
            text = (
                f"the obstacle covers {names} from {surprise.at:g} s on, so nobody can go there "
                "any more; move it, unless that is meant"
            )
            yield Finding("covered", "warning", key, text)
        standing = [
            robot.id
            for robot in scenario.robots
            if surprise.at == 0.0
            and _is_under(body_shape(scenario.type_of(robot).footprint, robot.start), obstacle)
        ]
        if standing:
            text = (
                f"the obstacle is there from the start, where {', '.join(standing[:SHOWN])} "
                "stands; move one of them, or list the obstacle in site.obstacles"
            )
            yield Finding("start_in_obstacle", "error", key, text, tuple(standing))


def _is_under(body: Shape, obstacle: Shape) -> bool:
    return body.overlap(obstacle) > OVERLAP
