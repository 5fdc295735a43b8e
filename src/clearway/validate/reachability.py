"""Which robots no obstacle keeps from which tasks."""

from collections.abc import Mapping, Set
from dataclasses import dataclass

from clearway.model import Pose, RobotType, Scenario, Task
from clearway.validate.suitability import able_robots, load_states
from clearway.world.reach import BodyReach
from clearway.world.shapes import body_shape


@dataclass(frozen=True)
class Shut:
    """A task no robot can do: its first visit that is out of reach, and the disc that shows it.

    ``proof`` is false where a robot might carry some other load on the way, with which it
    is smaller than without.
    """

    visit: int
    radius: float
    robots: tuple[str, ...]
    proof: bool


class Ways:
    """Components of free space by robot type and load state, made when first asked for."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._made: dict[tuple[str, bool], BodyReach] = {}

    def of(self, kind: RobotType, loaded: bool) -> BodyReach:
        """Return where bodies of a type may travel."""
        if (kind.name, loaded) not in self._made:
            reach = BodyReach(self._scenario.site, kind.name, loaded, kind.shape(loaded))
            self._made[kind.name, loaded] = reach
        return self._made[kind.name, loaded]


def find_reachable(
    scenario: Scenario, unfit: Set[tuple[int, str]]
) -> tuple[Mapping[str, frozenset[str]], Mapping[int, Shut]]:
    """Return the task ids each robot can reach, and by order index the tasks that none can.

    A robot reaches a task if the largest disc in its body is not shut off from any visit,
    unloaded on the way to the first and then with the task's own loads; one that fetches, if
    it is not shut off from the shelf. Components of the unloaded body hold for whatever else it
    carries, as long as a load makes it no smaller. Types that are ``unfit`` for an order (its
    index, the type's name), because they cannot stand at one of its poses, do not count.
    """
    ways = Ways(scenario)
    at_start = {
        robot.id: ways.of(scenario.type_of(robot), False).component(robot.start)
        for robot in scenario.robots
    }
    reached: dict[str, set[str]] = {robot.id: set() for robot in scenario.robots}
    shut: dict[int, Shut] = {}
    shelves = {zone.name: zone.pose for zone in scenario.site.zones_of("shelf")}
    for i, order in enumerate(scenario.orders):
        task = order.task
        if not task.visits:
            pose = shelves.get(task.fetches or "")
            fit = able_robots(scenario, task)
            if pose is not None:
                names = {robot.type for robot in fit}
                kinds = {name: scenario.robot_types[name] for name in names}
                here = {name: ways.of(k, False).component(pose) for name, k in kinds.items()}
                fit = tuple(r for r in fit if at_start[r.id] == here[r.type] != 0)
            for robot in fit:
                reached[robot.id].add(task.id)
            continue
        able = [r for r in able_robots(scenario, task) if (i, r.type) not in unfit]
        kinds = {robot.type: scenario.type_of(robot) for robot in able}
        first = {
            name: ways.of(k, False).component(task.visits[0].pose) for name, k in kinds.items()
        }
        stuck = {name: _stuck_at(task, kind, ways) for name, kind in kinds.items()}
        stopped: list[tuple[int, str]] = []
        for robot in able:
            comes = at_start[robot.id] == first[robot.type] != 0
            stop = stuck[robot.type] if comes else 0
            if stop is None:
                reached[robot.id].add(task.id)
            else:
                stopped.append((stop, robot.type))
        if able and len(stopped) == len(able):
            visit, name = max(stopped)
            radius = ways.of(kinds[name], load_states(task)[visit][0]).radius
            proof = all(_load_only_adds(kind) for kind in kinds.values())
            shut[i] = Shut(visit, radius, tuple(robot.id for robot in able), proof)
    return {name: frozenset(tasks) for name, tasks in reached.items()}, shut


def _stuck_at(task: Task, kind: RobotType, ways: Ways) -> int | None:
    """Return the first visit that is shut off from the one before it, if any."""
    visits, states = task.visits, load_states(task)
    for j in range(1, len(visits)):
        reach = ways.of(kind, states[j][0])
        here = reach.component(visits[j - 1].pose)
        if not here or here != reach.component(visits[j].pose):
            return j
    return None


def _load_only_adds(kind: RobotType) -> bool:
    if kind.loaded_footprint is None:
        return True
    at_origin = Pose(0.0, 0.0, 0.0)
    full = body_shape(kind.loaded_footprint, at_origin)
    empty = body_shape(kind.footprint, at_origin)
    if full.radius:
        return kind.footprint.circumradius <= full.radius
    around = full.geometry.buffer(1e-9)
    return bool(
        around.covers(empty.geometry) and around.boundary.distance(empty.geometry) >= empty.radius
    )
