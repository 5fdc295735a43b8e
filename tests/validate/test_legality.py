"""What is wrong with a scenario can be told before anybody plans."""

import dataclasses
import math

import pytest

from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Order,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
    Zone,
)
from clearway.validate.finding import Finding
from clearway.validate.legality import Legality, check_scenario

ROOM = ((0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (0.0, 10.0))
BLOCK = Obstacle(polygon=((18.0, 3.0), (22.0, 3.0), (22.0, 7.0), (18.0, 7.0)))
CARRIER = RobotType("carrier", Footprint.rectangle(3.0, 2.0), "four_wheel", Limits(2.5))
CART = RobotType("cart", Footprint(radius=0.5), "differential", Limits(1.5), capacity=0)


def scenario(
    *,
    starts: dict[str, tuple[str, Pose]] | None = None,
    orders: tuple[Order, ...] = (),
    obstacles: tuple[Obstacle, ...] = (BLOCK,),
    zones: tuple[Zone, ...] = (),
    border: str = "closed",
    carrier: RobotType = CARRIER,
) -> Scenario:
    fleet = starts or {"r1": ("carrier", Pose(5.0, 5.0, 0.0))}
    return Scenario(
        name="room",
        site=Site(ROOM, obstacles, zones, "open" if border == "open" else "closed"),
        robot_types={"carrier": carrier, "cart": CART},
        robots=tuple(Robot(name, *rest) for name, rest in fleet.items()),
        orders=orders,
    )


def order(name: str, *visits: Visit, robot: str | None = None) -> Order:
    return Order(Task(name, visits, robot))


def at(x: float, y: float, theta: float = 0.0, **rest: str) -> Visit:
    return Visit("t", Pose(x, y, theta), **rest)


def only(legality: Legality) -> Finding:
    assert len(legality.findings) == 1, legality.findings
    return legality.findings[0]


def test_a_sound_scenario_has_no_findings_and_known_clearances() -> None:
    """A 3 m body at (5, 5) is 3.5 m from the west wall; at (15, 5) it is 1.5 m from the block."""
    legality = check_scenario(scenario(orders=(order("t1", at(15.0, 5.0)),)))
    assert legality
    assert legality.findings == ()
    assert legality.clearances == pytest.approx({"robots[0].start": 3.5, "tasks[0].pose": 1.5})
    assert legality.reachable == {"r1": frozenset({"t1"})}


@pytest.mark.parametrize(("x", "depth"), [(16.4, 0.0), (16.5, 0.0), (16.5009, 0.0009), (17.0, 0.5)])
def test_a_start_in_an_obstacle(x: float, depth: float) -> None:
    """Contact is fine, and so is 0.9 mm; half a metre of overlap proves that no plan is right."""
    legality = check_scenario(scenario(starts={"r1": ("carrier", Pose(x, 5.0, 0.0))}))
    if depth > 0.001:
        finding = only(legality)
        assert (finding.kind, finding.severity) == ("start_in_obstacle", "error")
        assert finding.key == "robots[0].start"
        assert finding.robots == ("r1",)
        assert finding.place == (x, 5.0)
        assert finding.proof
        assert "site.obstacles[0]" in finding.text
        assert finding.depth == pytest.approx(depth, abs=1e-5)
    else:
        assert legality.findings == ()
    assert legality.clearances["robots[0].start"] == pytest.approx(16.5 - x, abs=1e-5)


@pytest.mark.parametrize(
    "obstacle", [Obstacle(disc=(6.4, 5.0, 0.2)), Obstacle(wall=((6.2, 0.0), (6.2, 10.0)))]
)
def test_discs_and_walls_are_met_exactly(obstacle: Obstacle) -> None:
    """The front is at 6.5: a disc from 6.2 on and a wall at 6.2 are both 0.3 m inside."""
    finding = only(check_scenario(scenario(obstacles=(obstacle,))))
    assert finding.depth == pytest.approx(0.3, abs=1e-5)


def test_a_round_body_meets_a_round_obstacle() -> None:
    """Discs of 0.5 m and 1 m with centres 1.2 m apart overlap by 0.3 m."""
    bad = scenario(
        starts={"c": ("cart", Pose(5.0, 5.0, 0.0))}, obstacles=(Obstacle(disc=(6.2, 5.0, 1.0)),)
    )
    assert only(check_scenario(bad)).depth == pytest.approx(0.3)


def test_a_corner_in_a_side_is_as_deep_as_its_tip() -> None:
    """Turned by 45 degrees the corner is 2.5 / sqrt(2) before the middle; 1.2 mm is too deep."""
    tip = 2.5 / math.sqrt(2.0)
    for depth, is_legal in ((0.0012, False), (0.0008, True)):
        start = Pose(18.0 - tip + depth, 5.0 - 0.5 / math.sqrt(2.0), math.pi / 4.0)
        legality = check_scenario(scenario(starts={"r1": ("carrier", start)}))
        assert bool(legality) is is_legal
        assert legality.clearances["robots[0].start"] == pytest.approx(-depth, abs=1e-9)


def test_starts_overlap_once_for_a_pair() -> None:
    """Two bodies of 3 m with centres 2.9 m apart overlap by 0.1 m, told once."""
    starts = {"a": ("carrier", Pose(5.0, 5.0, 0.0)), "b": ("carrier", Pose(7.9, 5.0, 0.0))}
    legality = check_scenario(scenario(starts=starts))
    finding = only(legality)
    assert (finding.kind, finding.robots, finding.proof) == ("starts_overlap", ("a", "b"), True)
    assert finding.depth == pytest.approx(0.1, abs=1e-5)
    assert legality.clearances["robots[1].start"] == pytest.approx(-0.1, abs=1e-5)


def test_two_robots_at_the_very_same_start() -> None:
    """Equal shapes are not mistaken for one and the same robot."""
    starts = {"a": ("carrier", Pose(5.0, 5.0, 0.0)), "b": ("carrier", Pose(5.0, 5.0, 0.0))}
    assert only(check_scenario(scenario(starts=starts))).kind == "starts_overlap"


def test_clearance_at_a_start_counts_the_neighbour() -> None:
    """Carts of 0.5 m with centres 1.2 m apart have 0.2 m between them."""
    starts = {"a": ("cart", Pose(5.0, 5.0, 0.0)), "b": ("cart", Pose(6.2, 5.0, 0.0))}
    clearances = check_scenario(scenario(starts=starts)).clearances
    assert clearances["robots[0].start"] == pytest.approx(0.2)
    assert clearances["robots[1].start"] == pytest.approx(0.2)


@pytest.mark.parametrize(("x", "is_legal"), [(1.5, True), (1.4985, True), (1.3, False)])
def test_outside_the_bounds(x: float, is_legal: bool) -> None:
    """The judge allows 2 mm over a closed border; an open border binds nobody."""
    starts = {"r1": ("carrier", Pose(x, 5.0, 0.0))}
    legality = check_scenario(scenario(starts=starts))
    assert bool(legality) is is_legal
    if not is_legal:
        assert only(legality).kind == "start_outside"
        assert only(legality).depth == pytest.approx(1.5 - x)
    assert check_scenario(scenario(starts=starts, border="open")).findings == ()


def test_a_visit_in_an_obstacle_is_a_proof_only_if_nobody_fits() -> None:
    """The cart fits beside the block where the carrier does not; inside it, neither does."""
    starts = {"r1": ("carrier", Pose(5.0, 5.0, 0.0)), "c": ("cart", Pose(9.0, 2.0, 0.0))}
    beside = check_scenario(scenario(starts=starts, orders=(order("t1", at(17.0, 5.0)),)))
    finding = only(beside)
    assert (finding.kind, finding.severity, finding.proof) == (
        "visit_in_obstacle",
        "warning",
        False,
    )
    inside = check_scenario(scenario(starts=starts, orders=(order("t1", at(19.0, 5.0)),)))
    finding = only(inside)
    assert (finding.severity, finding.proof, finding.key) == ("error", True, "tasks[0].pose")


def test_a_visit_is_tested_with_the_load_it_has() -> None:
    """A gate bar that stops only loaded carriers forbids the drop under it, not the pick."""
    bar = Obstacle(
        polygon=((29.0, 0.0), (31.0, 0.0), (31.0, 2.0), (29.0, 2.0)), blocks=("carrier:loaded",)
    )
    clear, under = (10.0, 5.0), (30.0, 2.0)
    plain = check_scenario(scenario(obstacles=(bar,), orders=(order("t1", at(*under)),)))
    assert plain.findings == ()
    drop = order("t1", at(*clear, load="pick"), at(*under, load="drop"))
    finding = only(check_scenario(scenario(obstacles=(bar,), orders=(drop,))))
    assert (finding.kind, finding.key) == ("visit_in_obstacle", "tasks[0].visits[1].pose")
    pick = order("t1", at(*under, load="pick"), at(*clear, load="drop"))
    finding = only(check_scenario(scenario(obstacles=(bar,), orders=(pick,))))
    assert finding.key == "tasks[0].visits[0].pose"


def test_a_loaded_footprint_needs_room_from_the_pick_on() -> None:
    """A load 4 m wide does not fit 1.5 m from the wall, where the bare robot stands well."""
    wide = dataclasses.replace(CARRIER, loaded_footprint=Footprint.rectangle(3.0, 4.0))
    orders = (order("t1", at(30.0, 1.5, load="pick"), at(30.0, 5.0, load="drop")),)
    finding = only(check_scenario(scenario(orders=orders, carrier=wide)))
    assert (finding.kind, finding.key) == ("visit_outside", "tasks[0].visits[0].pose")
    assert finding.depth == pytest.approx(0.5)


def test_parking_must_fit_somebody() -> None:
    """A bay in the block is an error; a bay where only the cart fits is a warning."""

    def bay(x: float) -> Zone:
        return Zone("bay", "parking", ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), Pose(x, 5.0, 0.0))

    finding = only(check_scenario(scenario(zones=(bay(20.0),))))
    assert (finding.kind, finding.severity, finding.key) == (
        "zone_in_obstacle",
        "error",
        "site.zones[0].pose",
    )
    assert not finding.proof
    starts = {"r1": ("carrier", Pose(5.0, 5.0, 0.0)), "c": ("cart", Pose(9.0, 2.0, 0.0))}
    assert only(check_scenario(scenario(starts=starts, zones=(bay(17.0),)))).severity == "warning"


def test_more_robots_than_room() -> None:
    """The room has 384 m^2 beside the block; 65 bodies of 6 m^2 cannot be placed at all."""

    def heap(count: int) -> set[str]:
        starts = {f"r{i}": ("carrier", Pose(5.0, 5.0, 0.0)) for i in range(count)}
        legality = check_scenario(scenario(starts=starts))
        return {f.kind for f in legality.findings if f.proof}

    assert "no_room" in heap(65)
    assert "no_room" not in heap(60)


def test_final_rests_that_overlap() -> None:
    """Two robots bound to goals 1 m apart cannot both rest there; free tasks only warn."""
    starts = {"a": ("carrier", Pose(5.0, 5.0, 0.0)), "b": ("carrier", Pose(9.0, 5.0, 0.0))}
    first, second = at(30.0, 5.0), at(31.0, 5.0)
    bound = (order("t1", first, robot="a"), order("t2", second, robot="b"))
    finding = only(check_scenario(scenario(starts=starts, orders=bound)))
    assert (finding.kind, finding.severity, finding.robots) == (
        "rests_overlap",
        "error",
        ("a", "b"),
    )
    # Bodies 3 m x 2 m, 1 m apart along x, come apart by 2 m more along x, or by 2 m along y.
    assert finding.depth == pytest.approx(2.0)
    free = (order("t1", first), order("t2", second, robot="b"))
    assert only(check_scenario(scenario(starts=starts, orders=free))).severity == "warning"
    more = (*bound, order("t3", at(30.0, 1.5), robot="a"))
    assert only(check_scenario(scenario(starts=starts, orders=more))).severity == "warning"
    same = (order("t1", first, robot="a"), order("t2", second, robot="a"))
    assert check_scenario(scenario(starts=starts, orders=same)).findings == ()


def gate(width: float, **rest: tuple[str, ...]) -> tuple[Obstacle, ...]:
    low, high = 5.0 - width / 2.0, 5.0 + width / 2.0
    return (
        Obstacle(wall=((20.0, 0.0), (20.0, low)), **rest),
        Obstacle(wall=((20.0, high), (20.0, 10.0)), **rest),
    )


def test_a_gate_too_narrow_is_a_proof() -> None:
    """A body 2 m wide has no way through 1.5 m; a cart of 1 m has, so the task is not lost."""
    orders = (order("t1", at(30.0, 5.0)),)
    finding = only(check_scenario(scenario(obstacles=gate(1.5), orders=orders)))
    assert (finding.kind, finding.severity, finding.proof) == ("unreachable", "error", True)
    assert (finding.key, finding.robots) == ("tasks[0].pose", ("r1",))
    assert "1.00 m" in finding.text
    starts = {"r1": ("carrier", Pose(5.0, 5.0, 0.0)), "c": ("cart", Pose(9.0, 2.0, 0.0))}
    mixed = check_scenario(scenario(starts=starts, obstacles=gate(1.5), orders=orders))
    assert mixed.findings == ()
    assert mixed.reachable == {"r1": frozenset(), "c": frozenset({"t1"})}


def test_a_way_back_that_is_shut_for_the_loaded() -> None:
    """Under the low gate the robot comes empty to fetch, but cannot bring its load back."""
    orders = (order("t1", at(30.0, 5.0, load="pick"), at(10.0, 5.0, load="drop")),)
    low = gate(1.0, blocks=("carrier:loaded",))
    finding = only(check_scenario(scenario(obstacles=low, orders=orders)))
    assert (finding.kind, finding.key) == ("unreachable", "tasks[0].visits[1].pose")
    assert finding.proof


def test_a_load_that_makes_a_robot_slimmer_proves_nothing() -> None:
    """A robot that folds up when loaded might pass with some other load on board."""
    folding = dataclasses.replace(CARRIER, loaded_footprint=Footprint.rectangle(3.0, 1.0))
    orders = (order("t1", at(30.0, 5.0)),)
    finding = only(check_scenario(scenario(obstacles=gate(1.5), orders=orders, carrier=folding)))
    assert (finding.kind, finding.proof) == ("unreachable", False)
    grown = dataclasses.replace(CARRIER, loaded_footprint=Footprint(radius=2.0))
    finding = only(check_scenario(scenario(obstacles=gate(1.5), orders=orders, carrier=grown)))
    assert finding.proof


def test_the_robot_of_a_task_is_the_only_one_that_counts() -> None:
    """A robot beyond the gate does not help a task that is bound to one before it."""
    starts = {"r1": ("carrier", Pose(5.0, 5.0, 0.0)), "r2": ("carrier", Pose(35.0, 5.0, 0.0))}
    bound = (order("t1", at(28.0, 5.0), robot="r1"),)
    legality = check_scenario(scenario(starts=starts, obstacles=gate(1.0), orders=bound))
    assert only(legality).robots == ("r1",)
    free = (order("t1", at(28.0, 5.0)),)
    legality = check_scenario(scenario(starts=starts, obstacles=gate(1.0), orders=free))
    assert legality.findings == ()
    assert legality.reachable == {"r1": frozenset(), "r2": frozenset({"t1"})}


def test_nobody_able() -> None:
    """A task that needs a capability or a load capacity nobody has is named at once."""
    starts = {"c": ("cart", Pose(9.0, 2.0, 0.0))}
    for visit in (at(30.0, 5.0, load="pick"), at(30.0, 5.0, needs="weld")):
        finding = only(check_scenario(scenario(starts=starts, orders=(order("t1", visit),))))
        assert (finding.kind, finding.key, finding.proof) == ("no_robot", "tasks[0]", True)


def test_an_illegal_start_is_told_once() -> None:
    """A robot that starts inside the block is misplaced; its tasks are not called unreachable."""
    starts = {"r1": ("carrier", Pose(20.0, 5.0, math.pi / 2.0))}
    legality = check_scenario(scenario(starts=starts, orders=(order("t1", at(30.0, 5.0)),)))
    assert [finding.kind for finding in legality.findings] == ["start_in_obstacle"]
