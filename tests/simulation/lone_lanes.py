"""The plainest fleet there is: each robot drives along a lane of its own, so nobody meets."""

from collections.abc import Iterator, Mapping, Sequence

from clearway.model import (
    Battery,
    Commitment,
    Footprint,
    Limits,
    Obstacle,
    Order,
    Piece,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Simulation,
    Site,
    Stop,
    Task,
    Trajectory,
    Trip,
    Visit,
    to_ticks,
)
from clearway.protocols import Board, Choice, Refusal


def lanes(robots: int, goals: Sequence[tuple[str, int, float]], **simulation: object) -> Scenario:
    """Return robots at x = 0 of lanes 2 m apart; orders ``(id, lane, x)`` with 2 s of service."""
    kind = RobotType(
        "cart",
        Footprint.rectangle(0.8, 0.8),
        "differential",
        Limits(1.0),
        battery=Battery(1000.0),
    )
    return Scenario(
        "lanes",
        Site(((-1.0, -1.0), (101.0, -1.0), (101.0, 2.0 * robots), (-1.0, 2.0 * robots))),
        {"cart": kind},
        tuple(Robot(f"r{i}", "cart", Pose(0.0, 2.0 * i, 0.0)) for i in range(robots)),
        tuple(
            Order(Task(id_, (Visit(id_, Pose(x, 2.0 * lane, 0.0), 2.0),), f"r{lane}"), release)
            for release, (id_, lane, x) in enumerate(goals)
        ),
        simulation=Simulation(**simulation),  # type: ignore[arg-type]
    )


class AlongLanes:
    """Drives straight to a visit at 1 m/s, forwards or backwards; refuses x beyond 100 m."""

    def __init__(self, scenario: Scenario) -> None:
        self._commitments = {
            r.id: Commitment(r.id, Trajectory(r.id, r.start)) for r in scenario.robots
        }
        self.efforts: list[int] = []

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        self.efforts.append(effort)
        visit = trip.visits[0]
        if visit.pose.x > 100.0:
            return Refusal("beyond the end", ("wall",), for_good=visit.pose.x > 1000.0)
        at = self._commitments[trip.robot].trajectory.final_pose
        lasts = to_ticks(abs(visit.pose.x - at.x))
        pieces = (Piece(0, None, at, (visit.pose.x - at.x, 0.0, 0.0)),) if lasts else ()
        timing = ((now, now + lasts),) if lasts else ()
        stop = Stop(0, now + lasts, now + lasts + to_ticks(visit.service))
        path = Trajectory(trip.robot, at, pieces, timing, (stop,))
        self._commitments[trip.robot] = Commitment(trip.robot, path, trip)
        return self._commitments[trip.robot]

    def commitment(self, robot: str) -> Commitment:
        return self._commitments[robot]

    @property
    def changed(self) -> Sequence[Commitment]:
        return ()

    @property
    def counters(self) -> Mapping[str, int]:
        return {"expansions": len(self.efforts)}

    def retime(self, trajectories: Mapping[str, Trajectory], now: int) -> None:
        raise NotImplementedError

    def block(self, obstacle: Obstacle, now: int, lead: int = 0) -> tuple[str, ...]:
        return ()


def oldest_first(board: Board) -> Iterator[Choice]:
    """Yield the oldest order of each idle robot."""
    for view in tuple(board.robots.values()):
        mine = [o for o in board.open.values() if o.task.robot == view.id]
        if view.is_idle and mine:
            order = mine[0]
            trip = Trip(view.id, order.visits, "order", order.task.id)
            yield Choice(trip, "order", order.task.id, 0.0)


class Listed:
    """A scenario's own orders at their release."""

    def __init__(self, scenario: Scenario) -> None:
        self._ahead = sorted(scenario.orders, key=lambda order: order.release)

    def next_tick(self) -> int | None:
        return to_ticks(self._ahead[0].release) if self._ahead else None

    def pop(self, now: int) -> list[Order]:
        popped = [order for order in self._ahead if to_ticks(order.release) <= now]
        self._ahead = self._ahead[len(popped) :]
        return popped

    def taken(self, order: str, now: int) -> None:
        pass

    @property
    def exhausted(self) -> bool:
        return not self._ahead
