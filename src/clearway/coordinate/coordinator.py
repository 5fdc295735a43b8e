"""The lifelong loop: what a fleet tells comes in, what it shall do goes out."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from clearway.model import TICKS_PER_SECOND, Commitment, Robot, Trip, Visit
from clearway.protocols import (
    Board,
    Choice,
    Decision,
    Dispatcher,
    Observation,
    Refusal,
    RobotView,
    Told,
    TripEnded,
    TripPlanner,
)


@dataclass(frozen=True)
class CoordinatorParams:
    """Patience of the loop.

    Parameters
    ----------
    retry
        Ticks after which a refused robot is tried again, doubled with each refusal.
    most_retry
        Ticks between two tries at the most.
    most_effort
        By how much the effort for a robot that is refused again and again may grow.
    most_tries
        Refusals in a row after which a robot is tried again only when something happens; more
        let a run without hope end later.
    lead
        Ticks from now on in which robots may do what they have been granted; new motion begins
        no sooner.
    """

    retry: int = TICKS_PER_SECOND
    most_retry: int = 8 * TICKS_PER_SECOND
    most_effort: int = 16
    most_tries: int = 40
    lead: int = 0


class Coordinator:
    """Holds open orders and everybody's commitments; asks a dispatcher and a planner of trips.

    It knows no clock but the ticks it is told, and cannot tell which fleet it steers.

    Parameters
    ----------
    cpu
        Source of the CPU seconds told with each decision; absent: none are told.
    """

    def __init__(
        self,
        robots: Sequence[Robot],
        dispatch: Dispatcher,
        trips: TripPlanner,
        params: CoordinatorParams | None = None,
        cpu: Callable[[], float] | None = None,
    ) -> None:
        self._dispatch, self._trips = dispatch, trips
        self._params = params or CoordinatorParams()
        self._cpu = cpu or (lambda: 0.0)
        self._board = Board(0, {r.id: RobotView(r.id, r.type, r.start) for r in robots})
        for robot in robots:
            self._see(robot.id, energy=robot.energy, place=trips.commitment(robot.id).rest)
        self._completes: dict[str, bool] = {}
        self._refused: dict[str, tuple[int, int]] = {}  # robot: times in a row, tick to try again
        # Planners lead robots out of the way at once, which the fleet must learn.
        self._untold = [r.id for r in robots if trips.commitment(r.id).trajectory.pieces]

    @property
    def open_orders(self) -> int:
        """Number of orders that are not done yet."""
        return len(self._board.open)

    def decide(self, seen: Observation) -> Decision:
        """Return what the fleet shall do now."""
        board = self._board
        board.now = seen.now
        changed = {robot: self._trips.commitment(robot) for robot in self._untold}
        self._untold = []
        failed: dict[str, str] = {}
        if seen.trajectories is not None:
            self._trips.retime(seen.trajectories, seen.now)
            self._see_ready(seen.trajectories)
        for order in seen.arrived:
            board.open[order.task.id] = order
        for robot, level in seen.energy.items():
            self._see(robot, energy=level)
        done = self._end_trips(seen)
        board.arrived = tuple(order.task.id for order in seen.arrived)
        diverted, given_back = self._divert(seen, failed)
        changed |= {robot: self._trips.commitment(robot) for robot in diverted}
        told: list[Told] = []
        is_soon = False  # whether something else is to be tried at once
        for choice in self._dispatch(board):
            outcome = self._try(choice)
            if outcome is None:
                continue
            told.append(outcome)
            if isinstance(outcome.outcome, Commitment):
                changed[choice.trip.robot] = outcome.outcome
                others = {other.robot: other for other in self._trips.changed}
                changed |= others
                self._see_ready(others)
            elif outcome.outcome.for_good and choice.elsewhere:
                is_soon = True
            elif outcome.outcome.for_good and choice.trip.order is not None:
                self._fail(choice.trip.order, outcome.outcome.reason, failed)
        board.ended = board.arrived = ()
        # Who was to do an order that has failed may do another one.
        is_soon = is_soon or bool(failed)
        wake = seen.now + 1 if is_soon else self._next_try(seen.now)
        return Decision(
            changed, tuple(told), tuple(done), failed, tuple(diverted), tuple(given_back), wake
        )

    def _next_try(self, now: int) -> int | None:
        """Return when a refused robot is to be tried again; nobody wanted those overdue now."""
        ahead = [
            again
            for times, again in self._refused.values()
            if again > now and times < self._params.most_tries
        ]
        return min(ahead, default=None)

    def _fail(self, order: str, reason: str, failed: dict[str, str]) -> None:
        """Give an order up for good, once, whatever becomes of the robot that has it."""
        if order in self._board.open:
            failed[order] = reason
        for known in (self._board.open, self._board.taken, self._board.refusals):
            known.pop(order, None)

    def _divert(self, seen: Observation, failed: dict[str, str]) -> tuple[list[str], list[str]]:
        """Plan round obstacles; return the robots concerned and the orders they gave back."""
        board, lead = self._board, self._params.lead
        diverted: dict[str, None] = {}
        given_back: list[str] = []
        for obstacle in seen.found:
            before = {robot: self._trips.commitment(robot) for robot in board.robots}
            for robot in self._trips.block(obstacle, seen.now, lead):
                diverted[robot] = None
                trip, now = board.robots[robot].trip, self._trips.commitment(robot)
                if trip is not None and now.trip is trip:
                    self._see_ready([robot])
                    continue
                self._see(robot, pose=now.trajectory.final_pose, place=now.rest)
                if trip is None:
                    continue
                stops = before[robot].trajectory.stops
                # A service that has begun is gone through with.
                served = [trip.visits[stop.visit] for stop in stops if stop.arrive <= seen.now]
                self._see(
                    robot,
                    trip=None,
                    carries=_after(trip, served, board.robots[robot].carries),
                    ready=seen.now,
                    idle_since=seen.now,
                )
                if trip.order is None:
                    continue
                if any(visit.load for visit in served):
                    reason = f"an obstacle bars the way of {robot}, which has the load"
                    self._fail(trip.order, reason, failed)
                else:
                    board.taken.pop(trip.order, None)
                    given_back.append(trip.order)
        return list(diverted), given_back

    def _try(self, choice: Choice) -> Told | None:
        """Return how a choice went; ``None`` where it is too soon to try it again."""
        board, trip = self._board, choice.trip
        times, again = self._refused.get(trip.robot, (0, 0))
        if board.now < again:
            return None
        begin = self._cpu()
        effort = min(2**times, self._params.most_effort)
        outcome = self._trips.plan(trip, board.now, effort, self._params.lead)
        spent = self._cpu() - begin
        if isinstance(outcome, Refusal):
            if outcome.for_good:
                zones = {zone for zone in trip.goals if zone is not None}
                board.barred.setdefault(trip.robot, set()).update(zones)
            if outcome.stranded:
                board.stranded.add(trip.robot)
            if outcome.for_good and (choice.elsewhere or trip.order in board.open):
                # It is the place or the order that is hopeless, not the robot.
                return Told(choice, outcome, spent)
            pause = min(self._params.retry * 2**times, self._params.most_retry)
            self._refused[trip.robot] = (times + 1, board.now + pause)
            if trip.order is not None:
                board.refusals[trip.order] = board.refusals.get(trip.order, 0) + 1
            return Told(choice, outcome, spent)
        self._refused.pop(trip.robot, None)
        self._completes[trip.robot] = choice.completes
        self._see(trip.robot, trip=trip, ready=outcome.served)
        if trip.order in board.open:
            board.taken[trip.order] = trip.robot
            board.refusals.pop(trip.order, None)
        return Told(choice, outcome, spent)

    def _end_trips(self, seen: Observation) -> list[str]:
        board, done, ended = self._board, [], []
        for robot in seen.served:
            trip = board.robots[robot].trip
            if trip is None:
                continue
            ended.append(TripEnded(robot, trip))
            commitment = self._trips.commitment(robot)
            self._see(
                robot,
                trip=None,
                pose=trip.visits[-1].pose,
                place=trip.goals[-1] if not trip.rests else commitment.rest,
                carries=_after(trip, trip.visits, board.robots[robot].carries),
                ready=seen.now,
                idle_since=seen.now,
            )
            if trip.order in board.open and self._completes[robot]:
                done.append(trip.order)
                board.open.pop(trip.order, None)
                board.taken.pop(trip.order, None)
        board.ended = tuple(ended)
        return done

    def _see_ready(self, robots: Iterable[str]) -> None:
        """Learn when robots on trips are done with them, now that their times have changed."""
        for robot in robots:
            if self._board.robots[robot].trip is not None:
                self._see(robot, ready=self._trips.commitment(robot).served)

    def _see(self, robot: str, **change: object) -> None:
        view = self._board.robots[robot]
        self._board.robots[robot] = replace(view, **change)  # type: ignore[arg-type]


def _after(trip: Trip, served: Sequence[Visit], objects: tuple[str, ...]) -> tuple[str, ...]:
    """Return what is on board after some visits of a trip, begun with ``objects``."""
    if trip.carries and len(served) == len(trip.visits):
        return trip.carries
    for visit in served:
        if visit.load == "pick":
            objects = (*objects, visit.task or "load")
        elif visit.load == "drop":
            objects = objects[:-1]
    return objects
