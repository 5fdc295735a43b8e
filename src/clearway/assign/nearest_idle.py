"""The oldest order to the nearest idle robot, the nearest station, the nearest place."""

from collections.abc import Callable, Iterator

from clearway.assign.shelf_cycle import ShelfCycle, ShelfParams
from clearway.model import Order, Scenario
from clearway.protocols import Alternative, Board, Choice, RobotView

# Distance (m) from one endpoint to another, by name; never below the Manhattan distance.
Distance = Callable[[str, str], float]


class NearestIdle(ShelfCycle):
    """The dispatching rules of system B.

    Orders first come first served, skipping those whose shelf is unavailable (R-B15); the
    nearest available robot to the shelf (R-B16); when it is lifted, the nearest available station
    (R-B17); then the vacant place nearest to the station (R-B18). Ties go to the one named first
    in the scenario.

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
            ranked = self.idle.nearest(
                self.yard.pose[place], 1 + self.params.alternatives, self._to(place)
            )
            view = board.robots[ranked[0].name]
            because = f"{view.id} is the nearest available robot to {shelf}, the oldest open order"
            choice = self._fetch(view, order, "robot", ranked, because)
            yield choice
            if board.robots[view.id].trip is choice.trip:
                self._commit_fetch(choice, order, board)
            else:
                refused.append(taken)
                passed.append(view.id)
                self.idle.discard(view.id)
        for robot in passed:
            self._be_idle(board.robots[robot])
        for number, order in refused:
            self._put_back(number, order)

    def _stations(self, view: RobotView, shelf: str, number: int) -> list[Alternative]:
        at = self.yard.owned(view.id) or ""
        return self.yard.stations.nearest(self.yard.pose[at], number, self._from(at))

    def _places(self, view: RobotView, number: int) -> list[Alternative]:
        at = self.yard.owned(view.id) or ""
        return self.yard.vacant.nearest(self.yard.pose[at], number, self._from(at))

    def _to(self, place: str) -> Callable[[str], float] | None:
        distance = self._distance
        if distance is None:
            return None
        return lambda robot: distance(self.yard.owned(robot) or "", place)

    def _from(self, place: str) -> Callable[[str], float] | None:
        distance = self._distance
        if distance is None:
            return None
        return lambda other: distance(place, other)
