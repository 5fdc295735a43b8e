"""What the page of a run is told besides its chains: curves, places, figures, orders."""

import json
import re
from dataclasses import replace
from typing import Any

import pytest
from tests.plot.made_run import made_run

from clearway.metrics import trace_metrics
from clearway.model import Pose, Robot, Site, Trace, Zone
from clearway.plot.chronicle import chronicle
from clearway.plot.curves import curves
from clearway.plot.key_figures import key_figures
from clearway.plot.places import Change, shelf_places
from clearway.plot.trace_payload import trace_payload
from clearway.plot.trace_report import render_trace

Event = dict[str, Any]
SHELVES = ("s1", "s2", "s3")


def shelf_hall(*events: Event) -> Trace:
    """Return a run of 800 s of two robots, with three places for shelves."""
    run = made_run(robots=2, seconds=1.0)
    zones = tuple(
        Zone(name, "shelf", ((x, 0.0), (x + 1.0, 0.0), (x + 1.0, 1.0), (x, 1.0)))
        for x, name in enumerate(SHELVES)
    )
    site = Site(((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)), zones=zones)
    robots = tuple(Robot(f"r{k}", "cart", Pose(0.5, 0.5, 0.0)) for k in (1, 2))
    end: Event = {"event": "end", "t": 800.0, "status": "ended"}
    return replace(run, site=site, robots=robots, events=(*events, end))


def at(place: str, time: float, objects: list[str], robot: str = "r1") -> tuple[Event, ...]:
    """Return a visit of 2 s at a place, and what is on board when it ends."""
    arrived: Event = {"event": "visit", "t": time, "robot": robot, "state": "arrived"}
    arrived |= {"place": place, "pose": [0.5, 0.5, 0.0], "service": 2.0}
    left: Event = {"event": "visit", "t": time + 2.0, "robot": robot, "state": "left"}
    return (arrived, left, {"event": "load", "t": time + 2.0, "robot": robot, "objects": objects})


def order(name: str, state: str, time: float) -> Event:
    return {"event": "order", "t": time, "order": name, "state": state}


def test_a_shelf_may_come_back_to_another_place() -> None:
    """s1 is taken at 12 s and stands in s2's place from 52 s on; s2 was taken before."""
    trace = shelf_hall(*at("s2", 5.0, ["s2"], "r2"), *at("s1", 10.0, ["s1"]), *at("s2", 50.0, []))
    assert shelf_places(chronicle(trace)) == {
        "s1": [Change(0.0, "s1"), Change(12.0, None)],
        "s2": [Change(0.0, "s2"), Change(7.0, None), Change(52.0, "s1")],
        "s3": [Change(0.0, "s3")],
    }


def test_a_place_to_which_something_comes_first_was_vacant() -> None:
    """Nobody took anything from s3 before a shelf was put there."""
    trace = shelf_hall(*at("s1", 10.0, ["s1"]), *at("s3", 50.0, []))
    assert shelf_places(chronicle(trace))["s3"] == [Change(0.0, None), Change(52.0, "s1")]


def test_without_shelves_on_board_nothing_is_known_of_places() -> None:
    """Loads that are taken elsewhere say nothing of shelves."""
    assert shelf_places(chronicle(shelf_hall())) == {}
    assert shelf_places(chronicle(shelf_hall(*at("dock", 10.0, ["box"])))) == {}


def test_throughput_counts_the_window_before() -> None:
    """Two orders done at 100 s and 110 s: 60 an hour while both lie within the last 120 s.

    At 800 s / 160 = 5 s a point: at 115 s there were 2 in 115 s, which is 62.6 an hour.
    """
    done = (order("o1", "done", 100.0), order("o2", "done", 110.0))
    found = curves(chronicle(shelf_hall(order("o1", "released", 0.0), *done)))
    by_time = dict(zip(found["t"], found["throughput"], strict=True))
    assert by_time[95.0] == 0.0
    assert by_time[115.0] == pytest.approx(2 * 3600 / 115, abs=0.01)
    assert by_time[200.0] == pytest.approx(60.0)
    assert by_time[225.0] == pytest.approx(30.0)
    assert by_time[235.0] == 0.0


def test_waiting_is_a_share_of_the_fleet() -> None:
    """One of two robots waits from 100 s to 110 s, then it drives: half the fleet, then none."""
    wait: Event = {"event": "wait", "t": 100.0, "robot": "r1", "for": ["r2"]}
    drive: Event = {"event": "motion", "robot": "r1", "t": [110.0, 120.0], "x": [0.5, 5.5]}
    drive |= {"y": [0.5, 0.5], "theta": [0.0, 0.0]}
    found = curves(chronicle(shelf_hall(wait, drive)))
    waiting = dict(zip(found["t"], found["waiting"], strict=True))
    working = dict(zip(found["t"], found["working"], strict=True))
    assert [waiting[t] for t in (100.0, 105.0, 110.0, 115.0)] == [0.0, 0.5, 0.5, 0.0]
    assert [working[t] for t in (110.0, 115.0, 120.0, 125.0)] == [0.0, 0.5, 0.5, 0.0]


def test_energy_is_shown_where_it_is_told() -> None:
    """A robot that tells its level at 80 s has fallen evenly from its level at the start."""
    assert "energy" not in curves(chronicle(shelf_hall()))
    level: Event = {"event": "energy", "t": 80.0, "robot": "r1", "level": 0.5}
    found = curves(chronicle(shelf_hall(level)))
    assert found["least_energy"][7] == pytest.approx(0.75)
    assert found["energy"][-1] == pytest.approx(0.5)


def test_orders_tell_their_times() -> None:
    """In ms, with the robot that had them last; what has not happened is null."""
    events = (
        {**order("o1", "released", 1.0), "due": 90.0, "fetches": "s1"},
        {**order("o1", "assigned", 2.0), "robot": "r2"},
        {**order("o1", "failed", 30.0), "reason": "no way"},
    )
    (told,) = trace_payload(chronicle(shelf_hall(*events)), [])["orders"]
    assert (told["robot"], told["released"], told["assigned"], told["started"]) == (
        1,
        1000,
        2000,
        None,
    )
    assert (told["ended"], told["due"], told["state"], told["reason"]) == (
        30000,
        90000,
        "failed",
        "no way",
    )


def test_figures_leave_out_what_is_not_known() -> None:
    """No order done and none due: neither service time nor tardiness; nor what nobody judged."""
    metrics = trace_metrics(shelf_hall(order("o1", "released", 0.0)))
    names = [name for name, _, _ in key_figures(metrics, None)]
    assert not {"Service time", "Tardiness", "Violations"} & set(names)
    done = trace_metrics(made_run(robots=3, seconds=300.0))
    found = {name: value for name, value, _ in key_figures(done, 2)}
    assert {"Service time", "Tardiness"} <= set(found)
    assert found["Violations"] == "2"


def test_the_page_is_small_and_alone() -> None:
    """12 robots for ten minutes take less than a megabyte, and nothing is loaded from anywhere."""
    trace = made_run(robots=12, seconds=600.0)
    page = render_trace(trace, trace_metrics(trace), 0)
    assert len(page.encode()) < 1_000_000
    assert re.findall(r'(?:src|href)="(?!#|data:)', page) == []
    assert re.findall(r"https?://(?!www\.w3\.org/2000/svg)", page) == []
    assert page == render_trace(trace, trace_metrics(trace), 0)
    json.loads(re.findall(r'id="data">(.*?)</script>', page, re.S)[0])


def test_cpu_times_do_not_change_the_page() -> None:
    """The same run decided more slowly has the same report, byte for byte."""
    trace = made_run(robots=3, seconds=100.0)
    slower = tuple(
        {**event, "cpu_s": 9.0} if event["event"] == "decision" else event for event in trace.events
    )
    pages = [
        render_trace(each, trace_metrics(each)) for each in (trace, replace(trace, events=slower))
    ]
    assert slower != trace.events
    assert pages[0] == pages[1]
