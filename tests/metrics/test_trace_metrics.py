"""The figures of a run through time, against sums worked by hand.

The day of tests/data/bad_traces/story.py lasts 27 s. Cart ``a`` is on trips from 0 to 27 s, waits
1 s for its own stop, and is at visits for 2 + 3 + 1 s; it drives 5 m empty, then 15 m with a shelf.
Cart ``b`` is on trips from 1 to 11 s and from 17 to 22 s, waits 2 s for ``a``, is at visits for
2 + 5 s, and drives 6 m empty for its order and 6 m back for nobody.
"""

from dataclasses import replace

import pytest

from clearway.metrics import ending, told, trace_metrics, trace_to_json
from clearway.model import Pose
from clearway.validate import validate_trace


@pytest.fixture(scope="module")
def day(traces):
    return trace_metrics(traces.right())


def test_orders_are_counted_by_what_became_of_them(day) -> None:
    """Two are done, one failed, and one came too late to be taken up."""
    assert (day.orders, day.orders_done, day.orders_failed, day.orders_open) == (4, 2, 1, 1)
    assert (day.duration, day.makespan, day.status) == (27.0, 27.0, "ended")
    assert day.throughput == pytest.approx(2 * 3600 / 27)


def test_service_time_runs_from_release_to_done(day) -> None:
    """27 s for the first order, 11 - 1 s for the second; 95 % lies at 10 + 0.95 * 17 s."""
    assert day.service_time_mean == pytest.approx((27 + 10) / 2)
    assert day.service_time_p95 == pytest.approx(10 + 0.95 * 17)


def test_tardiness_is_the_time_after_due(day) -> None:
    """The second order is due at 8 s and done at 11 s; the others are never due."""
    assert day.tardiness == pytest.approx(3.0)
    assert day.orders_late == 1


def test_time_is_spent_on_trips_waiting_and_at_visits(day) -> None:
    """Standing at a visit is service, standing without a trip is neither."""
    a, b = day.per_robot
    assert (a.robot, a.trips, a.orders_done) == ("a", 3, 1)
    assert (b.robot, b.trips, b.orders_done) == ("b", 2, 1)
    assert (a.waiting, a.service, a.utilisation) == pytest.approx((1.0, 6.0, 1.0))
    assert (b.waiting, b.service, b.utilisation) == pytest.approx((2.0, 7.0, 15 / 27))
    assert day.waiting == pytest.approx(3.0)
    assert day.wait_share == pytest.approx(3 / 54)
    assert day.utilisation == pytest.approx((1 + 15 / 27) / 2)


def test_travel_for_orders_with_nothing_on_board_is_empty(day) -> None:
    """Going back without an order is no travel for one."""
    a, b = day.per_robot
    assert (a.distance, a.empty) == pytest.approx((20.0, 5.0))
    assert (b.distance, b.empty) == pytest.approx((12.0, 6.0))
    assert day.empty_share == pytest.approx(11 / 32)
    assert day.pickups == 1


def test_a_fleet_that_never_carries_is_not_told_to_drive_empty(traces) -> None:
    """Without anything to carry there is no empty travel to speak of."""
    metrics = trace_metrics(traces.errand())
    assert (metrics.pickups, metrics.empty_share) == (0, pytest.approx(1.0))
    assert "empty" not in told(metrics)


def test_energy_used_is_what_levels_drop(day) -> None:
    """From 1 to 0.9, and from 1 to 0.7 before charging."""
    assert [robot.energy_used for robot in day.per_robot] == pytest.approx([0.1, 0.3])
    assert day.energy_used == pytest.approx(0.4)
    assert day.lowest_energy == pytest.approx(0.7)


def test_waits_without_an_order_do_not_count(day) -> None:
    """One stop of its own, one wait for the other robot; having nothing to do is no wait."""
    assert (day.waits, day.waits_for_robots) == (2, 1)


def test_decisions_have_a_price(day) -> None:
    """Five decisions of a quarter of a second each."""
    assert (day.decisions.count, day.decisions.refused) == (5, 0)
    assert day.decisions.cpu_total == pytest.approx(1.25)
    assert day.decisions.cpu_p99 == pytest.approx(0.25)


def test_a_refused_decision_is_no_trip(traces) -> None:
    """A robot that was refused stays idle."""
    trace = traces.right()
    charge = trace.of("decision")[-1]
    number = trace.of("decision").index(charge)
    refused = traces.changed("decision", number, trace, outcome="refused")
    metrics = trace_metrics(refused)
    assert metrics.decisions.refused == 1
    assert metrics.per_robot[1].utilisation == pytest.approx(10 / 27)


def test_the_closing_figures_are_those_that_the_judge_computes(traces) -> None:
    """Two hands compute them: whatever part of a run there is, they agree."""
    events = traces.right().events[:-1]
    for count in range(1, len(events) + 1):
        part = replace(traces.right(), events=events[:count])
        last = part.events[-1]
        t = float(last["t"][-1]) if last["event"] == "motion" else last["t"]
        end = {"event": "end", "t": t, "status": "interrupted", **ending(part)}
        assert validate_trace(replace(part, events=(*part.events, end))) == []


def test_a_trip_that_never_ends_lasts_as_long_as_the_trace(traces) -> None:
    """A robot that stands before its visit until the run is cut off has waited all the time."""
    story = traces.Story({"a": Pose(2.0, 2.0, 0.0)})
    story.take("a", None, "park")
    story.tell("energy", 50.0, robot="a", level=1.0)
    metrics = trace_metrics(replace(story.trace(), events=tuple(story.events), is_whole=False))
    assert metrics.status == "cut short"
    assert metrics.waiting == pytest.approx(50.0)
    assert metrics.per_robot[0].trips == 0


def test_a_failed_order_ends_its_trip(traces) -> None:
    """What is called off need not be driven to its end."""
    story = traces.Story({"a": Pose(2.0, 2.0, 0.0)})
    story.release("o1", 0.0)
    story.take("a", "o1", "order")
    story.tell("order", 10.0, order="o1", state="failed", robot="a")
    story.tell("energy", 40.0, robot="a", level=1.0)
    metrics = trace_metrics(story.trace(status="ended"))
    assert metrics.per_robot[0].utilisation == pytest.approx(0.25)
    assert metrics.waiting == pytest.approx(10.0)


def test_a_trace_in_which_nothing_happens_has_figures(traces) -> None:
    """No order, no motion, no time: zeros, and no division by them."""
    metrics = trace_metrics(replace(traces.right(), events=()))
    assert (metrics.duration, metrics.throughput, metrics.utilisation) == (0.0, 0.0, 0.0)
    assert metrics.service_time_mean is metrics.tardiness is None
    assert "0 of 0 done" in told(metrics)


def test_the_table_tells_the_figures(day) -> None:
    """One line for each, with its unit."""
    text = told(day)
    for part in (
        "orders        2 of 4 done, 1 open, 1 failed (2 robots, ended)",
        "throughput    266.7 orders an hour over 27 s",
        "service time  18.5 s from release to done",
        "tardiness     3.0 s after due times in all, orders late: 1",
        "utilisation   77.8 % of robot time on trips",
        "waiting       5.6 % of robot time, 3 s; 2 waits, 1 for other robots",
        "distance      32 m, 34.4 % of it empty",
        "energy        0.40 full charges used, the lowest level 70.0 %",
        "decisions     5, 0 refused; CPU 1.25 s, median 250.0 ms",
    ):
        assert part in text


def test_the_file_has_robots_by_name(day) -> None:
    """``metrics.json`` holds all figures, each robot's under its id."""
    content = trace_to_json(day)
    assert content["orders_done"] == 2
    assert content["per_robot"]["b"]["waiting"] == pytest.approx(2.0)
    assert content["decisions"]["count"] == 5
