"""When robots are on trips, from decisions, visits and orders."""

from clearway.model import Footprint, Limits, Pose, Robot, RobotType, Site, Trace, trip_spans

PUCK = RobotType("puck", Footprint(radius=0.3), "holonomic", Limits(speed=1.0))
ROOM = Site(((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)))


def spans(*events):
    robots = (Robot("a", "puck", Pose(1.0, 0.0, 0.0)),)
    trace = Trace("s", "", 0, ROOM, {"puck": PUCK}, robots, events, False, {})
    return [(s.purpose, s.order, s.begin, s.end, s.is_complete) for s in trip_spans(trace)]


def decision(t, visits=1, order="o1", purpose="order", outcome="committed"):
    expected = {"arrive": [t + 1.0] * visits, "outcome": outcome}
    return {
        "event": "decision",
        "t": t,
        "robot": "a",
        "order": order,
        "purpose": purpose,
        **expected,
    }


def left(t):
    return {"event": "visit", "t": t, "robot": "a", "state": "left"}


def closed(t, state, order="o1"):
    return {"event": "order", "t": t, "order": order, "state": state, "robot": "a"}


def test_a_trip_lasts_until_its_last_visit_is_left() -> None:
    """Two visits: the first one leaves the trip open."""
    assert spans(decision(1.0, 2), left(4.0), left(7.0), left(9.0)) == [
        ("order", "o1", 1.0, 7.0, True)
    ]


def test_a_refused_decision_begins_no_trip() -> None:
    """Nothing came of it."""
    assert spans(decision(1.0, outcome="refused"), left(4.0)) == []


def test_a_trip_ends_with_the_next_one() -> None:
    """Sent elsewhere, a robot is on one trip at a time."""
    assert spans(decision(1.0), decision(3.0, order=None, purpose="charge"), left(5.0)) == [
        ("order", "o1", 1.0, 3.0, False),
        ("charge", None, 3.0, 5.0, True),
    ]


def test_a_trip_ends_when_its_order_fails_or_is_called_off() -> None:
    """That of another order goes on; what is open at the end lasts to the end."""
    for state in ("failed", "cancelled"):
        assert spans(decision(1.0), closed(3.0, state)) == [("order", "o1", 1.0, 3.0, False)]
    other, later = closed(3.0, "failed", "o2"), closed(6.0, "released", "o3")
    assert spans(decision(1.0), other, later) == [("order", "o1", 1.0, 6.0, False)]
    motion = {"event": "motion", "robot": "a", "t": [3.0, 8.0]}
    assert spans(decision(1.0), motion) == [("order", "o1", 1.0, 8.0, False)]


def test_a_service_that_goes_on_belongs_to_the_trip_given_up() -> None:
    """Sent elsewhere in the middle of a service, a robot has yet to make both visits."""
    arrived = {"event": "visit", "t": 2.0, "robot": "a", "state": "arrived"}
    told = spans(decision(1.0), arrived, decision(3.0, 2, "o2"), left(4.0), left(6.0), left(8.0))
    assert told == [("order", "o1", 1.0, 3.0, False), ("order", "o2", 3.0, 8.0, True)]
