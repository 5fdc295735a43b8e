"""The sites on which four-wheel robots are tried: warehouse, yard and tight room.

The warehouse is that of Zhang et al., 100 m x 60 m with 18 shelves of 35 m x 1.5 m, in a
layout of our own where the paper gives none: two columns of nine shelves, three cross
aisles of 10 m, aisles of 4.5 m between the rows and of 5.25 m at both ends.
"""

import math
import random
from collections.abc import Callable

from clearway.model import (
    Footprint,
    Limits,
    Obstacle,
    Order,
    Polygon,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Task,
    Visit,
    Zone,
)

WIDTH, HEIGHT = 100.0, 60.0
SHELF_LENGTH, SHELF_DEPTH = 35.0, 1.5
SHELF_LEFT = (10.0, 55.0)
SHELF_ROWS = tuple(6.0 * k for k in range(1, 10))
BODY_LENGTH, BODY_WIDTH = 3.0, 2.0
HEADINGS = (0.0, math.pi / 2.0, math.pi, -math.pi / 2.0)
MOST_IN_CROSS_AISLES = 60
MOST_TRIES = 20_000

Box = tuple[float, float, float, float]


def four_wheel_carrier() -> RobotType:
    """Return the warehouse robot: 3 m x 2 m, 2.5 m/s, 0.57 rad/s, turning radius 3 m."""
    return RobotType(
        name="carrier",
        footprint=Footprint.rectangle(BODY_LENGTH, BODY_WIDTH),
        kinematics="four_wheel",
        limits=Limits(speed=2.5, yaw_rate=0.57, turning_radius=3.0),
        clearance=0.1,
    )


def warehouse_site(bays: int = 0) -> Site:
    """Return the warehouse with its first ``bays`` parking bays (at most 53).

    Along both outer walls 24 bays stand across, with 0.4 m between bodies, and leave a lane of
    6.8 m in front; in the middle cross aisle five stand along its centre line, each in line
    with a row of shelves, and leave 4 m on either side and 9 m between them. Any first few
    are spread out.

    Raises
    ------
    ValueError
        If there are not so many bays.
    """
    poses = _bay_poses()
    if not 0 <= bays <= len(poses):
        raise ValueError(f"the warehouse has 0 to {len(poses)} parking bays, not {bays}")
    zones = tuple(
        Zone(f"bay-{i + 1}", "parking", _corners(body_box(pose)), pose)
        for i, pose in enumerate(poses[:bays])
    )
    shelves = tuple(
        Obstacle(
            polygon=_corners((x, y - SHELF_DEPTH / 2.0, x + SHELF_LENGTH, y + SHELF_DEPTH / 2.0))
        )
        for x in SHELF_LEFT
        for y in SHELF_ROWS
    )
    return Site(_corners((0.0, 0.0, WIDTH, HEIGHT)), shelves, zones)


def random_warehouse(
    robots: int, tasks: int, seed: int, service: float = 5.0, bays: int | None = None
) -> Scenario:
    """Return robots in the cross aisles and tasks between the shelves.

    Bodies at tasks are at least 0.3 m apart and 0.1 m from shelves, so that any two can be
    visited at once; bodies at starts are 0.5 m apart and clear of bays and tasks.
    More than 60 robots start along the outer walls of the end aisles too, where 2.75 m remain.

    Parameters
    ----------
    service
        Time at each task (s).
    bays
        Number of parking bays; absent: one per robot, 53 at most. Fewer leave room for more
        robots to start.

    Raises
    ------
    ValueError
        If the robots or tasks do not fit.
    """
    rng = random.Random(seed)
    site = warehouse_site(min(robots, len(_bay_poses())) if bays is None else bays)
    occupied = [body_box(zone.pose) for zone in site.zones if zone.pose is not None]
    places = _scatter(tasks, "tasks", lambda: _task_pose(rng), 0.3, [])
    occupied += [body_box(pose) for pose in places]
    starts = _scatter(
        robots, "robots", lambda: _start_pose(rng, robots > MOST_IN_CROSS_AISLES), 0.5, occupied
    )
    return Scenario(
        name=f"warehouse-{robots}x{tasks}",
        site=site,
        robot_types={"carrier": four_wheel_carrier()},
        robots=tuple(Robot(f"r{i + 1}", "carrier", pose) for i, pose in enumerate(starts)),
        orders=tuple(_order(f"t{i + 1}", pose, service) for i, pose in enumerate(places)),
        seed=seed,
    )


def random_yard(robots: int, seed: int) -> Scenario:
    """Return an open yard of 80 m x 80 m where each robot has a goal of its own.

    About twenty discs, four blocks and three walls stand at least 5 m apart and 4 m from the
    border, more than a body's diagonal of 3.6 m; starts are 6 m apart, and so are goals, and all
    can be turned on the spot. So a single robot can always go round everything.

    Raises
    ------
    ValueError
        If the robots do not fit.
    """
    rng = random.Random(seed)
    side, diagonal = 80.0, math.hypot(BODY_LENGTH, BODY_WIDTH) / 2.0
    discs: list[tuple[float, float, float]] = []
    for i in range(27):
        # Blocks and walls are drawn inside the last seven discs.
        low, high = (0.8, 2.0) if i < 20 else (2.5, 4.0)
        for _ in range(MOST_TRIES):
            r = round(rng.uniform(low, high), 2)
            x, y = (round(rng.uniform(4.0 + r, side - 4.0 - r), 2) for _ in range(2))
            if all(math.dist((x, y), other[:2]) >= r + other[2] + 5.0 for other in discs):
                discs.append((x, y, r))
                break
    obstacles = [Obstacle(disc=disc) for disc in discs[:20]]
    obstacles += [_block_or_wall(disc, rng, i < 4) for i, disc in enumerate(discs[20:])]

    def place(what: str) -> list[Pose]:
        found: list[Pose] = []
        for _ in range(MOST_TRIES):
            if len(found) == robots:
                break
            x, y = (round(rng.uniform(diagonal + 0.3, side - diagonal - 0.3), 2) for _ in range(2))
            apart = all(math.dist((x, y), pose[:2]) >= 6.0 for pose in found)
            if apart and all(math.dist((x, y), d[:2]) >= d[2] + diagonal + 0.3 for d in discs):
                found.append(Pose(x, y, round(rng.uniform(-3.14, 3.14), 2)))
        if len(found) < robots:
            raise ValueError(f"only {len(found)} of {robots} {what} fit into the yard; take fewer")
        return found

    starts, goals = place("starts"), place("goals")
    return Scenario(
        name=f"yard-{robots}",
        site=Site(_corners((0.0, 0.0, side, side)), tuple(obstacles)),
        robot_types={"carrier": four_wheel_carrier()},
        robots=tuple(Robot(f"r{i + 1}", "carrier", pose) for i, pose in enumerate(starts)),
        orders=tuple(_order(f"t{i + 1}", pose, 0.0, f"r{i + 1}") for i, pose in enumerate(goals)),
        seed=seed,
    )


def tight_room() -> Scenario:
    """Return four robots of which two must leave a dead end before the others may enter.

    The corridor is 24 m long and 3.2 m wide, closed at x = 0, with a side pocket of 4.5 m x
    3.2 m; it opens into a hall of 12 m x 12 m. Two robots stand at the dead end, nose to tail,
    and leave for the hall; two stand in the hall, in the way, and have their goals at the dead
    end. A way: r2 to (33.8, -1.5), r1 to (33.8, 5.5), then r3 to the very end and r4 behind
    it, each in turn, straight and sideways.
    """
    bounds: Polygon = (
        (0.0, 0.0),
        (24.0, 0.0),
        (24.0, -4.0),
        (36.0, -4.0),
        (36.0, 8.0),
        (24.0, 8.0),
        (24.0, 3.2),
        (18.5, 3.2),
        (18.5, 6.4),
        (14.0, 6.4),
        (14.0, 3.2),
        (0.0, 3.2),
    )
    starts = (
        Pose(1.8, 1.6, 0.0),
        Pose(5.4, 1.6, 0.0),
        Pose(30.0, 5.5, 0.0),
        Pose(30.0, -1.5, 0.0),
    )
    goals = (
        Pose(33.8, 5.5, 0.0),
        Pose(33.8, -1.5, 0.0),
        Pose(1.8, 1.6, 0.0),
        Pose(5.4, 1.6, 0.0),
    )
    return Scenario(
        name="tight-room",
        site=Site(bounds),
        robot_types={"carrier": four_wheel_carrier()},
        robots=tuple(Robot(f"r{i + 1}", "carrier", pose) for i, pose in enumerate(starts)),
        orders=tuple(_order(f"t{i + 1}", pose, 2.0, f"r{i + 1}") for i, pose in enumerate(goals)),
    )


def _order(name: str, pose: Pose, service: float, robot: str | None = None) -> Order:
    return Order(Task(name, (Visit(name, pose, service),), robot))


def body_box(pose: Pose) -> Box:
    """Return the box of a carrier whose heading is a whole number of quarter turns."""
    along = abs(math.cos(pose.theta)) > 0.5
    length, width = (BODY_LENGTH, BODY_WIDTH) if along else (BODY_WIDTH, BODY_LENGTH)
    x, y = length / 2.0, width / 2.0
    return (pose.x - x, pose.y - y, pose.x + x, pose.y + y)


def _corners(box: Box) -> Polygon:
    x0, y0, x1, y1 = (round(value, 9) for value in box)
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def gap_between(a: Box, b: Box) -> float:
    """Return the least distance of two boxes (m); 0 where they meet."""
    x = max(a[0] - b[2], b[0] - a[2], 0.0)
    y = max(a[1] - b[3], b[1] - a[3], 0.0)
    return math.hypot(x, y)


def _bay_poses() -> list[Pose]:
    """List the bays: one at the lower left, then always the one farthest from those before."""
    rows = [round(2.4 * (j + 1), 9) for j in range(24)]
    rest = [Pose(1.7, y, 0.0) for y in rows] + [Pose(WIDTH - 1.7, y, math.pi) for y in rows]
    rest += [Pose(50.0, y, math.pi / 2.0) for y in SHELF_ROWS[::2]]
    ordered = [rest.pop(0)]
    while rest:
        farthest = max(rest, key=lambda pose: min(pose.distance(other) for other in ordered))
        rest.remove(farthest)
        ordered.append(farthest)
    return ordered


def _task_pose(rng: random.Random) -> Pose:
    """Draw a cell's middle between the shelves, at least 1.5 m from the cross aisles' edges."""
    left = rng.choice(SHELF_LEFT)
    theta = rng.choice(HEADINGS)
    x = left + rng.randrange(2, int(SHELF_LENGTH) - 2) + 0.5
    aisle = rng.randrange(len(SHELF_ROWS) + 1)
    if 0 < aisle < len(SHELF_ROWS):
        return Pose(x, 6.0 * aisle + rng.choice((2.5, 3.5)), theta)
    from_wall = rng.choice((1.5, 2.5, 3.5) if math.cos(theta) ** 2 > 0.5 else (2.5, 3.5))
    return Pose(x, from_wall if aisle == 0 else HEIGHT - from_wall, theta)


def _start_pose(rng: random.Random, also_end_aisles: bool) -> Pose:
    """Draw a cell's middle in a cross aisle, or along the outer wall of an end aisle."""
    if also_end_aisles and rng.random() < 0.4:
        x = rng.randrange(12, int(WIDTH) - 12) + 0.5
        return Pose(x, rng.choice((1.5, HEIGHT - 1.5)), rng.choice((0.0, math.pi)))
    left = rng.choice((0, 45, 90))
    x, y = left + rng.randrange(2, 8) + 0.5, rng.randrange(2, int(HEIGHT) - 2) + 0.5
    return Pose(x, y, rng.choice(HEADINGS))


def _scatter(
    count: int, what: str, draw: Callable[[], Pose], gap: float, occupied: list[Box]
) -> list[Pose]:
    """Draw poses until ``count`` of them are ``gap`` apart from each other and the occupied."""
    boxes, poses = list(occupied), list[Pose]()
    for _ in range(MOST_TRIES):
        if len(poses) == count:
            return poses
        pose = draw()
        if all(gap_between(body_box(pose), other) >= gap - 1e-9 for other in boxes):
            boxes.append(body_box(pose))
            poses.append(pose)
    if len(poses) == count:
        return poses
    raise ValueError(f"only {len(poses)} of {count} {what} fit into the warehouse; take fewer")


def _block_or_wall(
    disc: tuple[float, float, float], rng: random.Random, is_block: bool
) -> Obstacle:
    x, y, r = disc
    turn = rng.uniform(-math.pi, math.pi)
    corners = [
        (round(x + r * math.cos(turn + a), 2), round(y + r * math.sin(turn + a), 2))
        for a in ((0.4, 2.2, 3.6, 5.0) if is_block else (0.0, math.pi))
    ]
    return Obstacle(polygon=tuple(corners)) if is_block else Obstacle(wall=(corners[0], corners[1]))
