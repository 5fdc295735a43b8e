"""The oldest order to the nearest idle robot, the nearest station, the nearest place."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from clearway.assign.shelf_cycle import ShelfCycle, ShelfParams
from clearway.model import Order, Scenario
from clearway.protocols import Alternative, Board, Choice, RobotView

# Distance (m) from one endpoint to another, by name; never below the Manhattan distance.
Distance = Callable[[str, str], float]
TRIES = 3  # refusals of an order after which another robot is asked for


class NearestIdle(ShelfCycle):
    """The dispatching rules of system B.

    More urgent orders first, then first come first served, skipping those whose shelf is
    unavailable (R-B15); the nearest available robot to the shelf (R-B16); when it is lifted, the
    nearest available station (R-B17); then the vacant place nearest to the station (R-B18). Ties go
    to the one named first in the scenario. An order that is refused again and again goes to the
    next nearest robot.

    Parameters
    ----------
    distance
        What "nearest" means; ``None``: Manhattan.

    References
    ----------
    Yu, C., Liao, W., Zu, L. (2024). Dynamic scheduling optimization method for multi-AGV-based
    intelligent warehouse considering bidirectional channel. Systems 12(1), 9, Sec. 4.
    """

    def __init__(
        self,
        scenario: Scenario,
        params: ShelfParams | None = None,
        distance: Distance | None = None,
    ) -> None:
        super().__init__(scenario, params)
        self._distance = distance

    def _committed(self, choice: Choice, board: Board) -> None:
        """Nearest first needs no memory."""

    def _driven_off(self, view: RobotView, now: int) -> None:
        """Nearest first needs no memory."""

    def _begin(self, board: Board) -> Iterator[Choice]:
        refused: list[tuple[int, Order]] = []
        passed: list[str] = []  # robots that could not take an order now
        while len(self.idle):
            taken = self._pop_order(board)
            if taken is None:
                break
            number, order = taken
            shelf = order.task.fetches or ""
            place = self.yard.where[shelf] or ""
            turn = board.refusals.get(order.task.id, 0) // TRIES
            ranked = self._robots(place, 1 + self.params.alternatives + turn)
            owner = self.yard.owner(place)
            if owner in self._barred_robots(place):
                # It cannot get away, so that nobody else gets there: it is to say so.
                ranked = [Alternative(owner or "", 0.0)]
            if not ranked:
                if self._may_others_fetch(None, place, board):
                    refused.append(taken)  # until one of them is idle
                    continue
                ranked = self.idle.nearest(self.yard.pose[place])
            k = turn % len(ranked)
            ranked = ranked[k:] + ranked[:k]
            view = board.robots[ranked[0].name]
            because = f"{view.id} is the nearest available robot to {shelf}, the oldest open order"
            if order.priority:
                because = f"{because} of priority {order.priority:g}"
            choice = self._fetch(view, order, "robot", ranked, because)
            choice = replace(choice, elsewhere=self._may_others_fetch(view.id, place, board))
            yield choice
            if board.robots[view.id].trip is choice.trip:
                self._commit_fetch(choice, number, order, board)
            else:
                refused.append(taken)
                passed.append(view.id)
                self.idle.discard(view.id)
        for robot in passed:
            self._be_idle(board.robots[robot])
        for number, order in refused:
            self._put_back(number, order)

    def _robots(self, place: str, number: int) -> list[Alternative]:
        """Return the nearest available robots that may drive to a place."""
        without = self._barred_robots(place)
        return self.idle.nearest(self.yard.pose[place], number, self._to(place), without)

    def _stations(self, view: RobotView, shelf: str, number: int) -> list[Alternative]:
        barred = self._barred_from(view.id)
        return self.yard.stations.nearest(view.pose, number, self._from(view), barred)

    def _places(self, view: RobotView, number: int) -> list[Alternative]:
        barred = self._barred_from(view.id)
        return self.yard.vacant.nearest(view.pose, number, self._from(view), barred)

    def _to(self, place: str) -> Callable[[str], float] | None:
        distance = self._distance
        if distance is None:
            return None
        return lambda robot: distance(self.yard.owned(robot) or "", place)

    def _from(self, view: RobotView) -> Callable[[str], float] | None:
        distance, place = self._distance, self.yard.owned(view.id)
        if distance is None or place is None:
            return None
        return lambda other: distance(place, other)
