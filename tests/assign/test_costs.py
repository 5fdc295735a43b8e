"""What a scenario's tasks cost its robots."""

import math
from dataclasses import replace

import numpy as np
import pytest

from clearway.assign import build, tours_of
from clearway.assign.costs import half_width
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
)
from clearway.protocols import Weights, objective

HALL = ((0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0))
# A wall of boxes from the lower side up, with a gap of 1.8 m below the upper side.
BARRIER = Obstacle(polygon=((5.0, 0.0), (6.0, 0.0), (6.0, 6.2), (5.0, 6.2)))


def kind(name, width, **more):
    return RobotType(
        name, Footprint.rectangle(2.0 * width, width), "differential", Limits(speed=1.0), **more
    )


def point_task(name, x, y, theta=0.0, robot=None, **more):
    return Task(name, (Visit(name, Pose(x, y, theta), **more),), robot)


def scenario(tasks, robots=None, types=None, obstacles=(BARRIER,)):
    types = types or [kind("slim", 1.0), kind("broad", 3.0)]
    robots = robots or [
        Robot("a", "slim", Pose(2.5, 2.5, 0.0)),
        Robot("b", "broad", Pose(2.5, 4.5, math.pi)),
    ]
    return Scenario(
        name="hall",
        site=Site(HALL, obstacles),
        robot_types={each.name: each for each in types},
        robots=tuple(robots),
        orders=tuple(Order(task) for task in tasks),
    )


def test_each_robot_pays_its_own_way():
    """The slim robot climbs to y = 7.5, over the barrier and down; the broad one cannot pass."""
    problem = build(scenario([point_task("t", 9.5, 2.5), point_task("u", 3.5, 5.5)]))
    assert problem.robots == ("a", "b")
    assert problem.tasks == ("t", "u")
    # a: 5 up, 7 across, 5 down; and 1 across, 3 up. b: 1 across, 1 up. Between: 5 + 6 + 2.
    assert problem.start_to_task.tolist() == [[17.0, 4.0], [math.inf, 2.0]]
    assert problem.allowed.tolist() == [[True, True], [False, True]]
    assert problem.task_to_task[0].tolist() == [[0.0, 13.0], [13.0, 0.0]]
    assert problem.task_to_task[1, 0, 1] == math.inf


@pytest.mark.parametrize("low", [1.0, 1.2, 1.37, 1.5, 1.9])
def test_a_passage_as_wide_as_the_body_is_a_way(low):
    """However 1 m cells fall on a passage of 3.02 m, a body of 3 m finds it, and none of 2.7 m."""
    ends = point_task("t", 9.5, 4.0), [Robot("b", "broad", Pose(2.5, 4.0, 0.0))]

    def walls(gap):
        return tuple(
            Obstacle(polygon=((5.0, y), (8.0, y), (8.0, top), (5.0, top)))
            for y, top in ((0.0, low), (low + gap, 8.0))
        )

    problem = build(scenario([ends[0]], ends[1], obstacles=walls(3.02)))
    assert 7.0 <= problem.start_to_task[0, 0] <= 11.0
    with pytest.raises(ValueError, match=r"no way from its start to \(9.5, 4\)"):
        build(scenario([ends[0]], ends[1], obstacles=walls(2.7)))


def test_turns_are_wrapped():
    """From pi to -pi/2 is a quarter turn, from 0 to pi half a one."""
    tasks = [point_task("t", 2.5, 6.5, math.pi), point_task("u", 3.5, 5.5, -math.pi / 2.0)]
    problem = build(scenario(tasks))
    np.testing.assert_allclose(problem.start_turn, [[math.pi, math.pi / 2.0], [0.0, math.pi / 2.0]])
    np.testing.assert_allclose(problem.task_turn[0], [0.0, math.pi / 2.0])


def test_all_headings_may_turn_together():
    """Turning every start and task by the same angle leaves all turning costs as they are."""
    angles = (0.3, -2.0, 3.0)

    def turned(by):
        tasks = [point_task(f"t{i}", 2.5 + i, 6.5, a + by) for i, a in enumerate(angles)]
        robots = [Robot("a", "slim", Pose(2.5, 2.5, 1.0 + by))]
        return build(scenario(tasks, robots))

    routes = [(2, 0, 1)]
    assert objective(turned(0.0), routes).value == pytest.approx(
        objective(turned(2.5), routes).value
    )


def test_a_task_of_two_visits_is_left_at_its_last():
    """Pick at (1.5, 6.5), drop at (4.5, 6.5): 3 m inside, and the next leg starts at the drop."""
    carry = Task(
        "c",
        (
            Visit("c", Pose(1.5, 6.5, 0.0), load="pick"),
            Visit("c", Pose(4.5, 6.5, 1.0), load="drop"),
        ),
    )
    problem = build(
        scenario([carry, point_task("t", 4.5, 4.5)], [Robot("a", "slim", Pose(1.5, 4.5, 0.0))])
    )
    assert problem.inner.tolist() == [[3.0, 0.0]]
    assert problem.start_to_task.tolist() == [[2.0, 3.0]]
    assert problem.task_to_task[0, 0, 1] == 2.0
    assert problem.task_to_task[0, 1, 0] == 5.0
    assert problem.task_turn[0, 1] == 1.0
    assert objective(problem, [(0, 1)]).max_distance == 2.0 + 3.0 + 2.0


def test_a_loaded_robot_goes_where_loaded_ones_may():
    """Under a shelf that stops loads, an empty robot passes and a loaded one goes round."""
    shelf = Obstacle(
        polygon=((5.0, 0.0), (6.0, 0.0), (6.0, 6.2), (5.0, 6.2)), blocks=("slim:loaded",)
    )
    ends = Pose(3.5, 2.5, 0.0), Pose(7.5, 2.5, 0.0)
    carry = Task("c", (Visit("c", ends[0], load="pick"), Visit("c", ends[1], load="drop")))
    look = Task("l", (Visit("l", ends[0]), Visit("l", ends[1])))
    robots = [Robot("a", "slim", Pose(2.5, 2.5, 0.0))]
    assert build(scenario([carry, look], robots, obstacles=(shelf,))).inner.tolist() == [
        [14.0, 4.0]
    ]


def test_a_robot_left_with_its_load_goes_on_with_it():
    """After a task that ends with a pick, the next way leads round what stops loads."""
    shelf = Obstacle(
        polygon=((5.0, 0.0), (6.0, 0.0), (6.0, 6.2), (5.0, 6.2)), blocks=("slim:loaded",)
    )
    fetch = point_task("f", 3.5, 2.5, load="pick")
    leave = point_task("l", 7.5, 2.5, load="drop")
    robots = [Robot("a", "slim", Pose(2.5, 2.5, 0.0))]
    problem = build(scenario([fetch, leave], robots, obstacles=(shelf,)))
    assert problem.task_to_task[0, 0, 1] == 14.0
    assert problem.task_to_task[0, 1, 0] == 4.0


def test_robots_may_do_what_they_can():
    """A kept task is for its robot, a capability for who has it, a load for who can carry."""
    types = [
        kind("slim", 1.0, capabilities=frozenset({"grip"})),
        kind("mule", 1.0, capacity=2),
        kind("sled", 1.0, capacity=0),
    ]
    robots = [Robot(f"{t.name}1", t.name, Pose(1.5 + i, 2.5, 0.0)) for i, t in enumerate(types)]
    twice = tuple(Visit("two", Pose(x, 4.5, 0.0), load="pick") for x in (1.5, 2.5))
    tasks = [
        point_task("kept", 2.5, 5.5, robot="mule1"),
        point_task("grip", 2.5, 6.5, needs="grip"),
        point_task("one", 3.5, 6.5, load="pick"),
        Task("two", twice),
    ]
    assert build(scenario(tasks, robots, types)).allowed.T.tolist() == [
        [False, True, False],
        [True, False, False],
        [True, True, False],
        [False, True, False],
    ]


def test_a_task_for_nobody_is_an_error_that_says_why():
    """The message names the task and what keeps each robot from it."""
    tasks = [point_task("far", 9.5, 2.5, needs="wings")]
    winged = kind("broad", 3.0, capabilities=frozenset({"wings"}))
    with pytest.raises(ValueError) as told:
        build(scenario(tasks, types=[kind("slim", 1.0), winged]))
    assert str(told.value) == (
        "no robot can do task far: a has not the capability wings; "
        "b finds no way from its start to (9.5, 2.5)"
    )


def test_no_orders_no_tasks():
    """A scenario without orders is a problem without tasks, with the weights given."""
    problem = build(scenario([]), Weights(1.0, 2.0, 3.0))
    assert problem.start_to_task.shape == (2, 0)
    assert problem.weights == Weights(1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("footprint", "half"),
    [
        (Footprint.rectangle(3.0, 2.0), 1.0),
        (Footprint.rectangle(1.0, 2.4, rear=0.2), 0.5),
        (Footprint(radius=0.7), 0.7),
        (
            Footprint(
                parts=(
                    ((0.0, -0.4), (2.0, -0.4), (2.0, 0.4), (0.0, 0.4)),
                    ((-1.0, -0.6), (0.0, -0.6), (0.0, 0.6), (-1.0, 0.6)),
                )
            ),
            0.6,
        ),
    ],
)
def test_half_the_lesser_extent_is_the_half_width(footprint, half):
    """Of a rectangle, a disc and a body of two parts."""
    assert half_width(footprint) == pytest.approx(half)


def test_routes_become_visits_in_order():
    """Robot a does the carrying task, both visits, after the point task; b stays idle."""
    carry = Task("c", (Visit("c", Pose(1.5, 6.5, 0.0)), Visit("c", Pose(4.5, 6.5, 1.0))))
    work = scenario([carry, point_task("t", 4.5, 4.5)])
    tours = tours_of(work, ((1, 0), ()))
    assert [visit.task for visit in tours["a"]] == ["t", "c", "c"]
    assert tours["b"] == ()


def test_times_are_those_of_the_orders():
    """Services add up over a task's visits; due times and what waits for what come along."""
    twice = (Visit("t", Pose(1.5, 6.5, 0.0), 2.0), Visit("t", Pose(4.5, 6.5, 0.0), 3.0))
    work = scenario([])
    orders = (
        Order(Task("t", twice), due=40.0),
        Order(point_task("u", 3.5, 5.5), after=("t",)),
    )
    problem = build(replace(work, orders=orders))
    assert problem.service.tolist() == [5.0, 0.0]
    assert problem.due.tolist() == [40.0, math.inf]
    assert problem.before == ((0, 1),)


def test_a_robot_of_half_the_speed_has_ways_of_twice_the_length():
    """4 m at 1 m/s take as long as 8 m at 2 m/s, the speed of the fastest in use."""
    slow = kind("slim", 1.0)
    fast = replace(slow, name="fast", limits=Limits(speed=2.0))
    unused = replace(slow, name="unused", limits=Limits(speed=9.0))
    robots = [Robot(n, n, Pose(2.5, 2.5, 0.0)) for n in ("slim", "fast")]
    tasks = [point_task("t", 2.5, 6.5), point_task("u", 4.5, 6.5)]
    problem = build(scenario(tasks, robots, [slow, fast, unused]))
    assert problem.speed == 2.0
    assert problem.start_to_task.tolist() == [[8.0, 12.0], [4.0, 6.0]]
    assert problem.task_to_task[:, 0, 1].tolist() == [4.0, 2.0]


def test_two_tasks_between_which_nobody_can_drive_are_named():
    """With the load of ``fetch`` on board, no way leads under the shelf to ``look``."""
    shelf = Obstacle(polygon=((5.0, 0.0), (6.0, 0.0), (6.0, 8.0), (5.0, 8.0)), blocks=("a:loaded",))
    tasks = [point_task("fetch", 3.5, 2.5, load="pick"), point_task("look", 7.5, 2.5)]
    robots = [Robot("a", "a", Pose(2.5, 2.5, 0.0))]
    with pytest.raises(ValueError, match="from task fetch to task look"):
        build(scenario(tasks, robots, [kind("a", 1.0)], obstacles=(shelf,)))


def test_tasks_for_different_robots_need_no_way_between_them():
    """Each robot has a side of the wall and a task there."""
    wall = Obstacle(polygon=((5.0, 0.0), (6.0, 0.0), (6.0, 8.0), (5.0, 8.0)))
    robots = [Robot("a", "slim", Pose(2.5, 2.5, 0.0)), Robot("b", "slim", Pose(9.5, 2.5, 0.0))]
    tasks = [point_task("t", 2.5, 5.5), point_task("u", 9.5, 5.5)]
    problem = build(scenario(tasks, robots, obstacles=(wall,)))
    assert problem.allowed.tolist() == [[True, False], [False, True]]
