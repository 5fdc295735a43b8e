"""Robots with low batteries charge before they do anything else."""

from dataclasses import replace
from itertools import pairwise

from clearway.model import Battery, Scenario
from clearway.systems.simulate import run_through_time
from clearway.validate.trace_judge import validate_trace
from clearway.world.lifelong import lifelong_warehouse


def tired(chargers: int) -> Scenario:
    """Return four cars that begin with a quarter of batteries that last ten minutes.

    Two of the stations become chargers, where charging from empty takes a minute.
    """
    scenario = lifelong_warehouse(4, 3, picks=20, minutes=6.0)
    battery = Battery(capacity=600.0, reserve=0.2, charging=60.0)
    types = {name: replace(kind, battery=battery) for name, kind in scenario.robot_types.items()}
    stations = [zone.name for zone in scenario.site.zones_of("station")][:chargers]
    zones = tuple(
        replace(zone, kind="charger") if zone.name in stations else zone
        for zone in scenario.site.zones
    )
    return replace(
        scenario,
        robot_types=types,
        robots=tuple(replace(robot, energy=0.25) for robot in scenario.robots),
        site=replace(scenario.site, zones=zones),
    )


def test_robots_charge_and_go_on() -> None:
    run = run_through_time(tired(chargers=2))
    charged = [e for e in run.trace.of("visit") if e.get("purpose") == "charge"]
    assert {event["robot"] for event in charged} == {"r1", "r2", "r3", "r4"}
    assert run.trace.events[-1]["orders_done"] > 4
    levels = [event["level"] for event in run.trace.of("energy")]
    assert max(levels) > 0.85
    assert validate_trace(run.trace) == []


def test_no_two_robots_are_sent_to_one_charger_at_a_time() -> None:
    run = run_through_time(tired(chargers=1))
    spans, since = [], None
    for event in run.trace.of("visit"):
        if event.get("purpose") == "charge":
            since = event["t"]
        elif event["state"] == "left" and event["order"] is None and since is not None:
            spans.append((since, event["t"]))
    assert len(spans) > 1
    assert all(a[1] <= b[0] for a, b in pairwise(spans))


def test_without_chargers_levels_are_ignored() -> None:
    run = run_through_time(tired(chargers=0))
    assert run.trace.events[-1]["orders_done"] > 4
    assert not any(e["purpose"] == "charge" for e in run.trace.of("decision"))
