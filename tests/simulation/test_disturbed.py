"""Robots that are late: how they move, what they tell, with an executor made by hand."""

from collections.abc import Mapping, Sequence

import pytest

from clearway.model import (
    Commitment,
    Disturbances,
    Piece,
    Pose,
    Robot,
    Stop,
    Trajectory,
    Trip,
    Visit,
    Wait,
)
from clearway.protocols import Binding, Precedence
from clearway.simulation.disturbed import Disturbed
from clearway.simulation.motion import Occurrence

START = Pose(0.0, 0.0, 0.0)
ROBOT = Robot("a", "cart", START)
FREE = 1 << 30
SLOW = Disturbances(slow=1.0, slowness=0.5)


class ByHand:
    """Grants what ``grants`` says, everything else for ever; projects what ``later`` says."""

    look_ahead = 100

    def __init__(self) -> None:
        self.grants: dict[str, int] = {}
        self.reports: dict[str, int] = {}
        self.waits_for: tuple[Precedence, ...] = ()
        self.later: dict[str, Trajectory] = {}
        self.commitments: dict[str, Commitment] = {}

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        self.commitments |= commitments

    def report(self, robot: str, progress: int) -> None:
        assert progress <= self.grant(robot) or not self.commitments[robot].trajectory.pieces
        self.reports[robot] = progress

    def grant(self, robot: str) -> int:
        return self.grants.get(robot, FREE)

    def why(self, robot: str) -> Binding | None:
        at = self.grants.get(robot)
        return None if at is None else Binding(robot, "b", at, at)

    def unmet(self, robot: str) -> Sequence[Precedence]:
        return self.waits_for

    def projected(self, now: int) -> Mapping[str, Trajectory]:
        return self.later


def line(*legs: tuple[int, int, float], stops: Sequence[Stop] = ()) -> Trajectory:
    """Drive forwards from tick to tick by so many metres."""
    pieces, x = [], 0.0
    for number, (_, _, length) in enumerate(legs):
        pieces.append(Piece(number, None, Pose(x, 0.0, 0.0), (length, 0.0, 0.0)))
        x += length
    timing = tuple((begin, end) for begin, end, _ in legs)
    return Trajectory("a", START, tuple(pieces), timing, tuple(stops))


def trip(visits: int = 1) -> Trip:
    return Trip("a", tuple(Visit(f"t{i}", START, 1.0) for i in range(visits)), "order", "o")


def driving(
    path: Trajectory, disturbances: Disturbances, executor: ByHand, waits: tuple[Wait, ...] = ()
) -> Disturbed:
    motion = Disturbed((ROBOT,), disturbances, executor, 7)
    motion.commit({"a": Commitment("a", path, trip(len(path.stops) or 1), waits=waits)}, 0)
    return motion


def told(occurred: Sequence[Occurrence]) -> list[tuple[int, str, int]]:
    return [(one.tick, one.kind, one.visit) for one in occurred if one.kind != "waits"]


def waits(occurred: Sequence[Occurrence]) -> list[Wait]:
    return [one.wait for one in occurred if one.wait is not None]


def test_a_robot_on_time_is_where_its_plan_says() -> None:
    executor = ByHand()
    path = line((0, 2000, 2.0), (3000, 4000, 1.0), stops=[Stop(0, 4000, 5000)])
    motion = driving(path, Disturbances(), executor)
    assert told(motion.advance(6000)) == [(4000, "arrived", 0), (5000, "left", 0)]
    assert motion.next_tick() is None
    driven = motion.driven("a", 6000)
    assert driven.timing == ((0, 2000), (3000, 4000))
    assert driven.final_pose == Pose(3.0, 0.0, 0.0)
    assert motion.expected(6000) is None


def test_a_slow_robot_is_late_and_drives_at_its_part_of_the_speed() -> None:
    executor = ByHand()
    motion = driving(line((0, 2000, 2.0)), SLOW, executor)
    motion.advance(3000)
    assert executor.reports["a"] == 1500
    driven = motion.driven("a", 3000)
    assert driven.timing == ((0, 3000),), "even motion is one piece"
    assert driven.final_pose.x == pytest.approx(1.5)


@pytest.mark.parametrize("slowness", [0.3, 0.7, 0.83, 0.999])
def test_no_robot_is_faster_than_its_plan_times_its_pace(slowness: float) -> None:
    executor = ByHand()
    motion = driving(line((0, 5000, 5.0)), Disturbances(slow=1.0, slowness=slowness), executor)
    motion.advance(4000)
    driven = motion.driven("a", 4000)
    assert driven.final_pose.x == pytest.approx(4.0 * slowness, abs=0.002)
    for piece, (begin, end) in zip(driven.pieces, driven.timing, strict=True):
        ticks = round(1000.0 * piece.twist[0])
        assert ticks <= slowness * (end - begin) + 1.0


def test_a_late_robot_does_not_stand_where_the_plan_waits() -> None:
    """At half its speed it comes at 2 s, when the wait from 1 s to 1.5 s is long over."""
    executor = ByHand()
    motion = driving(line((0, 1000, 1.0), (1500, 2500, 1.0)), SLOW, executor)
    occurred = motion.advance(4000)
    assert waits(occurred) == []
    assert executor.reports["a"] == 2500
    assert motion.driven("a", 4000).timing[-1] == (2000, 4000)


def test_a_robot_that_is_less_late_stands_for_the_rest_of_a_wait() -> None:
    """It comes at 2 s; the plan waits from 1 s to 3 s."""
    executor = ByHand()
    motion = driving(line((0, 1000, 1.0), (3000, 4000, 1.0)), SLOW, executor)
    occurred = motion.advance(5000)
    assert [(w.begin, w.end, w.causes) for w in waits(occurred)] == [(2000, 3000, ("plan",))]
    assert motion.driven("a", 5000).timing[-1] == (3000, 5000)


def test_services_last_as_long_as_planned_when_they_begin_late() -> None:
    executor = ByHand()
    path = line((0, 1000, 1.0), stops=[Stop(0, 1000, 1700)])
    motion = driving(path, SLOW, executor)
    assert told(motion.advance(3000)) == [(2000, "arrived", 0), (2700, "left", 0)]


def test_two_visits_at_one_place_follow_each_other() -> None:
    executor = ByHand()
    path = line((0, 1000, 1.0), stops=[Stop(0, 1000, 1500), Stop(1, 1500, 1500)])
    motion = driving(path, Disturbances(), executor)
    assert [(kind, visit) for _, kind, visit in told(motion.advance(3000))] == [
        ("arrived", 0),
        ("left", 0),
        ("arrived", 1),
        ("left", 1),
    ]


def test_a_robot_stops_at_its_grant_and_tells_once_for_whom() -> None:
    executor = ByHand()
    executor.grants["a"] = 640
    motion = driving(line((0, 2000, 2.0)), Disturbances(), executor)
    occurred = motion.advance(1500)
    assert executor.reports["a"] == 640
    assert [(w.causes, w.end) for w in waits(occurred)] == [(("b",), None)]
    executor.grants.clear()
    motion.advance(2000)
    assert executor.reports["a"] == 640 + 500
    pieces = motion.driven("a", 2000)
    assert pieces.timing == ((0, 640), (1500, 2000))
    assert pieces.pieces[0].end == pieces.pieces[1].start


def test_a_wait_of_the_plan_is_told_with_its_reason() -> None:
    planned = Wait(500, 1500, ("b",), "b goes first")
    motion = driving(
        line((0, 500, 0.5), (1500, 2000, 0.5)), Disturbances(), ByHand(), waits=(planned,)
    )
    assert waits(motion.advance(2000)) == [planned]


def test_stops_are_random_repeatable_and_within_their_bounds() -> None:
    """About 50 of them in an hour of motion; a robot that stands does not stop."""
    often = Disturbances(stops_per_hour=50.0, stop_seconds=(2.0, 5.0))

    def run(seed: int) -> list[tuple[int, str, int]]:
        motion = Disturbed((ROBOT,), often, ByHand(), seed)
        motion.commit({"a": Commitment("a", line((0, 3_600_000, 900.0)), trip())}, 0)
        return told(motion.advance(3_600_000))

    events = run(1)
    assert events == run(1) != run(2)
    assert [kind for _, kind, _ in events[:4]] == ["stops", "moves", "stops", "moves"]
    lasted = [b - a for (a, _, _), (b, _, _) in zip(events[::2], events[1::2], strict=False)]
    assert 25 < len(lasted) < 85
    assert min(lasted) >= 2000 and max(lasted) <= 5100


def test_robots_without_random_stops_may_be_slow() -> None:
    """No stop is drawn where there are none."""
    executor = ByHand()
    motion = driving(line((0, 1000, 1.0)), SLOW, executor)
    assert told(motion.advance(5000)) == []
    assert executor.reports["a"] == 5000, "at rest it is on time again"


def test_the_times_to_expect_are_driven_by_from_then_on() -> None:
    """At 1 s, half a second behind, what is left is told to last until 2.5 s and so it does."""
    executor = ByHand()
    motion = driving(line((0, 2000, 2.0)), Disturbances(), executor)
    executor.grants["a"] = 500
    motion.advance(1000)
    executor.grants.clear()
    rest = Piece(0, None, Pose(0.5, 0.0, 0.0), (1.5, 0.0, 0.0))
    executor.later = {"a": Trajectory("a", rest.start, (rest,), ((1000, 2500),))}
    assert motion.expected(1000) == executor.later
    assert executor.commitments["a"].trajectory == executor.later["a"]
    assert executor.reports["a"] == 1000
    motion.advance(3000)
    driven = motion.driven("a", 3000)
    assert driven.timing == ((0, 500), (1000, 2500))
    assert driven.final_pose.x == pytest.approx(2.0)
    assert motion.expected(3000) is None


def test_what_is_driven_joins_whenever_it_is_asked_for() -> None:
    executor = ByHand()
    often = Disturbances(stops_per_hour=600.0, slow=1.0, slowness=0.7)
    motion = driving(line((0, 3000, 3.0), (5000, 9000, 4.0)), often, executor)
    at, clock = START, 0
    for now in (130, 1000, 1001, 4777, 9000, 30_000, 90_000):
        motion.advance(now)
        driven = motion.driven("a", now)
        assert driven.start == at
        for piece, (begin, end) in zip(driven.pieces, driven.timing, strict=True):
            assert piece.start.distance(at) < 1e-9
            assert clock <= begin < end <= now
            at, clock = piece.end, end
    assert at.x == pytest.approx(7.0)


def test_another_trip_begins_with_its_first_visit() -> None:
    executor = ByHand()
    motion = driving(line((0, 1000, 1.0), stops=[Stop(0, 1000, 1000)]), Disturbances(), executor)
    motion.advance(1000)
    there = Trajectory("a", Pose(1.0, 0.0, 0.0), stops=(Stop(0, 1200, 1300),))
    motion.commit({"a": Commitment("a", there, trip())}, 1000)
    assert told(motion.advance(2000)) == [(1200, "arrived", 0), (1300, "left", 0)]
