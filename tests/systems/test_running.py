"""Scenarios run through time: every order done, no body touches another, the same each time."""

import random
from collections.abc import Callable
from dataclasses import replace

import pytest
from tests.systems.sites import CARRIER, hall

from clearway.assign import LookAhead, NearestIdle
from clearway.coordinate import Lifelong
from clearway.execute import CellConflicts, RightOfWay
from clearway.formats.trace_file import dump_trace, without_timings
from clearway.model import (
    Disturbances,
    Layout,
    Obstacle,
    Order,
    Pose,
    Robot,
    Scenario,
    Simulation,
    Site,
    Surprise,
    Task,
    Visit,
    Zone,
)
from clearway.plan import LaneTrips, TailTrips
from clearway.protocols import TripPlanner
from clearway.systems.simulate import Simulated, run_through_time
from clearway.validate.lane_trace import validate_on_lanes
from clearway.validate.trace_judge import validate_trace
from clearway.world.channels import lane_grid
from clearway.world.dynamic_map import DynamicMap
from clearway.world.lifelong import lifelong_warehouse
from clearway.world.shelf_batch import shelf_batch

SMALL = {
    rule: Layout(rule, blocks=(4, 4, 4), bands=3)
    for rule in ("bidirectional", "compact", "one_way")
}
PAPER = {rule: Layout(rule) for rule in SMALL}


def judged(run: Simulated) -> list[str]:
    """Return all that the judge has against a run."""
    return [str(violation) for violation in validate_trace(run.trace)]


def judged_on_lanes(run: Simulated) -> list[str]:
    """Return all that the judges of bodies and of lanes have against a run on time."""
    layout = run.trace.site.layout
    assert layout is not None
    found = validate_on_lanes(run.trace, lane_grid(layout))
    return judged(run) + [str(violation) for violation in found]


@pytest.mark.parametrize("turn", [0.0, 1.0])
@pytest.mark.parametrize("rules", ["waiting", "search"])
@pytest.mark.parametrize("rule", list(PAPER))
def test_twenty_robots_do_all_orders_whatever_their_batteries(
    rule: str, rules: str, turn: float
) -> None:
    """R-B49: 250 orders, batteries that start at 15 to 100 %, both turn settings."""
    scenario = shelf_batch(
        PAPER[rule],
        20,
        250,
        7,
        turn_seconds=turn,
        energy=(0.15, 1.0),
        settings={"rules": rules},
    )
    run = run_through_time(scenario)
    assert run.status == "done"
    assert run.trace.events[-1]["orders_done"] == 250
    assert judged_on_lanes(run) == []
    assert any(e["purpose"] == "charge" for e in run.trace.of("decision"))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("rule", list(SMALL))
def test_late_robots_on_lanes_keep_the_order_of_passage(rule: str, seed: int) -> None:
    """R-B37: random stops and slow robots delay others, but nobody is ever hit or left behind."""
    scenario = late(shelf_batch(SMALL[rule], 6, 24, seed), stops=60.0)
    run = run_through_time(scenario)
    assert run.status == "done"
    assert any(e["kind"] == "stop" for e in run.trace.of("fault"))
    assert judged(run) == []


@pytest.mark.parametrize("seed", range(2))
def test_late_robots_with_true_shapes_keep_the_order_of_passage(seed: int) -> None:
    scenario = late(warehouse(6, seed, minutes=4.0), stops=60.0)
    run = run_through_time(scenario)
    assert run.trace.events[-1]["orders_done"] > 5
    assert judged(run) == []


def late(scenario: Scenario, stops: float) -> Scenario:
    disturbances = Disturbances(stops_per_hour=stops, slow=0.3, slowness=0.6)
    return replace(scenario, simulation=replace(scenario.simulation, disturbances=disturbances))


def warehouse(robots: int, seed: int, minutes: float) -> Scenario:
    """Return carriers in the warehouse with orders that never end, and clearance for delays."""
    scenario = lifelong_warehouse(robots, seed, fleet="carriers", picks=30, minutes=minutes)
    types = {name: replace(kind, clearance=0.1) for name, kind in scenario.robot_types.items()}
    return replace(scenario, robot_types=types)


@pytest.mark.parametrize(
    "scenario",
    [
        shelf_batch(SMALL["bidirectional"], 6, 20, 1),
        late(shelf_batch(SMALL["bidirectional"], 6, 20, 1), stops=60.0),
        late(warehouse(4, 1, minutes=2.0), stops=60.0),
    ],
    ids=["lanes", "late on lanes", "late with true shapes"],
)
def test_the_same_scenario_gives_the_same_trace(scenario: Scenario) -> None:
    one, other = (dump_trace(run_through_time(scenario).trace) for _ in range(2))
    assert without_timings(one.splitlines()) == without_timings(other.splitlines())


def test_another_seed_gives_another_trace() -> None:
    one, other = (
        dump_trace(run_through_time(warehouse(4, 1, minutes=1.0), seed=seed).trace)
        for seed in (1, 2)
    )
    assert one != other


def lanes_by(rules: str) -> Callable[[Scenario], TripPlanner]:
    def made(scenario: Scenario) -> TripPlanner:
        assert scenario.site.layout is not None
        grid = lane_grid(scenario.site.layout)
        kind = scenario.robot_types["agv"]
        return LaneTrips(grid, scenario.robots, kind, DynamicMap(grid), rules)  # type: ignore[arg-type]

    return made


@pytest.mark.parametrize("rule", list(SMALL))
@pytest.mark.parametrize(
    "trips", [lanes_by("waiting"), lanes_by("search"), TailTrips], ids=["rules", "search", "tails"]
)
@pytest.mark.parametrize("dispatch", [NearestIdle, LookAhead], ids=["nearest", "ahead"])
def test_each_dispatcher_goes_with_each_planner_on_each_layout(
    dispatch: type[NearestIdle] | type[LookAhead],
    trips: Callable[[Scenario], TripPlanner],
    rule: str,
) -> None:
    """Dispatching of shelves even drives holonomic robots that see lanes as open floor."""
    scenario = shelf_batch(SMALL[rule], 3, 9, 2)
    if trips is TailTrips:
        kind = replace(scenario.robot_types["agv"], kinematics="holonomic")
        scenario = replace(scenario, robot_types={"agv": kind})

    def execute(scenario: Scenario) -> RightOfWay:
        return RightOfWay(CellConflicts(lane_grid(SMALL[rule])))

    system = Lifelong("crossed", dispatch, trips, execute)
    run = run_through_time(scenario, system)
    assert run.status == "done"
    assert (judged if trips is TailTrips else judged_on_lanes)(run) == []


def test_time_is_up_with_orders_open() -> None:
    scenario = shelf_batch(SMALL["compact"], 2, 20, 0)
    run = run_through_time(replace(scenario, simulation=Simulation(until=60.0)))
    end = run.trace.events[-1]
    assert (run.status, end["t"]) == ("ended", 60.0)
    assert end["orders_open"] == 20 - end["orders_done"] > 0
    assert judged(run) == []


@pytest.mark.parametrize("stops", [None, 0.0, 120.0], ids=["on time", "slow", "stopping"])
def test_robots_that_start_in_no_bay_drive_to_one_at_once(stops: float | None) -> None:
    """Robot b stands in a's way; the planner counts on it being led to its bay."""
    bays = tuple(Zone(f"p{y}", "parking", square(3.0, y), Pose(3.0, y, 0.0)) for y in (3.0, 9.0))
    scenario = hall(
        site=Site(((0, 0), (20, 0), (20, 12), (0, 12)), zones=bays),
        robot_types={"carrier": replace(CARRIER, clearance=0.1)},
        robots=(
            Robot("a", "carrier", Pose(3.0, 3.0, 0.0)),
            Robot("b", "carrier", Pose(10.0, 9.0, 0.0)),
        ),
        orders=(Order(Task("t1", (Visit("t1", Pose(16.0, 9.0, 0.0), 1.0),), "a")),),
    )
    run = run_through_time(scenario if stops is None else late(scenario, stops))
    assert run.status == "done"
    ends = {e["robot"]: (e["x"][-1], e["y"][-1]) for e in run.trace.of("motion")}
    assert ends["b"] == pytest.approx((3.0, 9.0), abs=1e-5)
    assert judged(run) == []


def square(x: float, y: float) -> tuple[tuple[float, float], ...]:
    return ((x - 2, y - 2), (x + 2, y - 2), (x + 2, y + 2), (x - 2, y + 2))


def test_a_service_goes_on_though_its_trip_is_given_up() -> None:
    """A wall closes the way to the second visit of 8 s into the first; the robot turns home then.

    Its order is given back and fails, as it leads nowhere; what the robot does next waits until
    the first visit is over.
    """
    bay = Zone("p", "parking", square(3.0, 6.0), Pose(3.0, 6.0, 0.0))
    visits = Visit("far", Pose(10.0, 6.0, 0.0), 20.0), Visit("far", Pose(25.0, 6.0, 0.0), 1.0)
    near = Order(Task("near", (Visit("near", Pose(6.0, 6.0, 0.0), 1.0),)))
    scenario = hall(
        site=Site(((0, 0), (30, 0), (30, 12), (0, 12)), zones=(bay,)),
        robots=(Robot("a", "carrier", Pose(3.0, 6.0, 0.0)),),
        orders=(Order(Task("far", visits)), near),
        simulation=Simulation(
            until=200.0, surprises=(Surprise(12.0, Obstacle(wall=((18.0, 0.0), (18.0, 12.0)))),)
        ),
    )
    run = run_through_time(scenario)
    assert judged(run) == []
    stays = [(e["state"], e["t"]) for e in run.trace.of("visit") if e["task"] == "far"]
    assert [state for state, _ in stays] == ["arrived", "left"]
    assert stays[1][1] - stays[0][1] == pytest.approx(20.0)
    states = [e["state"] for e in run.trace.of("order") if e["order"] == "far"]
    assert states[:4] == ["released", "assigned", "started", "released"]
    assert run.trace.events[-1]["orders_done"] == 1


@pytest.mark.parametrize(
    ("seed", "robots", "orders", "dispatch", "stops"),
    [(3, 4, 16, "nearest", 0.0), (5, 6, 20, "ahead", 0.0), (8, 6, 20, "nearest", 60.0)],
)
def test_obstacles_on_lanes_leave_a_right_trace(
    seed: int, robots: int, orders: int, dispatch: str, stops: float
) -> None:
    """Discs fall into the lanes; orders may fail, but nothing is hit and nobody breaks down."""
    scenario = shelf_batch(
        SMALL["bidirectional"], robots, orders, seed, settings={"dispatch": dispatch}
    )
    rng = random.Random(seed)
    found = tuple(
        Surprise(at, Obstacle(disc=(rng.uniform(1.0, 17.0), rng.uniform(1.0, 9.0), 0.4)))
        for at in (20.3, 40.7, 60.1)
    )
    simulation = Simulation(
        until=600.0, surprises=found, disturbances=Disturbances(stops_per_hour=stops)
    )
    run = run_through_time(replace(scenario, simulation=simulation))
    assert run.status in ("done", "ended")
    assert any(e["kind"] == "obstacle" for e in run.trace.of("fault"))
    assert judged(run) == []
