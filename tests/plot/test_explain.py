"""The chain of causes, from whom one asks about down to what moves or cannot."""

from typing import Any

import pytest

from clearway.model import Footprint, Limits, Pose, Robot, RobotType, Site, Trace
from clearway.plot.chronicle import Chronicle, chronicle
from clearway.plot.explain import Link, as_json, as_text, explain

CART = RobotType("cart", Footprint.rectangle(0.8, 0.8), "holonomic", Limits(1.0))
HALL = Site(((0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (0.0, 10.0)))
SEVEN = tuple(f"r{k}" for k in range(1, 8))

Event = dict[str, Any]


def drive(robot: str, start: float, length: float) -> Event:
    """Drive east at 1 m/s from the robot's place at x = 0."""
    y = SEVEN.index(robot) + 1.0
    return {
        "event": "motion",
        "robot": robot,
        "t": [start, start + length],
        "x": [0.0, length],
        "y": [y, y],
        "theta": [0.0, 0.0],
    }


def wait(
    robot: str, at: float, *causes: str, because: str = "", until: float | None = None
) -> Event:
    return {
        "event": "wait",
        "t": at,
        "robot": robot,
        "for": list(causes),
        "until": until,
        "because": because,
    }


def decision(robot: str, at: float, order: str | None, **changes: Any) -> Event:
    facts: Event = {
        "event": "decision",
        "t": at,
        "robot": robot,
        "order": order,
        "purpose": "order",
        "kind": "robot",
        "chosen": robot,
        "score": 4.0,
        "alternatives": [{"name": "r9", "score": 9.0}, {"name": "r8", "score": 6.5}],
        "because": "it is nearest",
        "outcome": "committed",
        "reason": None,
        "causes": [],
        "route": [[0.5, 1.0], [9.0, 1.0]],
        "rest": "p1",
        "arrive": [at + 30.0],
        "cpu_s": 0.001,
    }
    return {**facts, **changes}


def told(*events: Event) -> Chronicle:
    """Return a run of 100 s of seven robots in which these things happen."""
    robots = tuple(Robot(name, "cart", Pose(0.0, k + 1.0, 0.0)) for k, name in enumerate(SEVEN))
    end: Event = {"event": "end", "t": 100.0, "status": "ended"}
    facts = (*events, end)
    trace = Trace("hall", "test", 0, HALL, {"cart": CART}, robots, facts, True, {})
    return chronicle(trace)


def arrived(robot: str, at: float, place: str, order: str | None = None, **more: Any) -> Event:
    return {
        "event": "visit",
        "t": at,
        "robot": robot,
        "order": order,
        "state": "arrived",
        "place": place,
        "pose": [0.0, 0.0, 0.0],
        "service": 10.0,
        "purpose": "order",
        **more,
    }


def left(robot: str, at: float, order: str | None = None) -> Event:
    return {"event": "visit", "t": at, "robot": robot, "order": order, "state": "left"}


def brief(chain: list[Link]) -> list[tuple[str, int, str, str]]:
    return [(link.robot, link.depth, link.state, link.ends) for link in chain]


def test_a_chain_ends_at_who_moves() -> None:
    """r1 waits for r2, which waits for r3, which drives: three links, the last is the root."""
    run = told(
        wait("r1", 5.0, "r2", because="r2 comes from the right", until=12.0),
        wait("r2", 4.0, "r3"),
        drive("r3", 0.0, 20.0),
    )
    chain = explain(run, "r1", 10.0)
    assert brief(chain) == [
        ("r1", 0, "waiting", ""),
        ("r2", 1, "waiting", ""),
        ("r3", 2, "moving", "root"),
    ]
    assert chain[0].sentences[0] == (
        "Waits since 5.0 s for r2: r2 comes from the right. Expects to go on at 12.0 s."
    )


def test_a_wait_ends_when_the_robot_moves() -> None:
    """Whatever was expected: at 30 s it drives off and waits for nobody any more."""
    run = told(wait("r1", 5.0, "r2", until=12.0), drive("r1", 30.0, 5.0))
    assert explain(run, "r1", 29.0)[0].state == "waiting"
    assert brief(explain(run, "r1", 31.0)) == [("r1", 0, "moving", "root")]
    assert explain(run, "r1", 36.0)[0].state == "nothing to do"


def test_who_has_a_place_is_found_from_the_visits() -> None:
    """r1 waits for station p1, where r2 is at work until 20 s; then it is promised to r3."""
    run = told(
        decision("r3", 1.0, "o2"),
        wait("r1", 2.0, "station:p1"),
        arrived("r2", 3.0, "p1", "o1"),
        left("r2", 20.0, "o1"),
        drive("r2", 20.0, 5.0),
        arrived("r3", 50.0, "p1", "o2"),
        left("r3", 60.0, "o2"),
    )
    first, second = explain(run, "r1", 10.0)
    assert first.sentences[0] == "Waits since 2.0 s for station p1 to be free."
    assert (second.robot, second.state) == ("r2", "at work")
    assert second.sentences[0] == "Has p1, since 3.0 s."
    later = explain(run, "r1", 30.0)[1]
    assert (later.robot, later.sentences[0]) == ("r3", "Has p1 promised, since 1.0 s.")


def test_a_circle_is_cut_and_said() -> None:
    """r1 and r2 wait for each other: each is told once, and the text says that it is a circle."""
    run = told(wait("r1", 5.0, "r2"), wait("r2", 5.0, "r1"))
    chain = explain(run, "r1", 10.0)
    assert brief(chain) == [("r1", 0, "waiting", ""), ("r2", 1, "waiting", "cycle")]
    assert "closes a circle" in as_text(chain, 10.0)


def test_each_robot_is_told_once() -> None:
    """r1 waits for r2 and r3, and both wait for r4: r4 stands below r2 only."""
    run = told(
        wait("r1", 5.0, "r2", "r3"),
        wait("r2", 5.0, "r4"),
        wait("r3", 5.0, "r4"),
        drive("r4", 0.0, 30.0),
    )
    assert brief(explain(run, "r1", 10.0)) == [
        ("r1", 0, "waiting", ""),
        ("r2", 1, "waiting", ""),
        ("r4", 2, "moving", "root"),
        ("r3", 1, "waiting", "told"),
    ]


def test_no_plan_names_who_stands_against_it() -> None:
    """A refused trip leaves its robot standing, and leads on to the robots named."""
    refused = {"outcome": "refused", "reason": "no way out of the aisle", "causes": ["r2"]}
    run = told(wait("r1", 0.0, "order"), decision("r1", 5.0, "o1", **refused))
    assert brief(explain(run, "r1", 2.0)) == [("r1", 0, "nothing to do", "root")]
    chain = explain(run, "r1", 10.0)
    assert [link.state for link in chain] == ["no plan", "nothing to do"]
    assert chain[0].sentences == (
        "Stands without a plan for order o1 since 5.0 s: no way out of the aisle. Against it: r2.",
    )


def test_a_stop_of_its_own_is_a_root() -> None:
    """Who has stopped by itself waits for nobody, though it waited before."""
    run = told(
        wait("r1", 5.0, "r2"),
        {"event": "fault", "t": 8.0, "kind": "stop", "robot": "r1", "state": "stopped"},
        {"event": "fault", "t": 15.0, "kind": "stop", "robot": "r1", "state": "moving"},
    )
    assert brief(explain(run, "r1", 10.0)) == [("r1", 0, "stopped by itself", "root")]
    assert [link.robot for link in explain(run, "r1", 16.0)] == ["r1", "r2"]


def test_the_trip_tells_order_choice_and_way() -> None:
    """Alternatives stand by rising score; the first choice for the order is told as well."""
    run = told(
        {"event": "order", "t": 1.0, "order": "o1", "state": "released", "due": 90.0}
        | {"fetches": "s4", "priority": 2.0},
        decision("r1", 2.0, "o1", purpose="fetch", arrive=[8.0]),
        arrived("r1", 8.0, "s4", "o1"),
        left("r1", 9.0, "o1"),
        decision("r1", 9.0, "o1", purpose="deliver", kind="station", chosen="p1", alternatives=[]),
        drive("r1", 10.0, 20.0),
    )
    (link,) = explain(run, "r1", 15.0)
    assert link.sentences[1:] == (
        "Is bringing the shelf of order o1 to a station, since 9.0 s; the order came at 1.0 s, "
        "is due at 90.0 s, has priority 2 and needs shelf s4.",
        "Robot r1 was chosen at 2.0 s (score 4): it is nearest. Next best: r8 (6.5) and r9 (9).",
        "Station p1 was chosen at 9.0 s (score 4): it is nearest. "
        "There was nothing else to choose.",
        "Its way as planned: by (0.5, 1) - (9, 1), arriving at 39.0 s, then to rest at p1.",
    )
    told_json = as_json([link], 15.0)
    assert told_json["roots"] == ["r1"]
    assert [each["kind"] for each in told_json["chain"][0]["decisions"]] == ["robot", "station"]
    assert told_json["chain"][0]["decisions"][0]["alternatives"][0] == {"name": "r9", "score": 9.0}


def test_a_trip_lasts_until_its_last_visit() -> None:
    """Two visits are two numbers in ``arrive``: the trip ends when the second one is left."""
    run = told(
        decision("r1", 0.0, "o1", arrive=[10.0, 20.0]),
        arrived("r1", 10.0, "p1", "o1"),
        left("r1", 12.0, "o1"),
        arrived("r1", 20.0, "p2", "o1"),
        left("r1", 22.0, "o1"),
        decision("r1", 30.0, "o2", arrive=[40.0]),
    )
    orders = [explain(run, "r1", time)[0].order for time in (5.0, 16.0, 21.0, 23.0, 31.0)]
    assert orders == ["o1", "o1", "o1", None, "o2"]


def test_an_order_takes_a_robot_from_its_way_to_park() -> None:
    """Parking is nobody's order: the trip ends when another is decided."""
    run = told(
        decision("r1", 0.0, None, purpose="park", arrive=[30.0]),
        decision("r1", 10.0, "o1", arrive=[20.0]),
    )
    assert explain(run, "r1", 5.0)[0].purpose == "park"
    assert explain(run, "r1", 10.0)[0].order == "o1"


def test_orders_take_a_moment_to_reach_a_robot() -> None:
    """A tenth of a second between decision and drive is no standing; a whole second is."""
    run = told(decision("r1", 10.0, "o1"), drive("r1", 10.1, 5.0))
    assert [link.state for link in explain(run, "r1", 10.05)] == ["moving"]
    run = told(decision("r1", 10.0, "o1"), drive("r1", 11.0, 5.0))
    assert [link.state for link in explain(run, "r1", 10.05)] == ["not told"]


@pytest.mark.parametrize(
    ("robot", "time", "mend"),
    [("r11", 5.0, "did you mean r1?"), ("r1", 100.5, "0 to 100.0 s"), ("r1", -1.0, "0 to 100.0")],
)
def test_who_asks_wrongly_is_told_the_mend(robot: str, time: float, mend: str) -> None:
    """The closest name, or the times that there are."""
    with pytest.raises(ValueError, match=mend.replace("?", r"\?")):
        explain(told(), robot, time)


def test_load_and_energy_are_those_last_told() -> None:
    """Before anything is told of them, nothing is said."""
    run = told(
        {"event": "load", "t": 5.0, "robot": "r1", "objects": ["s4"]},
        {"event": "energy", "t": 6.0, "robot": "r1", "level": 0.5},
    )
    assert (explain(run, "r1", 4.0)[0].carries, explain(run, "r1", 4.0)[0].energy) == ((), None)
    assert (explain(run, "r1", 7.0)[0].carries, explain(run, "r1", 7.0)[0].energy) == (("s4",), 0.5)
