"""Checks of an order against the site and the fleet that are to serve it."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, Final

from clearway.formats.scenario_error import Problem, closest
from clearway.formats.scenario_work import OrderTable, VisitTable
from clearway.model import LOAD_CHANGE, RobotType, Scenario
from clearway.model.task import Load

_NAMING: Final = {"robot", "fetches", "station", "visits"}


class OrderCheck:
    """Tells what is wrong with orders in a scenario, whose own orders do not matter."""

    def __init__(self, scenario: Scenario) -> None:
        self.poses = {z.name: z.pose for z in scenario.site.zones if z.pose is not None}
        self._robots = {robot.id: robot for robot in scenario.robots}
        self._kinds = scenario.robot_types
        shelves = {zone.name for zone in scenario.site.zones_of("shelf")}
        self._known: tuple[tuple[str, Collection[str], str], ...] = (
            ("robot", self._robots, "unknown robot"),
            ("fetches", shelves, "no shelf has this name"),
            ("station", self.poses, "no zone with a pose has this name"),
        )

    def __call__(self, order: OrderTable, where: str = "") -> Iterator[Problem]:
        """Yield all that is wrong; keys begin with ``where``, if given."""
        yield from self.names(order.model_dump(include=_NAMING), where)
        stops = order.stops()
        names = [
            where if order.visits is None else _at(where, f"visits[{j}]") for j in range(len(stops))
        ]
        for visit, at in zip(stops, names, strict=True):
            yield from self._together(visit, order, at)
        if order.robot is None or order.robot in self._robots:
            yield from self._able(order, names)

    def names(self, keys: Mapping[str, Any], where: str = "") -> Iterator[Problem]:
        """Yield the names that nothing has among the keys of an order, right or wrong else."""
        for key, known, what in self._known:
            name = keys.get(key)
            if isinstance(name, str) and name not in known:
                yield Problem(_at(where, key), name, what, closest(name, known))
        visits = keys.get("visits")
        for j, visit in enumerate(visits if isinstance(visits, list) else ()):
            if isinstance(visit, dict):
                at = _at(where, f"visits[{j}]")
                yield from self.names({"station": visit.get("station")}, at)

    def _together(self, visit: VisitTable, order: OrderTable, at: str) -> Iterator[Problem]:
        for k, other in enumerate(visit.together):
            key = _at(at, f"together[{k}]")
            if other not in self._robots:
                yield Problem(key, other, "unknown robot", closest(other, self._robots))
            elif other == order.robot or other in visit.together[:k]:
                what = "a robot does not wait for itself" if other == order.robot else "named twice"
                yield Problem(key, other, what, "name each other robot once")

    def _able(self, order: OrderTable, names: Sequence[str]) -> Iterator[Problem]:
        """Check that a robot that may do the order has what its visits need, and the room."""
        everybody = self._robots.values()
        candidates = [self._robots[order.robot]] if order.robot is not None else everybody
        whose = f"robot {order.robot}" if order.robot else "any robot"
        types = sorted({robot.type for robot in candidates if robot.type in self._kinds})
        kinds = [self._kinds[name] for name in types]
        stops = order.stops()
        for visit, at in zip(stops, names, strict=True):
            if visit.needs is None:
                continue
            kinds = [kind for kind in kinds if visit.needs in kind.capabilities]
            if not kinds:
                had = {name for kind in self._kinds.values() for name in kind.capabilities}
                mend = f"add it to capabilities of a robot type; {closest(visit.needs, had)}"
                what = f"is not a capability of {whose} that could do the rest of the task"
                yield Problem(_at(at, "needs"), visit.needs, what, mend)
                return
        yield from find_load_problems([visit.load for visit in stops], names, kinds, whose)


def _at(where: str, key: str) -> str:
    return f"{where}.{key}" if where else key


def find_load_problems(
    loads: Sequence[Load | None], names: Sequence[str], kinds: Sequence[RobotType], whose: str
) -> Iterator[Problem]:
    """Check that loads can be taken in this order, one a visit, by one of some robot types.

    ``names`` are the visits' keys; ``whose`` tells in words whose types these are.
    """
    carried = peak = peak_at = 0
    for j, load in enumerate(loads):
        carried += LOAD_CHANGE[load]
        if carried < 0:
            what = "drops a load that this task has not picked up"
            mend = "add a visit with load = 'pick' before"
            yield Problem(_at(names[j], "load"), load, what, mend)
            return
        if carried > peak:
            peak, peak_at = carried, j
    if kinds and peak > max(kind.capacity for kind in kinds):
        most = max(kind.capacity for kind in kinds)
        what = f"is load {peak} on board where {whose} carries at most {most}"
        mend = "drop a load before, or raise capacity of the robot type"
        yield Problem(_at(names[peak_at], "load"), "pick", what, mend)
