"""Orders with visits as trips: which may begin, who may do them, where one rests afterwards."""

from clearway.model import LOAD_CHANGE, Order, Scenario, Trip
from clearway.protocols import Board, RobotView


class OrderTrips:
    """Turns open orders with visits into trips.

    A trip has the order's visits; afterwards the robot rests in any zone of kind ``parking``, or at
    its last visit where the site has none.
    """

    def __init__(self, scenario: Scenario) -> None:
        self._types = scenario.robot_types
        zones = [zone for zone in scenario.site.zones if zone.pose is not None]
        self._names = {zone.pose: zone.name for zone in zones}
        self._rests = tuple(zone.name for zone in zones if zone.kind == "parking")
        self._known: set[str] = set()

    def waiting(self, board: Board) -> list[Order]:
        """Return open orders that nobody has and that wait for no other, as they arrived.

        Raises
        ------
        ValueError
            If an order fetches a shelf.
        """
        self._known.update(board.open)
        found = []
        for name, order in board.open.items():
            if order.task.fetches is not None:
                raise ValueError(
                    f"order {name} fetches shelf {order.task.fetches}, but robots here do visits; "
                    "give it visits, or choose a system that moves shelves"
                )
            if name in board.taken:
                continue
            if all(other in self._known and other not in board.open for other in order.after):
                found.append(order)
        return found

    def may(self, view: RobotView, order: Order) -> bool:
        """Whether a robot may do an order: not kept for another, with what its visits need."""
        kind = self._types[view.type]
        if order.task.robot not in (None, view.id):
            return False
        loads = len(view.carries)
        for visit in order.visits:
            loads += LOAD_CHANGE[visit.load]
            if loads > kind.capacity or (visit.needs and visit.needs not in kind.capabilities):
                return False
        return True

    def trip(self, view: RobotView, order: Order) -> Trip:
        """Return the trip of a robot that does an order."""
        goals = tuple(self._names.get(visit.pose) for visit in order.visits)
        return Trip(view.id, order.visits, "order", order.task.id, goals, self._rests)
