"""What the loop makes of what a fleet tells, with a planner and a dispatcher made by hand."""

from collections.abc import Iterator, Mapping, Sequence

from clearway.coordinate import Coordinator, CoordinatorParams
from clearway.model import (
    Commitment,
    Obstacle,
    Order,
    Piece,
    Pose,
    Robot,
    Stop,
    Task,
    Trajectory,
    Trip,
    Visit,
)
from clearway.protocols import Board, Choice, Observation, Refusal

HOME = Pose(0.0, 0.0, 0.0)
AWAY = Pose(5.0, 0.0, 0.0)
ROBOTS = (Robot("a", "cart", HOME, energy=0.5), Robot("b", "cart", HOME))
WALL = Obstacle(disc=(3.0, 0.0, 1.0))


def order(name: str, robot: str | None = None, load: str | None = None) -> Order:
    visits = (Visit(name, AWAY, 1.0, load), Visit(name, HOME, 1.0))  # type: ignore[arg-type]
    return Order(Task(name, visits, robot))


def committed(trip: Trip, begin: int) -> Commitment:
    """Two visits of 1 s, each after 5 s of driving."""
    there, back = Piece(0, None, HOME, (5.0, 0.0, 0.0)), Piece(1, None, AWAY, (-5.0, 0.0, 0.0))
    timing = (begin, begin + 5000), (begin + 6000, begin + 11000)
    stops = Stop(0, begin + 5000, begin + 6000), Stop(1, begin + 11000, begin + 12000)
    return Commitment(trip.robot, Trajectory(trip.robot, HOME, (there, back), timing, stops), trip)


class ByHand:
    """Answers as told: ``refusals`` first, then commitments; obstacles stop ``barred`` robots."""

    def __init__(self, *refusals: Refusal) -> None:
        self.refusals = list(refusals)
        self.commitments = {r.id: Commitment(r.id, Trajectory(r.id, r.start)) for r in ROBOTS}
        self.asked: list[tuple[str, int, int, int]] = []
        self.changed: Sequence[Commitment] = ()
        self.counters: Mapping[str, int] = {"expansions": 0}
        self.delay_others = 0
        self.barred: tuple[str, ...] = ()
        self.goes_on = False

    def plan(self, trip: Trip, now: int, effort: int = 1, lead: int = 0) -> Commitment | Refusal:
        self.changed = ()
        self.asked.append((trip.robot, now, effort, lead))
        if self.refusals:
            return self.refusals.pop(0)
        if self.delay_others:
            others = [c for r, c in self.commitments.items() if r != trip.robot and c.trip]
            self.changed = [committed(c.trip, self.delay_others) for c in others if c.trip]
            self.commitments |= {c.robot: c for c in self.changed}
        self.commitments[trip.robot] = committed(trip, now + lead)
        return self.commitments[trip.robot]

    def commitment(self, robot: str) -> Commitment:
        return self.commitments[robot]

    def retime(self, trajectories: Mapping[str, Trajectory], now: int) -> None:
        for robot, path in trajectories.items():
            self.commitments[robot] = Commitment(robot, path, self.commitments[robot].trip)

    def block(self, obstacle: Obstacle, now: int, lead: int = 0) -> tuple[str, ...]:
        for robot in self.barred:
            old = self.commitments[robot]
            if self.goes_on and old.trip is not None:
                self.commitments[robot] = committed(old.trip, now + 500)
            else:
                aside = Piece(0, None, HOME, (0.0, 2.0, 0.0))
                path = Trajectory(robot, HOME, (aside,), ((now, now + 2000),))
                self.commitments[robot] = Commitment(robot, path, rest="bay")
        return self.barred


class Oldest:
    """Wants the oldest open order for the first idle robot; keeps the board to look at."""

    def __init__(self) -> None:
        self.board = Board(0, {})

    def __call__(self, board: Board) -> Iterator[Choice]:
        self.board = board
        for view in tuple(board.robots.values()):
            for name, wanted in tuple(board.open.items()):
                if not board.robots[view.id].is_idle:
                    break
                if name not in board.taken and wanted.task.robot in (None, view.id):
                    trip = Trip(view.id, wanted.visits, "order", name)
                    yield Choice(trip, "order", name, 0.0)


def loop(planner: ByHand, **params: int) -> tuple[Coordinator, Oldest]:
    wants = Oldest()
    return Coordinator(ROBOTS, wants, planner, CoordinatorParams(**params)), wants


NO_WAY = Refusal("no way", ("b",))


def test_an_order_is_taken_then_done_when_its_trip_is_served() -> None:
    coordinator, wants = loop(ByHand(), lead=100)
    first = coordinator.decide(Observation(0, (order("o"),)))
    assert list(first.commitments) == ["a"]
    assert wants.board.taken == {"o": "a"}
    assert wants.board.robots["a"].ready == 12100
    then = coordinator.decide(Observation(12100, served=("a",), energy={"a": 0.4}))
    assert (then.done, coordinator.open_orders) == (("o",), 0)
    view = wants.board.robots["a"]
    assert (view.is_idle, view.energy, view.idle_since, view.pose) == (True, 0.4, 12100, HOME)
    assert wants.board.taken == {}


def test_a_refused_robot_is_tried_later_with_more_effort() -> None:
    planner = ByHand(*[NO_WAY] * 8)
    coordinator, wants = loop(planner)
    now, asked = 0, [Observation(0, (order("o", "a"),))]
    while asked:
        decision = coordinator.decide(asked.pop())
        if decision.wake is not None:
            now = decision.wake
            asked.append(Observation(now))
    assert [at for _, at, _, _ in planner.asked] == [
        0,
        1000,
        3000,
        7000,
        15000,
        23000,
        31000,
        39000,
        47000,
    ]
    assert [effort for _, _, effort, _ in planner.asked] == [1, 2, 4, 8, 16, 16, 16, 16, 16]
    assert wants.board.refusals == {}


def test_a_robot_is_not_tried_again_too_soon() -> None:
    planner = ByHand(NO_WAY)
    coordinator, _ = loop(planner)
    coordinator.decide(Observation(0, (order("o", "a"),)))
    decision = coordinator.decide(Observation(500, (order("p", "a"),)))
    assert len(planner.asked) == 1
    assert (decision.told, decision.wake) == ((), 1000)


def test_nobody_is_woken_for_a_robot_that_is_not_wanted_any_more() -> None:
    """Once refused, a robot whose order another has taken must not wake the loop at each tick."""
    planner = ByHand(NO_WAY)
    coordinator, _ = loop(planner)
    decision = coordinator.decide(Observation(0, (order("o"),)))
    assert list(decision.commitments) == ["b"]
    assert decision.wake == 1000
    assert coordinator.decide(Observation(1000)).wake is None


def test_a_hopeless_robot_does_not_wake_the_loop_for_ever() -> None:
    planner = ByHand(*[NO_WAY] * 100)
    coordinator, _ = loop(planner, most_tries=5)
    decision = coordinator.decide(Observation(0, (order("o", "a"),)))
    wakes = 0
    while decision.wake is not None:
        wakes += 1
        decision = coordinator.decide(Observation(decision.wake))
    assert wakes == 4
    coordinator.decide(Observation(100_000, (order("p", "b"),)))
    assert planner.asked[-2][:2] == ("a", 100_000), "something has happened, so it is tried again"


def test_an_order_refused_for_good_fails_and_costs_its_robot_no_time() -> None:
    planner = ByHand(Refusal("walled in", for_good=True))
    coordinator, wants = loop(planner)
    decision = coordinator.decide(Observation(0, (order("never", "a"), order("o", "a"))))
    assert decision.failed == {"never": "walled in"}
    assert wants.board.taken == {"o": "a"}, "the next order is tried at once"
    assert (decision.wake, coordinator.open_orders) == (1, 1), "others may be tried at once, too"
    assert wants.board.refusals == {}


def test_the_part_of_an_order_refused_for_good_is_nobodys_any_more() -> None:
    """The second trip of an order fails it, and then it is not taken either."""
    planner = ByHand()

    def in_two_parts(board: Board) -> Iterator[Choice]:
        boards.append(board)
        if board.robots["a"].is_idle and "o" in board.open:
            trip = Trip("a", order("o").visits, "fetch", "o")
            yield Choice(trip, "order", "o", 0.0, completes=False)

    boards: list[Board] = []
    coordinator = Coordinator(ROBOTS, in_two_parts, planner)
    coordinator.decide(Observation(0, (order("o"),)))
    planner.refusals = [Refusal("walled in", for_good=True)]
    decision = coordinator.decide(Observation(12000, served=("a",)))
    assert (decision.done, dict(decision.failed)) == ((), {"o": "walled in"})
    assert (boards[-1].open, boards[-1].taken) == ({}, {})


def test_what_a_planner_does_at_once_is_told_first() -> None:
    """A planner that leads robots out of the way before all else must not do so in secret."""
    planner = ByHand()
    path = Trajectory("b", HOME, (Piece(0, None, HOME, (1.0, 0.0, 0.0)),), ((0, 1000),))
    planner.commitments["b"] = Commitment("b", path, rest="bay")
    coordinator, _ = loop(planner)
    first = coordinator.decide(Observation(0))
    assert dict(first.commitments) == {"b": planner.commitments["b"]}
    assert coordinator.decide(Observation(1)).commitments == {}


def test_commitments_that_a_plan_changes_are_told_too() -> None:
    planner = ByHand()
    coordinator, wants = loop(planner)
    coordinator.decide(Observation(0, (order("o", "a"),)))
    planner.delay_others = 3000
    decision = coordinator.decide(Observation(1000, (order("p", "b"),)))
    assert set(decision.commitments) == {"a", "b"}
    assert decision.commitments["a"].served == 15000
    assert wants.board.robots["a"].ready == 15000


def test_new_times_change_when_robots_are_ready() -> None:
    planner = ByHand()
    coordinator, wants = loop(planner)
    trip = coordinator.decide(Observation(0, (order("o"),))).commitments["a"].trip
    assert trip is not None
    late = committed(trip, 2500).trajectory
    coordinator.decide(Observation(3000, trajectories={"a": late}))
    assert wants.board.robots["a"].ready == 14500


def test_an_order_that_an_obstacle_bars_is_given_back_and_taken_by_another() -> None:
    planner = ByHand()
    coordinator, wants = loop(planner)
    coordinator.decide(Observation(0, (order("o"),)))
    planner.barred = ("a",)
    planner.refusals = [NO_WAY]
    decision = coordinator.decide(Observation(1000, found=(WALL,)))
    assert (list(decision.diverted), list(decision.given_back)) == (["a"], ["o"])
    assert [told.choice.trip.robot for told in decision.told] == ["a", "b"]
    assert wants.board.taken == {"o": "b"}
    assert set(decision.commitments) == {"a", "b"}
    view = wants.board.robots["a"]
    assert (view.is_idle, view.pose, view.place) == (True, Pose(0.0, 2.0, 0.0), "bay")


def test_a_robot_that_finds_a_way_round_keeps_its_order() -> None:
    planner = ByHand()
    coordinator, wants = loop(planner)
    coordinator.decide(Observation(0, (order("o"),)))
    planner.barred, planner.goes_on = ("a",), True
    decision = coordinator.decide(Observation(1000, found=(WALL,)))
    assert (list(decision.diverted), list(decision.given_back)) == (["a"], [])
    assert wants.board.taken == {"o": "a"}
    assert wants.board.robots["a"].ready == 13500


def test_an_order_whose_load_is_on_board_fails_with_its_robot() -> None:
    """6.5 s: the pick is over. Nobody else can go on with what it has on board."""
    planner = ByHand()
    coordinator, wants = loop(planner)
    coordinator.decide(Observation(0, (order("o", load="pick"),)))
    planner.barred = ("a",)
    decision = coordinator.decide(Observation(6500, found=(WALL,)))
    assert list(decision.failed) == ["o"]
    assert "a" in decision.failed["o"]
    assert (list(decision.given_back), coordinator.open_orders) == ([], 0)
    assert (wants.board.taken, wants.board.robots["a"].carries) == ({}, ("o",))


def test_an_idle_robot_that_makes_way_is_seen_where_it_goes() -> None:
    planner = ByHand()
    coordinator, wants = loop(planner)
    coordinator.decide(Observation(0))
    planner.barred = ("b",)
    coordinator.decide(Observation(1000, found=(WALL,)))
    assert (wants.board.robots["b"].place, wants.board.robots["b"].pose.y) == ("bay", 2.0)


def test_what_a_trip_leaves_on_board_is_seen() -> None:
    coordinator, wants = loop(ByHand())
    coordinator.decide(Observation(0, (order("o", "a", load="pick"),)))
    coordinator.decide(Observation(12000, served=("a",)))
    assert wants.board.robots["a"].carries == ("o",)


def test_an_order_fails_once_and_is_not_done_afterwards() -> None:
    """A robot that still has its shelf tries again to bring it back, and does in the end."""
    planner = ByHand()

    def brings_back(board: Board) -> Iterator[Choice]:
        if board.robots["a"].is_idle:
            last = board.now > 0
            trip = Trip("a", order("o").visits, "store" if last else "fetch", "o")
            yield Choice(trip, "order", "o", 0.0, completes=last)

    coordinator = Coordinator(ROBOTS, brings_back, planner)
    coordinator.decide(Observation(0, (order("o"),)))
    planner.refusals = [Refusal("walled in", for_good=True)] * 2
    first = coordinator.decide(Observation(12000, served=("a",)))
    second = coordinator.decide(Observation(12001))
    assert (list(first.failed), list(second.failed)) == (["o"], [])
    assert second.wake == 13001, "the robot is not asked for the impossible at each event"
    assert coordinator.decide(Observation(13001)).commitments.keys() == {"a"}
    last = coordinator.decide(Observation(25001, served=("a",)))
    assert (last.done, dict(last.failed)) == ((), {})
