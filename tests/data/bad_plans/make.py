"""Writes the wrong plans beside this file, and the right ones in ``../right_plans``.

Each wrong plan is a right one with one thing wrong; its file is named after the kind of
violation, with a variant after two dashes. Run ``python make.py`` from a checkout.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from clearway.formats.plan_file import write_plan
from clearway.formats.sampling import sample
from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Piece,
    PlanRecord,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Track,
    Trajectory,
    Visit,
    Zone,
    to_ticks,
)

Leg = float | tuple[str | None, tuple[float, float, float], float]

FLOOR = Site(bounds=((0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)))
CART = RobotType("cart", Footprint.rectangle(1.0, 0.6), "differential", Limits(speed=1.0))
CAR = RobotType(
    "car", Footprint.rectangle(2.0, 1.0, rear=0.5), "ackermann", Limits(1.0, turning_radius=2.0)
)
CRAB = RobotType(
    "crab",
    Footprint.rectangle(2.0, 1.0),
    "four_wheel",
    Limits(speed=1.0, yaw_rate=0.5, turning_radius=2.0),
)
PUCK = RobotType("puck", Footprint(radius=0.5), "holonomic", Limits(speed=1.0))
LIFTER = replace(CART, name="lifter", loaded_footprint=Footprint.rectangle(1.0, 1.6))


def journey(robot: str, start: Pose, *legs: Leg) -> Trajectory:
    """Return a trajectory of legs: seconds to stand, or mode, twist and seconds to move."""
    pieces: list[Piece] = []
    timing: list[tuple[int, int]] = []
    pose, tick = start, 0
    for leg in legs:
        if isinstance(leg, float):
            tick += to_ticks(leg)
            continue
        mode, twist, seconds = leg
        pieces.append(Piece(len(pieces), mode, pose, twist))
        timing.append((tick, tick + to_ticks(seconds)))
        pose, tick = pieces[-1].end, timing[-1][1]
    return Trajectory(robot, start, tuple(pieces), tuple(timing))


def ahead(metres: float, speed: float = 1.0) -> Leg:
    """Return a leg straight ahead, or back for negative metres."""
    return None, (metres, 0.0, 0.0), abs(metres) / speed


def plan(
    types: list[RobotType],
    journeys: list[Trajectory],
    tours: Mapping[str, tuple[Visit, ...]] | None = None,
    site: Site = FLOOR,
    **changes: object,
) -> PlanRecord:
    """Return the plan in which robot i has type i and makes journey i."""
    tours = {j.robot: (tours or {}).get(j.robot, ()) for j in journeys}
    robots = tuple(Robot(j.robot, k.name, j.start) for j, k in zip(journeys, types, strict=True))
    ends = [j.end / 1000.0 for j in journeys]
    record = PlanRecord(
        scenario="by hand",
        system="by hand",
        seed=0,
        status=Status.SOLVED,
        site=site,
        robot_types={kind.name: kind for kind in types},
        robots=robots,
        tours=tours,
        tracks={
            j.robot: sample(j, kind.kinematics == "four_wheel")
            for j, kind in zip(journeys, types, strict=True)
        },
        assignment={
            name: tuple(dict.fromkeys(v.task for v in visits if v.task is not None))
            for name, visits in tours.items()
        },
        sum_of_costs=sum(ends),
        makespan=max(ends),
    )
    return replace(record, **changes)


def samples(kind: RobotType, rows: list[tuple[float, float, float, float]]) -> PlanRecord:
    """Return the plan of one robot ``a`` whose samples ``t, x, y, theta`` are given."""
    t, x, y, theta = (np.array(column) for column in zip(*rows, strict=True))
    start = Pose(*rows[0][1:])
    record = plan([kind], [journey("a", start)], sum_of_costs=rows[-1][0], makespan=rows[-1][0])
    return replace(record, tracks={"a": Track(t, x, y, theta, (None,) * len(t))})


def ramp(first: float, last: float, acceleration: float = 1.0) -> list[Leg]:
    """Return legs of 0.1 s that change the speed from ``first`` to ``last`` (m/s)."""
    count = max(1, math.ceil(abs(last - first) / (0.1 * acceleration)))
    speeds = first + (last - first) * (np.arange(count) + 0.5) / count
    return [(None, (0.1 * float(v), 0.0, 0.0), 0.1) for v in speeds]


def alone(kind: RobotType, *legs: Leg, site: Site = FLOOR, **changes: object) -> PlanRecord:
    """Return the plan of one robot ``a`` from (5, 5), heading along x."""
    return plan([kind], [journey("a", Pose(5.0, 5.0, 0.0), *legs)], site=site, **changes)


def limited(kind: RobotType, **limits: float) -> RobotType:
    """Return a type with other limits."""
    return replace(kind, limits=replace(kind.limits, **limits))


def around(*obstacles: Obstacle, zones: tuple[Zone, ...] = ()) -> Site:
    """Return the floor with obstacles and zones on it."""
    return replace(FLOOR, obstacles=obstacles, zones=zones)


def box(x0: float, y0: float, x1: float, y1: float, *blocks: str) -> Obstacle:
    """Return a rectangular obstacle."""
    return Obstacle(polygon=((x0, y0), (x1, y0), (x1, y1), (x0, y1)), blocks=blocks)


def delivery(**changes: object) -> PlanRecord:
    """Return a lifter that picks at (5, 5) for 2 s and drops at (10, 5) for 1 s."""
    visits = (
        Visit("t1", Pose(5.0, 5.0, 0.0), 2.0, "pick"),
        Visit("t1", Pose(10.0, 5.0, 0.0), 1.0, "drop"),
    )
    trip = journey("a", Pose(5.0, 5.0, 0.0), 2.0, ahead(5.0), 1.0, ahead(3.0))
    return plan([LIFTER], [trip], {"a": visits}, **changes)


def hand_over(wait: float) -> PlanRecord:
    """Return two carts of which a gives to b for 3 s; b stays for ``wait`` s, then leaves."""
    tours = {
        "a": (Visit("t1", Pose(5.0, 5.0, 0.0), 3.0, together=("b",)),),
        "b": (Visit("t2", Pose(5.0, 6.0, 0.0), 3.0, together=("a",)),),
    }
    a = journey("a", Pose(3.0, 5.0, 0.0), ahead(2.0))
    b = journey("b", Pose(4.0, 6.0, 0.0), ahead(1.0), wait, ahead(2.0))
    return plan([CART, CART], [a, b], tours)


def in_turn(ready: float, *, released: float = 0.0) -> PlanRecord:
    """Return two carts: a serves t1 from 2 s to 5 s, b serves t2 for 1 s and leaves at ``ready``.

    t2 waits for t1, and for its release.
    """
    then = Visit("t2", Pose(8.0, 6.0, 0.0), 1.0, not_before=released, after=("t1",), due=5.5)
    tours = {"a": (Visit("t1", Pose(5.0, 5.0, 0.0), 3.0),), "b": (then,)}
    a = journey("a", Pose(3.0, 5.0, 0.0), ahead(2.0))
    b = journey("b", Pose(7.0, 6.0, 0.0), ahead(1.0), ready - 1.0, ahead(2.0))
    return plan([CART, CART], [a, b], tours)


def paper(cost: float) -> PlanRecord:
    """Return a crab whose cost is 12.641592653589793.

    2 m ahead cost 2, a turn of 1 rad on the radius 2 m costs 2 * 2, a switch between them 3,
    waiting 3 s 0.3, then a switch 3 and pi / 2 - 1.4 rad on the spot, with half a body of
    1 m, 2 * 0.1707963... = 0.3415926...
    """
    legs: list[Leg] = [
        ("forward", (2.0, 0.0, 0.0), 2.0),
        3.0,
        ("forward-left", (2.0, 0.0, 1.0), 2.0),
        ("rotate-left", (0.0, 0.0, math.pi / 2.0 - 1.4), 0.5),
    ]
    return alone(limited(CRAB, yaw_rate=0.5), *legs, cost=cost, cost_name="paper")


def wrong_plans() -> dict[str, PlanRecord]:
    """Return the wrong plans by name."""
    return {**_wrong_samples(), **_wrong_motion(), **_wrong_bodies(), **_wrong_work()}


def _wrong_samples() -> dict[str, PlanRecord]:
    two = alone(CART, ahead(0.4))
    late = replace(two.robots[0], start=Pose(5.0, 5.002, 0.0))
    turned = replace(two.robots[0], start=Pose(5.0, 5.0, 0.002))
    return {
        "step": samples(CART, [(0.0, 5.0, 5.0, 0.0), (0.2, 5.2, 5.0, 0.0)]),
        "turn": samples(PUCK, [(0.0, 5.0, 5.0, 0.0), (0.1, 5.0, 5.0, math.pi)]),
        "jump": samples(
            CART,
            [(0.0, 5.0, 5.0, 0.0), (0.1, 5.1, 5.0, 0.0), (0.1, 5.11, 5.0, 0.0)],
        ),
        "jump--heading": samples(
            limited(PUCK, yaw_rate=1.0), [(0.0, 5.0, 5.0, 0.0), (0.0, 5.0, 5.0, 0.1)]
        ),
        "start": replace(two, robots=(late,)),
        "start--heading": replace(two, robots=(turned,)),
    }


def _wrong_motion() -> dict[str, PlanRecord]:
    swift = limited(CART, acceleration=1.0, deceleration=1.0)
    arc = ("forward-left", (1.0, 0.0, 1.0 / 1.9), 1.1)
    aslant = 5.0 + 0.17 * np.arange(11) * 0.1
    return {
        "speed": alone(CART, ahead(3.0, speed=1.03)),
        "speed--backwards": alone(CART, ahead(-3.0, speed=1.03)),
        "reverse_speed": alone(limited(CART, reverse_speed=0.5), ahead(-3.0, speed=0.52)),
        "reverse_speed--forbidden": alone(limited(CART, reverse_speed=0.0), ahead(-0.1, 0.1)),
        "yaw_rate": alone(limited(CART, yaw_rate=0.5), (None, (0.0, 0.0, 1.03), 2.0)),
        "turning_radius": alone(CAR, (None, (1.0, 0.0, 1.0 / 1.9), 1.0)),
        "turning_radius--on-the-spot": alone(CAR, (None, (0.0, 0.0, 0.1), 1.0)),
        "turning_radius--four-wheel": alone(limited(CRAB, yaw_rate=1.0), arc),
        "acceleration": alone(swift, ahead(1.0), *ramp(1.0, 0.0)),
        "deceleration": alone(swift, *ramp(0.0, 1.0), ahead(1.0)),
        "slip": samples(
            CART, [(0.1 * i, 5.0 + 0.09 * i, float(aslant[i]), 0.0) for i in range(11)]
        ),
        "mode": alone(
            replace(CRAB, modes=("stop", "forward")), ("lateral-left", (0.0, 1.0, 0.0), 1.0)
        ),
        "mode--otherwise": alone(CRAB, ("forward", (0.0, 1.0, 0.0), 1.0)),
        "mode--wrong-side": alone(CRAB, ("reverse-left", (-1.0, 0.0, 0.4), 1.0)),
        "mode--off-centre": alone(CRAB, ("rotate-left", (0.02, 0.0, 0.4), 1.0)),
        "mode--stop": alone(CRAB, ("stop", (1.0, 0.0, 0.0), 1.0)),
        "mode--unsaid": alone(CRAB, (None, (1.0, 0.0, 0.0), 1.0)),
    }


def _wrong_bodies() -> dict[str, PlanRecord]:
    # The cart's right side is at y = 4.7, the turning cart's corners reach 0.583 m.
    notch = Obstacle(
        polygon=((6, 2), (9, 2), (9, 8), (6, 8), (6, 7.5), (8, 7.5), (8, 4.702), (6, 4.702))
    )
    spin: Leg = (None, (0.0, 0.0, math.pi / 2.0), 2.0)
    closed = Zone("dock", "closed", ((7.0, 4.0), (8.0, 4.0), (8.0, 6.0), (7.0, 6.0)))
    narrow = Site(((0.0, 4.697), (20.0, 4.697), (20.0, 10.0), (0.0, 10.0)))
    beside = journey("b", Pose(8.0, 5.598, 0.0))
    trip = journey("a", Pose(5.0, 5.0, 0.0), ahead(5.0))
    # Both stand at t = 0 and at every sample, and pass through each other in between.
    passing = journey("b", Pose(5.0, 5.0 - 0.04, 0.0))
    quick = limited(PUCK, speed=30.0)
    dash = [(0.0, 3.0, 5.0, 0.0), (0.1, 6.0, 5.0, 0.0), (0.2, 3.0, 5.0, 0.0)]
    dart = samples(replace(quick, name="dart", footprint=Footprint(radius=0.05)), dash)
    post = Obstacle(disc=(4.5, 5.0, 0.05))
    small = replace(PUCK, name="small", footprint=Footprint(radius=0.05))
    both = plan([small], [passing])
    return {
        "obstacle": alone(CART, ahead(3.0), site=around(box(6.0, 4.0, 9.0, 4.702))),
        "obstacle--disc": alone(CART, ahead(3.0), site=around(Obstacle(disc=(7.0, 4.0, 0.702)))),
        "obstacle--wall": alone(
            CART, ahead(3.0), site=around(Obstacle(wall=((7.0, 2.0), (7.0, 4.702))))
        ),
        "obstacle--notch": alone(CART, ahead(2.0), site=around(notch)),
        "obstacle--corner-swings-out": alone(CART, spin, site=around(box(4, 4, 6, 4.42))),
        "obstacle--between-samples": replace(dart, site=around(post)),
        "obstacle--loaded": delivery(site=around(box(6.0, 4.0, 9.0, 4.5, "lifter:loaded"))),
        "obstacle--at-rest": plan([CART], [beside], site=around(box(8.0, 5.0, 9.0, 6.0))),
        "bounds": alone(
            CART,
            ahead(3.0),
            site=replace(narrow, bounds=((0.0, 4.703), (20.0, 4.703), (20.0, 10.0), (0.0, 10.0))),
        ),
        "bounds--reflex": alone(
            CART,
            ahead(3.0),
            site=replace(
                narrow,
                bounds=((0, 0), (7, 0), (7, 4.703), (8, 4.703), (8, 0), (20, 0), (20, 10), (0, 10)),
            ),
        ),
        "zone": alone(CART, ahead(3.0), site=around(zones=(closed,))),
        "conflict": plan([CART, CART], [trip, beside]),
        "conflict--between-samples": replace(
            dart,
            robots=(*dart.robots, replace(both.robots[0], start=Pose(4.5, 5.0, 0.0))),
            robot_types={**dart.robot_types, "small": small},
            tours={"a": (), "b": ()},
            assignment={"a": (), "b": ()},
        ),
        "conflict--after-a-rest": plan(
            [CART, CART],
            [
                journey("a", Pose(5.0, 5.0, 0.0), ahead(3.0)),
                journey("b", Pose(8.0, 8.0, -math.pi / 2.0), 36.0, ahead(2.202)),
            ],
        ),
    }


def _wrong_work() -> dict[str, PlanRecord]:
    right = delivery()
    tour = right.tours["a"]
    off = replace(tour[1], pose=Pose(10.0, 5.011, 0.0))
    askew = replace(tour[1], pose=Pose(10.0, 5.0, math.radians(1.1)))
    longer = replace(tour[1], service=1.1)
    trip = journey("a", Pose(5.0, 5.0, 0.0), 2.0, ahead(5.0), ahead(3.0))
    return {
        "visit": replace(right, tours={"a": (tour[0], off)}),
        "visit--heading": replace(right, tours={"a": (tour[0], askew)}),
        "visit--order": replace(right, tours={"a": (tour[1], tour[0])}),
        "visit--no-trajectory": replace(right, tracks={}, sum_of_costs=0.0, makespan=0.0),
        "service": replace(right, tours={"a": (tour[0], longer)}),
        "service--passing": plan([LIFTER], [trip], {"a": tour}),
        "together": hand_over(3.5),
        "together--no-partner": replace(
            right,
            tours={"a": (replace(tour[0], together=("b",)), tour[1])},
            robots=(*right.robots, Robot("b", "lifter", Pose(15.0, 8.0, 0.0))),
            assignment={"a": ("t1",), "b": ()},
        ),
        "not_before": in_turn(7.0, released=6.1),
        "after": in_turn(5.9),
        "after--nobody": alone(
            CART,
            tours={"a": (Visit("t2", Pose(5.0, 5.0, 0.0), after=("t1",)),)},
            assignment={"a": ("t2",)},
        ),
        "status": replace(right, status=Status.STOPPED),
        "assignment": replace(right, assignment={"a": ("t2",)}),
        "sum_of_costs": replace(right, sum_of_costs=right.sum_of_costs + 0.002),
        "makespan": replace(right, makespan=right.makespan - 0.002),
        "lower_bound": replace(right, lower_bound=right.sum_of_costs + 0.002),
        "cost": paper(12.7),
        "cost_lower_bound": replace(paper(12.6416), cost_lower_bound=12.7),
    }


def right_plans() -> dict[str, PlanRecord]:
    """Return the right plans by name."""
    trip = journey("a", Pose(5.0, 5.0, 0.0), ahead(5.0))
    sweep: list[Leg] = [
        ("forward", (1.0, 0.0, 0.0), 1.0),
        ("forward-left", (1.0, 0.0, 0.5), 1.0),
        ("forward-right", (1.0, 0.0, -0.5), 1.0),
        1.0,
        ("reverse", (-1.0, 0.0, 0.0), 1.0),
        ("reverse-left", (-1.0, 0.0, -0.5), 1.0),
        ("reverse-right", (-1.0, 0.0, 0.5), 1.0),
        ("lateral-left", (0.0, 1.0, 0.5), 1.0),
        ("lateral-right", (0.0, -1.0, 0.0), 1.0),
        ("rotate-left", (0.0, 0.0, 1.0), 2.0),
        ("rotate-right", (0.0, 0.0, -1.0), 2.0),
    ]
    turn = [(0.0, 5.0, 5.0, 0.0), (0.1, 5.1, 5.0, 0.0), (0.1, 5.1, 5.0, 1.5), (0.2, 5.1, 5.1, 1.5)]
    inside = Zone("dock", "closed", ((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)))
    edge = journey("a", Pose(5.0, 0.3, 0.0), ahead(5.0))
    outwards = journey("a", Pose(18.0, 5.0, 0.0), ahead(5.0))
    swift = limited(CART, acceleration=1.0, deceleration=0.5)
    meeting = journey("b", Pose(10.0, 5.0, math.pi), 6.0, ahead(4.0))
    slot = (box(4, 3, 19, 4.7), box(4, 5.3, 19, 7))
    return {
        "sliding-along-a-wall": alone(CART, ahead(9.0), site=around(box(6, 3, 9, 4.7))),
        "through-a-slot-without-play": alone(CART, ahead(9.0), site=around(*slot)),
        "along-the-bounds": plan([CART], [edge]),
        "two-bodies-in-contact": plan(
            [CART, CART], [trip, journey("b", Pose(8.0, 5.6, 0.0), ahead(2.0))]
        ),
        "disc-on-disc": plan([PUCK, PUCK], [trip, journey("b", Pose(8.0, 6.0, 0.0))]),
        "heading-jumps": replace(
            samples(PUCK, turn), robot_types={"puck": replace(PUCK, footprint=CART.footprint)}
        ),
        "open-border": plan([CART], [outwards], site=replace(FLOOR, border="open")),
        "under-what-stops-the-loaded": alone(
            LIFTER, ahead(5.0), site=around(box(7, 3, 8, 6, "lifter:loaded"))
        ),
        "wide-only-while-loaded": delivery(site=around(box(11.6, 4, 14, 4.5))),
        "all-modes": alone(CRAB, *sweep),
        "car-forwards-and-back": alone(
            CAR, (None, (3.0, 0.0, 1.5), 3.0), (None, (-3.0, 0.0, 1.5), 3.0)
        ),
        "gentle-ramps": alone(swift, *ramp(0.0, 1.0), ahead(2.0), *ramp(1.0, 0.0, 0.5)),
        "hand-over": hand_over(4.0),
        "one-after-the-other": in_turn(6.0),
        "not-before-its-time": in_turn(8.5, released=7.5),
        "paper-cost": paper(12.6416),
        "leaving-a-closed-zone": alone(CART, ahead(5.0), site=around(zones=(inside,))),
        "conflict-after-the-window": plan(
            [CART, CART],
            [trip, meeting],
            conflict_free_until=4.0,
            status=Status.STOPPED,
            reason="the window ended",
            sum_of_costs=15.0,
        ),
        "nobody-moves": plan([CART], [journey("a", Pose(5.0, 5.0, 0.0))], tracks={}),
    }


def main() -> None:
    """Write all files."""
    here = Path(__file__).parent
    for folder, plans in ((here, wrong_plans()), (here.parent / "right_plans", right_plans())):
        for name, record in plans.items():
            write_plan(record, folder / f"{name}.json")


if __name__ == "__main__":
    main()
