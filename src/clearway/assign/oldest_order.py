"""The most urgent, then oldest, order to the nearest idle robot."""

from collections.abc import Iterator

from clearway.assign.order_trips import OrderTrips
from clearway.model import Scenario
from clearway.protocols import Alternative, Board, Choice

ALTERNATIVES = 3  # told beside the robot that was chosen


class OldestOrder:
    """Dispatches open orders, each to the idle robot nearest to its first visit.

    More urgent orders go first, those of one priority as they arrived.

    Where no way is found for that robot, the next nearest one is tried.
    """

    def __init__(self, scenario: Scenario) -> None:
        self._trips = OrderTrips(scenario)

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield the trips wanted, most urgent, then oldest, order first."""
        idle = [view for view in board.robots.values() if view.is_idle]
        orders = self._trips.waiting(board) if idle else []
        for order in sorted(orders, key=lambda order: -order.priority):
            first = order.visits[0].pose
            able = [view for view in idle if self._trips.may(view, order)]
            able.sort(key=lambda view: first.distance(view.pose))
            ranked = [Alternative(view.id, first.distance(view.pose)) for view in able]
            for k, view in enumerate(able):
                trip = self._trips.trip(view, order)
                others = tuple(ranked[k + 1 : k + 1 + ALTERNATIVES])
                because = f"{trip.order} is the oldest order that can begin, {view.id} is nearest"
                if k > 0:
                    because += f" of those not refused ({', '.join(v.id for v in able[:k])})"
                yield Choice(trip, "robot", view.id, ranked[k].score, others, because=because)
                if board.robots[view.id].trip is trip:
                    idle.remove(view)
                    break
