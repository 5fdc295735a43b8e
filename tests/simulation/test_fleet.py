"""A fleet runs through time, tells what happens, and ends when there is nothing left."""

from collections import defaultdict
from typing import Any

import numpy as np
import pytest
from tests.simulation.lone_lanes import AlongLanes, Listed, lanes, oldest_first

from clearway.coordinate import Coordinator
from clearway.model import Scenario
from clearway.simulation.fleet import SimulatedFleet
from clearway.simulation.on_time import OnTime


def run(scenario: Scenario) -> tuple[str, list[dict[str, Any]], AlongLanes]:
    events: list[dict[str, Any]] = []
    trips = AlongLanes(scenario)
    fleet = SimulatedFleet(
        scenario, OnTime(scenario.robots), Listed(scenario), lambda e: events.append(dict(e))
    )
    coordinator = Coordinator(scenario.robots, oldest_first, trips)
    while (seen := fleet.observe()) is not None:
        fleet.execute(coordinator.decide(seen))
    return fleet.close(), events, trips


def of(events: list[dict[str, Any]], kind: str) -> list[dict[str, Any]]:
    return [event for event in events if event["event"] == kind]


def test_orders_are_done_when_their_service_ends() -> None:
    """Order b comes at 1 s while a is under way: 10 m, 2 s, then 5 m back and 2 s: 19 s."""
    status, events, _ = run(lanes(1, [("a", 0, 10.0), ("b", 0, 5.0)]))
    assert status == "done"
    done = {e["order"]: e["t"] for e in of(events, "order") if e["state"] == "done"}
    assert done == {"a": 12.0, "b": 19.0}
    end = events[-1]
    assert (end["event"], end["orders_done"], end["orders_open"]) == ("end", 2, 0)
    assert end["makespan"] == 19.0
    assert end["distance"] == pytest.approx(15.0)
    assert end["waiting"] == 0.0


def test_states_of_an_order_follow_each_other() -> None:
    _, events, _ = run(lanes(2, [("a", 0, 10.0), ("b", 1, 5.0)]))
    states = defaultdict(list)
    for event in of(events, "order"):
        states[event["order"]].append(event["state"])
    assert all(s == ["released", "assigned", "started", "done"] for s in states.values())


def test_time_never_falls_from_event_to_event() -> None:
    _, events, _ = run(lanes(3, [(f"o{i}", i % 3, 3.0 + 7.0 * i) for i in range(9)]))
    times = [event["t"] for event in events if event["event"] != "motion"]
    assert times == sorted(times)


def test_what_is_driven_joins_without_a_gap() -> None:
    _, events, _ = run(lanes(2, [(f"o{i}", i % 2, 5.0 + 9.0 * (i % 4)) for i in range(10)]))
    at = {"r0": 0.0, "r1": 0.0}
    for event in of(events, "motion"):
        assert event["x"][0] == pytest.approx(at[event["robot"]])
        assert np.all(np.diff(event["t"]) >= 0.0)
        at[event["robot"]] = float(event["x"][-1])


def test_a_battery_falls_with_the_time_in_motion() -> None:
    """15 s of motion take 1.5 % of a battery that lasts 1000 s; services take none."""
    _, events, _ = run(lanes(1, [("a", 0, 10.0), ("b", 0, 5.0)]))
    assert [e["level"] for e in of(events, "energy")] == pytest.approx([1.0, 0.99, 0.985])


def test_a_refused_order_waits_and_is_tried_with_growing_effort() -> None:
    """Time is up at 20 s; tries come after 1, 2, 4 and 8 s with the effort doubled each time."""
    status, events, trips = run(lanes(1, [("far", 0, 150.0)], until=20.0))
    assert status == "ended"
    assert trips.efforts == [1, 2, 4, 8, 16]
    refused = of(events, "decision")
    assert [e["t"] for e in refused] == [0.0, 1.0, 3.0, 7.0, 15.0]
    assert all(e["outcome"] == "refused" and e["causes"] == ["wall"] for e in refused)
    assert of(events, "wait")[-1]["for"] == ["wall"]
    assert events[-1]["orders_open"] == 1


def test_an_order_that_can_never_be_done_fails_and_ends_the_run() -> None:
    status, events, _ = run(lanes(1, [("never", 0, 2000.0)]))
    assert status == "done"
    assert [e["state"] for e in of(events, "order")] == ["released", "failed"]


def test_an_idle_robot_says_that_it_waits_for_orders() -> None:
    _, events, _ = run(lanes(1, [("a", 0, 0.0)]))
    assert of(events, "wait")[-1]["for"] == ["order"]


def test_a_run_that_is_cut_tells_the_motion_so_far() -> None:
    """Time is up at 5 s, 5 m down the lane."""
    status, events, _ = run(lanes(1, [("a", 0, 10.0)], until=5.0))
    assert status == "ended"
    assert of(events, "motion")[-1]["x"][-1] == pytest.approx(5.0)
    assert events[-1]["distance"] == pytest.approx(5.0)


def test_the_same_run_tells_the_same() -> None:
    scenario = lanes(3, [(f"o{i}", i % 3, 3.0 + 7.0 * i) for i in range(9)])
    one, other = (str(run(scenario)[1]) for _ in range(2))
    assert one == other
