"""Robots whose batteries are low charge, whatever a dispatcher wants of them."""

from collections.abc import Iterator

from clearway.model import Battery, Pose, Scenario, Trip, Visit
from clearway.protocols import Alternative, Board, Choice, Dispatcher, RobotView


class Charging:
    """Sends robots below their reserve to the nearest free charger, others where ``inner`` does.

    A charger is a zone of kind ``charger`` with a pose; it is free unless a robot is on its way to
    it or there. A robot charges up to the level that its battery calls full, and rests in a
    parking zone afterwards. Where there is no charger, levels are ignored.

    Parameters
    ----------
    inner
        Dispatcher of orders; what it wants of a robot with a low battery counts as refused.
    """

    def __init__(self, scenario: Scenario, inner: Dispatcher) -> None:
        self._inner = inner
        self._battery: dict[str, Battery | None] = {
            robot.id: scenario.type_of(robot).battery for robot in scenario.robots
        }
        site = scenario.site
        self._chargers: dict[str, Pose] = {
            zone.name: zone.pose for zone in site.zones_of("charger") if zone.pose is not None
        }
        self._rests = tuple(zone.name for zone in site.zones_of("parking") if zone.pose)

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield trips to chargers, then those of others."""
        low = {view.id for view in board.robots.values() if view.is_idle and self._is_low(view)}
        for robot in sorted(low, key=lambda one: (board.robots[one].energy, one)):
            choice = self._charge(board.robots[robot], board)
            if choice is not None:
                yield choice
        for choice in self._inner(board):
            if choice.trip.robot not in low:
                yield choice

    def _is_low(self, view: RobotView) -> bool:
        battery = self._battery[view.id]
        return battery is not None and bool(self._chargers) and view.energy < battery.reserve

    def _charge(self, view: RobotView, board: Board) -> Choice | None:
        battery = self._battery[view.id]
        assert battery is not None
        trips = [other.trip for other in board.robots.values() if other.trip is not None]
        taken = {goal for trip in trips if trip.purpose == "charge" for goal in trip.goals}
        free = sorted(
            (pose.distance(view.pose), name)
            for name, pose in self._chargers.items()
            if name not in taken
        )
        if not free:
            return None
        ranked = [Alternative(name, away) for away, name in free]
        nearest = ranked[0]
        service = (battery.full - view.energy) * battery.charging
        visit = Visit(None, self._chargers[nearest.name], round(service, 3))
        trip = Trip(view.id, (visit,), "charge", None, (nearest.name,), self._rests)
        because = f"the battery of {view.id} is at {100.0 * view.energy:.0f} %"
        return Choice(
            trip, "charger", nearest.name, nearest.score, tuple(ranked[1:4]), because=because
        )
