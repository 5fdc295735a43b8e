"""New ways for robots whose committed ones run into an obstacle."""

from collections.abc import Iterator, MutableMapping, Sequence
from dataclasses import replace

import shapely

from clearway import _core
from clearway.model import Commitment, Obstacle, Pose, Stop, Trajectory, to_ticks
from clearway.plan.lane_motion import numbered, split, trajectory_of
from clearway.plan.lane_ways import LaneWay, LaneWays
from clearway.world.lane_grid import Cell
from clearway.world.shapes import Shape, obstacle_shape

TOUCH = 1e-3  # m; an obstacle this deep in a cell closes it
MOST_REFUGES = 8  # endpoints that a robot without a way to its goal tries


class LaneDetours:
    """Commits robots anew, at tick ``now``, that would come into cells which an obstacle closes.

    Parameters
    ----------
    committed
        Everybody's commitments by robot, changed in place.
    loaded
        Whether robots carry something after their trips.
    notice
        Ticks for which robots do as they were told, where the obstacle leaves room for it.
    limit
        Expansions of a search.
    """

    def __init__(
        self,
        ways: LaneWays,
        committed: MutableMapping[str, Commitment],
        loaded: MutableMapping[str, bool],
        now: int,
        notice: int,
        limit: int,
    ) -> None:
        self._ways, self._holds = ways, ways.holds
        self._committed, self._loaded = committed, loaded
        self._old = dict(committed)
        self._now, self._granted, self._limit = now, now + notice, limit
        self._closed: set[int] = set()
        self._standing: set[int] = set()  # robots that found no way

    def __call__(self, obstacle: Obstacle) -> tuple[str, ...]:
        """Close the obstacle's cells; return the robots that are committed anew."""
        cells = list(self._covered(obstacle))
        self._ways.close(cells)
        self._closed = {self._ways.index(cell) for cell in cells}
        changed: dict[str, None] = {}
        while True:
            # Who is farther behind gives way first to those who have to come back.
            concerned = [
                (self._holds.route(me)[end].arrive, me)
                for me in range(len(self._ways.names))
                if me not in self._standing and (end := self._end(me)) is not None
            ]
            if not concerned:
                break
            me = max(concerned)[1]
            changed[self._ways.names[me]] = None
            end = self._end(me)
            assert end is not None
            route = self._holds.route(me)
            if not self._detour(me, self._stops(route, end)):
                self._stand(me, end)
        for me in self._standing:  # others may have made way
            route = self._holds.route(me)
            if route[-1].arrive < _core.NEVER - 1:
                self._detour(me, [len(route) - 1])
        return tuple(changed)

    def _covered(self, obstacle: Obstacle) -> Iterator[Cell]:
        grid, shape = self._ways.grid, obstacle_shape(obstacle)
        x0, y0, x1, y1 = shape.geometry.buffer(shape.radius).bounds
        width, height = grid.size
        for y in range(max(0, int(y0 // grid.cell)), min(height, int(y1 // grid.cell) + 1)):
            for x in range(max(0, int(x0 // grid.cell)), min(width, int(x1 // grid.cell) + 1)):
                low = (x * grid.cell + TOUCH, y * grid.cell + TOUCH)
                side = grid.cell - 2.0 * TOUCH
                box = shapely.box(*low, low[0] + side, low[1] + side)
                if Shape(box).gap(shape) <= 0.0:
                    yield x, y

    def _end(self, me: int) -> int | None:
        """Return the first node of a robot's route that it must not come to; ``None``: all well."""
        route = self._holds.route(me)
        ends = [
            k
            for k, stay in enumerate(route)
            if stay.cell in self._closed and stay.arrive > self._now
        ]
        if self._standing:
            # Where it has been is over: what is kept of a past after delays is not exact.
            at = max((k for k, stay in enumerate(route) if stay.arrive <= self._now), default=0)
            here, ahead = route[at], route[at + 1 :]
            since = max(here.arrive, min(here.depart, self._now))
            here = _core.CellStay(here.cell, since, here.depart, here.turn_begin, here.turn_end)
            ends += [
                at + clash.index
                for clash in self._holds.clashes(me, [here, *ahead])
                if clash.other in self._standing and clash.index > 0
            ]
        return min(ends, default=None)

    def _detour(self, me: int, nodes: Sequence[int]) -> bool:
        """Find another way for a robot from one of its nodes; say whether there is one."""
        route = self._holds.route(me)
        trajectory = self._committed[self._ways.names[me]].trajectory
        for goal, any_direction in self._goals(me, route[-1].cell):
            for node in nodes:
                ready = self._ready(route[node])
                start = trajectory.at(ready)
                way = self._ways.earliest(
                    me, start, goal, ready, self._granted, self._limit, any_direction
                )
                if way is not None:
                    self._take(me, node, ready, goal, way)
                    return True
        return False

    def _goals(self, me: int, near: int) -> Iterator[tuple[Pose, bool]]:
        """Yield where a robot may go, and whether against lanes: its goal first, then refuges."""
        trip = self._old[self._ways.names[me]].trip
        grid = self._ways.grid
        if trip is not None:
            yield trip.visits[0].pose, False
            yield trip.visits[0].pose, True
        x, y = self._ways.cell(near)
        refuges = sorted(
            (abs(point.cell[0] - x) + abs(point.cell[1] - y), point.name)
            for point in grid.endpoints.values()
            if self._ways.owner(point.cell, me) is None
            and self._ways.index(point.cell) not in self._closed
        )
        for _, name in refuges[:MOST_REFUGES]:
            yield grid.centre(grid.endpoints[name].cell), True

    def _stops(self, route: list[_core.CellStay], end: int) -> list[int]:
        """Return nodes at which a robot may stop, best first: those that nobody has granted it."""
        nodes = [
            k
            for k in range(end)
            if self._ways.may_wait[self._ways.cell(route[k].cell)[::-1]]
            and max(route[k].arrive, route[k].depart) >= self._now
        ]
        later = [k for k in nodes if route[k].arrive >= self._granted]
        return later + [k for k in reversed(nodes) if k not in later]

    def _ready(self, stay: _core.CellStay) -> int:
        """Return when a robot that stops at a node may do something else there."""
        if stay.turn_begin < self._now < stay.turn_end:
            return stay.turn_end
        return max(stay.arrive, self._now)

    def _take(self, me: int, node: int, ready: int, goal: Pose, way: LaneWay) -> None:
        name = self._ways.names[me]
        driven, trip = self._committed[name].trajectory, self._old[name].trip
        route = self._holds.route(me)
        first, *rest = way.stays
        joined = _core.CellStay(
            first.cell, route[node].arrive, first.depart, first.turn_begin, first.turn_end
        )
        self._holds.put(me, [*route[:node], joined, *rest])
        kept = _until(driven, ready)
        stops: tuple[Stop, ...] = ()
        if trip is not None and goal != trip.visits[0].pose:
            trip = None
        if trip is not None:
            visit = trip.visits[0]
            arrive = max(way.done, to_ticks(visit.not_before))
            stops = (Stop(0, arrive, arrive + to_ticks(visit.service)),)
        loaded = _carries(self._old[name])
        start = driven.at(ready)
        new = trajectory_of(self._ways.grid, name, start, way.stays, goal, stops, loaded)
        load = None if trip is None else trip.visits[0].load
        self._loaded[name] = loaded if load is None else load == "pick"
        rests = {point.cell: point.name for point in self._ways.grid.endpoints.values()}
        self._committed[name] = Commitment(
            name,
            replace(
                new,
                start=kept.start,
                pieces=numbered([*kept.pieces, *new.pieces]),
                timing=kept.timing + new.timing,
            ),
            trip,
            rests[self._ways.grid.cell_at(goal)],
            tuple(w for w in self._old[name].waits if w.end is not None and w.end <= ready)
            + way.waits,
        )

    def _stand(self, me: int, end: int) -> None:
        """Let a robot stand in front of what is in its way: outside crossings, if it still can."""
        self._standing.add(me)
        name = self._ways.names[me]
        old, route = self._committed[name], self._holds.route(me)
        node = max(self._stops(route, end), default=end - 1)
        stay = route[node]
        if stay.depart >= self._now:
            ready = max(stay.arrive, self._now)
            stays = [*route[:node], _core.CellStay(stay.cell, stay.arrive, _core.NEVER)]
        else:  # it is between two cells, and holds both for ever
            ready = self._now
            ahead = _core.CellStay(route[end].cell, _core.NEVER - 1, _core.NEVER)
            stays = [*route[:end], ahead]
        self._holds.put(me, stays)
        self._loaded[name] = _carries(self._old[name])
        self._committed[name] = Commitment(name, _until(old.trajectory, ready))


def _carries(commitment: Commitment) -> bool:
    """Whether a robot that has not served its trip yet is loaded."""
    pieces = commitment.trajectory.pieces
    return bool(pieces) and pieces[-1].loaded


def _until(trajectory: Trajectory, tick: int) -> Trajectory:
    """Return what is driven before a tick, without stops."""
    path = split(trajectory, tick)
    count = sum(end <= tick for _, end in path.timing)
    return Trajectory(path.robot, path.start, path.pieces[:count], path.timing[:count])
