"""Obstacles come to light in a warehouse with lanes: shelves stay in order, robots go on."""

import random
from dataclasses import replace

import pytest

from clearway.model import Disturbances, Layout, Obstacle, Scenario, Simulation, Surprise, Trace
from clearway.systems.simulate import run_through_time
from clearway.validate.trace_judge import validate_trace
from clearway.world.channels import lane_grid
from clearway.world.shelf_batch import shelf_batch

LAYOUTS = {
    rule: Layout(rule, blocks=(4, 4, 4), bands=3)
    for rule in ("bidirectional", "compact", "one_way")
}
LATE = Disturbances(40.0, (2.0, 20.0), 0.3, 0.6)


def box(x: float, y: float, width: float = 1.0, height: float = 1.0) -> Obstacle:
    """Cover the cells from one on, but for their edges."""
    x0, y0, x1, y1 = x + 0.1, y + 0.1, x + width - 0.1, y + height - 0.1
    return Obstacle(polygon=((x0, y0), (x1, y0), (x1, y1), (x0, y1)))


def surprised(scenario: Scenario, seed: int, count: int = 4) -> Scenario:
    """Let obstacles of one to three cells come to light anywhere within the first 200 s."""
    draw = random.Random(seed)
    width, height = scenario.site.bounds[2]
    found = tuple(
        Surprise(
            draw.uniform(2.0, 200.0),
            box(int(draw.uniform(0.0, width)), int(draw.uniform(0.0, height)), *size),
        )
        for size in draw.choices([(1.0, 1.0), (2.0, 1.0), (1.0, 3.0)], k=count)
    )
    return replace(scenario, simulation=Simulation(until=3600.0, surprises=found))


def shelves_in(trace: Trace) -> dict[str, str]:
    """Return where shelves are in the end, by what robots did; two in one place fail."""
    at = {zone.name: zone.name for zone in trace.site.zones_of("shelf")}
    place: dict[str, str] = {}
    carried: dict[str, str] = {}
    for event in trace.events:
        if event["event"] == "visit" and event["state"] == "arrived":
            place[event["robot"]] = event["place"]
        elif event["event"] == "load":
            robot = event["robot"]
            if event["objects"]:
                (carried[robot],) = event["objects"]
                assert at.pop(carried[robot]) == place[robot]
            else:
                shelf = carried.pop(robot)
                assert place[robot] not in at.values(), f"two shelves in {place[robot]}"
                at[shelf] = place[robot]
    return at


@pytest.mark.parametrize("late", [None, LATE], ids=["on time", "late"])
@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
@pytest.mark.parametrize("rule", list(LAYOUTS))
@pytest.mark.parametrize("seed", range(3))
def test_every_order_is_done_or_fails_by_name(
    seed: int, rule: str, dispatch: str, late: Disturbances | None
) -> None:
    """R-B12, R-B13: whatever is closed, no shelf is lost and nobody is left with an order."""
    settings = {"dispatch": dispatch, "lift": 2.0, "lower": 2.0}
    base = shelf_batch(LAYOUTS[rule], 6, 20, seed, repeat=True, settings=settings)
    scenario = surprised(base, seed)
    if late:
        scenario = replace(scenario, simulation=replace(scenario.simulation, disturbances=late))
    run = run_through_time(scenario)
    assert run.status == "done"
    assert [str(violation) for violation in validate_trace(run.trace)] == []
    shelves_in(run.trace)
    failed = [e["reason"] for e in run.trace.of("order") if e["state"] == "failed"]
    assert run.trace.events[-1]["orders_done"] + len(failed) == 20
    assert all("obstacle" in reason or "taken by" in reason for reason in failed)
    assert len(failed) <= 5


def one_order(dispatch: str, *surprises: Surprise, robots: int = 1) -> Trace:
    """Run one order for g14 in the bidirectional layout."""
    base = shelf_batch(
        LAYOUTS["bidirectional"], robots, 1, 0, zone=[14], settings={"dispatch": dispatch}
    )
    run = run_through_time(replace(base, simulation=Simulation(until=3600.0, surprises=surprises)))
    assert run.status == "done"
    assert [str(violation) for violation in validate_trace(run.trace)] == []
    return run.trace


def around(name: str) -> Obstacle:
    """Cover an endpoint of the bidirectional layout."""
    x, y = lane_grid(LAYOUTS["bidirectional"]).endpoints[name].cell
    return box(float(x), float(y))


@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
def test_another_station_is_tried(dispatch: str) -> None:
    """The station that a robot drives to, or would drive to, is closed."""
    free = one_order(dispatch)
    told = next(e for e in free.of("decision") if e["purpose"] == "deliver")
    for at in (0.5, told["t"] + 0.5):
        trace = one_order(dispatch, Surprise(at, around(told["chosen"])))
        arrived = [e for e in trace.of("visit") if e["state"] == "arrived"]
        (station,) = [e["place"] for e in arrived if e["purpose"] == "deliver"]
        assert station != told["chosen"]
        assert trace.events[-1]["orders_done"] == 1
        shelves = shelves_in(trace)
        assert len(set(shelves.values())) == 72


@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
def test_an_order_fails_by_name_where_all_stations_are_closed(dispatch: str) -> None:
    """Its shelf is lifted already: it is put back."""
    names = [e.name for e in lane_grid(LAYOUTS["bidirectional"]).of_kind("station")]
    free = one_order(dispatch)
    told = next(e for e in free.of("decision") if e["purpose"] == "deliver")
    closed = [Surprise(told["t"] + 0.5, around(name)) for name in names]
    trace = one_order(dispatch, *closed)
    (failed,) = [e["reason"] for e in trace.of("order") if e["state"] == "failed"]
    assert "an obstacle closes the way to p" in failed


@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
def test_another_place_is_tried(dispatch: str) -> None:
    """With nobody else there is one vacant place; when it is closed the order fails by name."""
    free = one_order(dispatch)
    told = next(e for e in free.of("decision") if e["purpose"] == "store")
    trace = one_order(dispatch, Surprise(told["t"] + 0.5, around(told["chosen"])))
    (failed,) = [e["reason"] for e in trace.of("order") if e["state"] == "failed"]
    assert "obstacle" in failed


@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
def test_orders_for_a_shelf_in_an_obstacle_fail_by_name(dispatch: str) -> None:
    trace = one_order(dispatch, Surprise(0.5, around("g14")), robots=3)
    (failed,) = [e["reason"] for e in trace.of("order") if e["state"] == "failed"]
    assert failed == "an obstacle closes the way to g14"


def test_the_same_obstacles_give_the_same_trace() -> None:
    scenario = surprised(shelf_batch(LAYOUTS["compact"], 6, 20, 1), 1)
    one, other = (run_through_time(scenario).trace.events for _ in range(2))
    assert repr(one) == repr(other)
