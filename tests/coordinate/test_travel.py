"""How far apart tasks are believed to be."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.plan.rooms import CART, DRUM, EAST, NORTH, block, room

from clearway.assign import build
from clearway.coordinate import ByDuration, Searched, bounded_seconds, by_grid
from clearway.model import Limits, Order, Pose, Robot, Scenario, Task, Visit
from clearway.plan import TeamParams

QUICK = replace(CART, name="quick", limits=replace(CART.limits, speed=2.0))


def scenario(*tasks, robots=(("r", CART),), obstacles=()):
    types = {kind.name: kind for _, kind in robots}
    return Scenario(
        "hall",
        room(20.0, 10.0, *obstacles),
        types,
        tuple(
            Robot(name, kind.name, Pose(1.5, 1.5 + 2.0 * i, EAST))
            for i, (name, kind) in enumerate(robots)
        ),
        tuple(Order(task) for task in tasks),
    )


def task(name, *poses, **more):
    return Task(name, tuple(Visit(name, Pose(*pose), **more) for pose in poses))


def constant(seconds):
    return lambda site, robot_type, drives: np.full(len(drives), seconds)


def test_the_grid_is_what_there_was():
    """Nothing is changed."""
    work = scenario(task("t", (9.5, 1.5, EAST)))
    problem = build(work)
    assert by_grid(work, problem) is problem


def test_a_second_is_worth_what_the_fastest_drives_in_it():
    """With 2 m/s, all that lasts 3 s is 6 m long, for whoever drives it; two legs are 12 m."""
    work = scenario(
        task("t", (9.5, 1.5, EAST), (9.5, 5.5, EAST), (9.5, 7.5, EAST)),
        task("u", (5.5, 5.5, EAST)),
        robots=(("slow", CART), ("quick", QUICK)),
    )
    problem = ByDuration(constant(3.0))(work, build(work))
    assert problem.speed == 2.0
    assert problem.start_to_task.tolist() == [[6.0, 6.0], [6.0, 6.0]]
    assert problem.task_to_task[:, 0, 1].tolist() == [6.0, 6.0]
    assert problem.inner.tolist() == [[12.0, 0.0], [12.0, 0.0]]


def test_what_is_not_known_stays_as_it_was():
    """A search that finds no way leaves the grid's."""
    work = scenario(task("t", (9.5, 1.5, EAST)), task("u", (5.5, 5.5, EAST)))
    problem = build(work)
    again = ByDuration(constant(math.nan))(work, problem)
    assert (again.start_to_task == problem.start_to_task).all()
    assert (again.task_to_task == problem.task_to_task).all()


def test_what_cannot_be_driven_is_not_asked_for():
    """The drum cannot reach the task behind the slit; the cart's way is the only one asked for."""
    asked = []

    def noting(site, robot_type, drives):
        asked.extend((robot_type.name, drive.goal) for drive in drives)
        return np.ones(len(drives))

    slit = (block(10.0, 0.0, 11.0, 4.6), block(10.0, 5.4, 11.0, 10.0))
    work = scenario(task("t", (15.5, 5.0, EAST)), robots=(("c", CART), ("d", DRUM)), obstacles=slit)
    problem = ByDuration(noting)(work, build(work))
    assert asked == [("cart", Pose(15.5, 5.0, EAST))]
    assert problem.start_to_task[1, 0] == math.inf


def test_a_leg_is_asked_for_once():
    """Two robots of a type that start alike, and two tasks at one place, share their legs."""
    asked = []

    def noting(site, robot_type, drives):
        asked.append(len(drives))
        return np.ones(len(drives))

    here = (9.5, 1.5, EAST)
    work = scenario(task("t", here), task("u", here))
    ByDuration(noting)(work, build(work))
    # From the start, and from the place to itself.
    assert asked == [2]


def test_curves_are_as_the_crow_flies_or_as_the_body_turns():
    """8 m ahead take 8 s; a quarter turn in 1 m takes pi/2 at 0.8 rad/s."""
    work = scenario(task("t", (9.5, 1.5, EAST)), task("u", (2.5, 1.5, NORTH)))
    problem = ByDuration(bounded_seconds)(work, build(work))
    assert problem.start_to_task[0].tolist() == pytest.approx([8.0, math.pi / 2.0 / 0.8])


def test_lone_ways_are_searched_for():
    """Straight ahead a search drives the bound; with a turn at the end it needs longer."""
    work = scenario(task("t", (9.5, 1.5, EAST)), task("u", (9.5, 1.5, NORTH)))
    planned = ByDuration(Searched(TeamParams()))(work, build(work))
    bound = ByDuration(bounded_seconds)(work, build(work))
    assert planned.start_to_task[0, 0] == pytest.approx(8.0, abs=0.01)
    assert planned.start_to_task[0, 1] > bound.start_to_task[0, 1] + 0.5


def test_a_load_goes_its_own_way():
    """What is carried between two visits cannot pass the bar, and takes the way round it."""
    bar = block(9.0, 2.5, 10.0, 10.0, "cart:loaded")
    visits = (
        Visit("t", Pose(5.0, 8.5, EAST), load="pick"),
        Visit("t", Pose(15.0, 8.5, EAST), load="drop"),
    )
    work = scenario(Task("t", visits), obstacles=(bar,))
    for durations in (bounded_seconds, Searched(TeamParams())):
        problem = ByDuration(durations)(work, build(work))
        assert problem.inner[0, 0] > 15.0
    slow = replace(CART, limits=Limits(speed=1.0, yaw_rate=0.8, turning_radius=1.0))
    free = scenario(Task("t", visits), robots=(("r", slow),))
    assert ByDuration(Searched(TeamParams()))(free, build(free)).inner[0, 0] < 10.1
