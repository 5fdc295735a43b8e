"""The nearest of the open orders to whoever is idle, away from where others work."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from clearway.assign.order_trips import OrderTrips
from clearway.model import Order, Pose, Scenario, to_seconds
from clearway.protocols import Alternative, Board, Choice, RobotView

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class NearestOrderParams:
    """What an order costs a robot beside the way to its first visit.

    Parameters
    ----------
    crowd
        Metres for each other robot that is to serve within sight of that visit; more keeps robots
        apart, and lets them drive farther.
    age
        Metres that each second of waiting takes off; more makes old orders go sooner. Above 0, so
        that every order's turn comes.
    refusal
        Metres for each time that no way was found for it; more turns sooner to another order.
    alternatives
        How many other orders are told beside the chosen one.
    """

    crowd: float = 30.0
    age: float = 0.1
    refusal: float = 10.0
    alternatives: int = 3

    def __post_init__(self) -> None:
        if not (math.isfinite(self.crowd) and self.crowd >= 0.0):
            raise ValueError(f"crowd must be 0 or above and finite, got {self.crowd}")
        if not (math.isfinite(self.refusal) and self.refusal >= 0.0):
            raise ValueError(f"refusal must be 0 or above and finite, got {self.refusal}")
        if not (math.isfinite(self.age) and self.age > 0.0):
            raise ValueError(f"age must be above 0 and finite, or orders starve; got {self.age}")


class NearestOrder:
    """Dispatches the cheapest pair of an idle robot and an open order, again and again.

    An order costs how much farther its first visit is from the robot than from where the nearest
    known order ends, for that far somebody has to come anyway: so remote orders are not left to the
    end. It costs more where other robots still have to serve their first visit within sight of its
    own, such as in the same aisle, and less with its age, so that none waits for ever. Orders of
    higher priority go before all others. A robot is asked for when its last service has ended:
    from then on its way to rest may be replaced, and nothing is gained by asking sooner.
    """

    def __init__(self, scenario: Scenario, params: NearestOrderParams | None = None) -> None:
        self.params = params or NearestOrderParams()
        self._trips = OrderTrips(scenario)
        self._walls = _walls(scenario)
        # Robots at work: first visit, and the tick at which it has probably been served.
        self._busy: dict[str, tuple[Pose, int]] = {}
        self._sight: dict[tuple[Pose, Pose], bool] = {}

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield the trips wanted, cheapest first."""
        idle = [view for view in board.robots.values() if view.is_idle]
        orders = self._trips.waiting(board) if idle else []
        self._busy = {
            robot: (pose, until)
            for robot, (pose, until) in self._busy.items()
            if until > board.now and not board.robots[robot].is_idle
        }
        while idle and orders:
            costs = self._costs(idle, orders, board)
            best = max(
                (o.priority for j, o in enumerate(orders) if costs[:, j].min() < math.inf),
                default=None,
            )
            if best is None:
                return
            urgent = [o.priority == best for o in orders]
            pair = np.where(urgent, costs, math.inf).argmin()
            i, j = divmod(int(pair), len(orders))
            view, order = idle.pop(i), orders[j]
            choice = self._choice(view, order, orders, costs[i])
            yield choice
            if board.robots[view.id].trip is choice.trip:
                self._busy[view.id] = _first_visit(view, order, board)
                del orders[j]

    def _choice(
        self, view: RobotView, order: Order, orders: Sequence[Order], costs: Floats
    ) -> Choice:
        ranked = sorted(
            (
                Alternative(other.task.id, float(cost))
                for other, cost in zip(orders, costs, strict=True)
                if cost < math.inf and other is not order
            ),
            key=lambda one: one.score,
        )
        cost = float(costs[[other is order for other in orders].index(True)])
        away = order.visits[0].pose.distance(view.pose)
        because = f"{order.task.id} is {away:.0f} m from {view.id}"
        crowd = self._crowd([order])[0]
        if crowd:
            because += f", with {crowd:.0f} others at work within sight"
        trip = self._trips.trip(view, order)
        others = tuple(ranked[: self.params.alternatives])
        return Choice(trip, "order", order.task.id, cost, others, because=because)

    def _costs(self, idle: Sequence[RobotView], orders: Sequence[Order], board: Board) -> Floats:
        """Return what each order costs each robot (m), ``(robots, orders)``; infinite: not his."""
        at = np.array([(view.pose.x, view.pose.y) for view in idle])
        to = np.array([(o.visits[0].pose.x, o.visits[0].pose.y) for o in orders])
        ends = np.array([(o.visits[-1].pose.x, o.visits[-1].pose.y) for o in board.open.values()])
        away = np.linalg.norm(at[:, None] - to[None], axis=2)
        away -= np.linalg.norm(ends[:, None] - to[None], axis=2).min(axis=0)
        age = np.array([to_seconds(board.now) - order.release for order in orders])
        refused = np.array([board.refusals.get(order.task.id, 0) for order in orders])
        away = away + self.params.refusal * refused
        costs: Floats = away + self.params.crowd * self._crowd(orders) - self.params.age * age
        for i, view in enumerate(idle):
            for j, order in enumerate(orders):
                if not self._trips.may(view, order):
                    costs[i, j] = math.inf
        return costs

    def _crowd(self, orders: Sequence[Order]) -> Floats:
        """Return how many robots still have to serve a first visit within sight of each order's."""
        firsts = [order.visits[0].pose for order in orders]
        pairs = [(a, b) for a in firsts for b, _ in self._busy.values()]
        new = [pair for pair in dict.fromkeys(pairs) if pair not in self._sight]
        if new:
            lines = shapely.linestrings([((a.x, a.y), (b.x, b.y)) for a, b in new])
            clear = ~shapely.intersects(self._walls, lines)
            self._sight.update(zip(new, map(bool, clear), strict=True))
        seen = np.array([self._sight[pair] for pair in pairs], dtype=np.float64)
        crowd = seen.reshape(len(firsts), len(self._busy)).sum(axis=1)
        if len(self._sight) > 100_000:
            self._sight.clear()
        return np.asarray(crowd)


def _walls(scenario: Scenario) -> shapely.Geometry:
    """Return what blocks the sight: obstacles that stop everybody."""
    shapes: list[shapely.Geometry] = []
    for obstacle in scenario.site.obstacles:
        if obstacle.blocks:
            continue
        if obstacle.polygon is not None:
            shapes.append(shapely.Polygon(obstacle.polygon))
        elif obstacle.disc is not None:
            x, y, radius = obstacle.disc
            shapes.append(shapely.Point(x, y).buffer(radius))
        elif obstacle.wall is not None:
            shapes.append(shapely.LineString(obstacle.wall))
    walls = shapely.union_all(shapes)
    shapely.prepare(walls)
    return walls


def _first_visit(view: RobotView, order: Order, board: Board) -> tuple[Pose, int]:
    """Return the first visit's pose and the tick by which it has probably been served.

    The planner tells when the last service ends; the time until then is shared out by length.
    """
    poses = [view.pose, *(visit.pose for visit in order.visits)]
    lengths = [a.distance(b) for a, b in pairwise(poses)]
    total = sum(lengths)
    share = lengths[0] / total if total > 0.0 else 1.0
    end = board.robots[view.id].ready
    return poses[1], board.now + math.ceil(share * (end - board.now))
