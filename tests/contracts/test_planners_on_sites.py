"""The exam that every planner sits: obstacles, loads, shapes, and sites without a way."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from tests.plan.rooms import (
    CAR,
    CARRIER,
    CART,
    DRUM,
    EAST,
    FLOAT,
    HOOK,
    NORTH,
    PIVOT,
    SOUTH,
    STACKER,
    TRAIN,
    TUG,
    WEST,
    block,
    judged,
    room,
    swapping_corridor,
    team,
    to,
)

from clearway.model import (
    Footprint,
    Obstacle,
    Site,
    Status,
)
from clearway.protocols import Budget


def wall(x0, y0, x1, y1):
    return Obstacle(wall=((x0, y0), (x1, y1)))


# Obstacles, loads and shapes


def test_starts_may_touch_walls_and_each_other(solve):
    """Contact is no overlap: in a corner, side to side, nose to an obstacle."""
    solve(
        team(
            room(8.0, 4.0, block(3.0, 0.0, 4.0, 0.6)),
            (CART, (0.5, 0.3, EAST), to(7.0, 3.4)),
            (CART, (0.5, 0.9, EAST), to(7.0, 2.4)),
            (CART, (2.5, 0.3, EAST), to(5.0, 0.6)),
        )
    )


@pytest.mark.parametrize(
    "obstacle",
    [
        Obstacle(disc=(5.0, 2.0, 1.0)),
        wall(5.0, 1.0, 5.0, 3.0),
        block(4.5, 1.0, 5.5, 3.0),
        Obstacle(polygon=((5.0, 1.0), (6.0, 2.0), (5.0, 3.0), (4.0, 2.0))),
    ],
    ids=["disc", "wall", "block", "diamond"],
)
@pytest.mark.parametrize(
    "robot_type",
    [CART, DRUM, HOOK, CAR, STACKER, PIVOT, TUG, FLOAT],
    ids=lambda kind: kind.name,
)
def test_obstacles_are_gone_round(solve, robot_type, obstacle):
    """It lies across the straight line from start to goal."""
    plan = solve(team(room(10.0, 5.5, obstacle), (robot_type, (1.5, 2.0, EAST), to(8.5, 2.0))))
    assert plan.trajectories["a"].distance > 7.0


def test_a_non_convex_obstacle_is_entered_by_its_mouth(solve):
    """The goal lies inside a U that opens to the north; the start is south of it."""
    cup = Obstacle(
        polygon=((3, 3), (7, 3), (7, 7), (6.6, 7), (6.6, 3.4), (3.4, 3.4), (3.4, 7), (3, 7))
    )
    plan = solve(team(room(10.0, 10.0, cup), (CART, (5.0, 1.0, EAST), to(5.0, 4.2, NORTH))))
    assert plan.trajectories["a"].distance > 7.0


def test_a_non_convex_site_is_not_left(solve):
    """Round the inner corner of an L."""
    site = Site(((0, 0), (10, 0), (10, 4), (4, 4), (4, 10), (0, 10)))
    plan = solve(team(site, (CARRIER, (2.0, 8.0, SOUTH), to(8.0, 2.0))))
    assert plan.trajectories["a"].distance > math.hypot(6.0, 6.0)


def test_beyond_an_open_border_there_is_room(solve):
    """A wall from border to border is gone round outside of it."""
    site = room(10.0, 4.0, wall(5.0, 0.0, 5.0, 4.0), border="open")
    solve(team(site, (CART, (2.0, 2.0, EAST), to(8.0, 2.0))))


@pytest.mark.parametrize("robot_type", [CART, CAR, DRUM, TUG, FLOAT], ids=lambda kind: kind.name)
def test_small_robots_wind_through_narrow_bends(solve, robot_type):
    """Corridors of 1.2 m, two turns about, and a body of 0.6 m x 1 m or a disc of 1 m."""
    bends = room(10.0, 6.0, block(0.0, 1.2, 8.0, 2.2), block(2.0, 3.4, 10.0, 4.4))
    solve(team(bends, (robot_type, (1.0, 0.6, EAST), to(9.0, 5.2))))


@pytest.mark.parametrize("x", [3.0, 7.3, 19.0])
def test_what_goes_straight_gets_straight_ahead(solve, x):
    """A robot that can only drive ahead and back reaches what lies ahead of it."""
    solve(team(room(20.0, 4.0), (TRAIN, (2.0, 2.0, EAST), to(x, 2.0))))


def loading(loaded_footprint):
    return replace(CART, name="loader", loaded_footprint=loaded_footprint)


def doors(*beams):
    """A wall across a room, with a door of 1 m at the south and one of 3 m at the north."""
    return room(12.0, 8.0, block(5.5, 1.0, 6.5, 5.0), *beams)


def test_a_wide_load_takes_the_wide_door(solve):
    """Empty through the narrow door at hand, loaded round by the wide one, empty back again."""
    loader = loading(Footprint.rectangle(1.2, 1.6))
    visits = (to(9.0, 1.2, load="pick"), to(2.0, 2.0, load="drop"), to(9.0, 0.6))
    plan = solve(team(doors(), (loader, (2.0, 0.5, EAST), *visits)))
    crossings = [piece for piece in plan.trajectories["a"].pieces if 5.0 < piece.at(0.5).x < 7.0]
    assert {piece.loaded for piece in crossings} == {False, True}
    assert all(piece.at(0.5).y > 5.0 for piece in crossings if piece.loaded)
    assert all(piece.at(0.5).y < 1.0 for piece in crossings if not piece.loaded)


def test_what_stops_only_the_loaded_is_passed_under(solve):
    """A beam across the narrow door: under it when empty, round it with a load."""
    loader = loading(None)
    visits = (to(9.0, 1.2, load="pick"), to(2.0, 2.0, load="drop"))
    site = doors(block(5.5, 0.0, 6.5, 1.0, "loader:loaded"))
    plan = solve(team(site, (loader, (2.0, 0.5, EAST), *visits)))
    crossings = [piece for piece in plan.trajectories["a"].pieces if 5.0 < piece.at(0.5).x < 7.0]
    assert all(piece.at(0.5).y > 5.0 for piece in crossings if piece.loaded)
    assert any(piece.at(0.5).y < 1.0 for piece in crossings if not piece.loaded)


def test_what_stops_one_type_lets_another_pass(solve):
    """A low beam right across the room stops carts; drums go under it."""
    beam = block(4.5, 0.0, 5.5, 5.0, "cart")
    solve(
        team(
            room(10.0, 5.0, beam),
            (DRUM, (2.0, 2.0, EAST), to(8.0, 2.0)),
            (CART, (2.0, 4.0, EAST), to(3.5, 4.0)),
        )
    )


def test_a_load_taken_at_the_last_visit_is_carried_for_ever(solve):
    """The body that rests is the loaded one: it needs 2.4 m across, and others keep off it."""
    loader = loading(Footprint.rectangle(1.0, 2.4))
    solve(
        team(
            room(20.0, 6.0),
            (loader, (2.0, 3.0, EAST), to(10.0, 3.0, load="pick")),
            (CART, (1.0, 4.0, EAST), to(18.0, 4.0)),
        )
    )


def test_while_a_robot_stands_with_its_load_others_keep_off(solve):
    """It picks up something wide in a lane, and the other one has to pass before or round it."""
    loader = loading(Footprint.rectangle(1.0, 3.0))
    visits = (to(6.0, 3.0, service=1.0, load="pick"), to(11.0, 3.0, service=1.0, load="drop"))
    solve(
        team(
            room(14.0, 6.0),
            (loader, (2.0, 3.0, EAST), *visits),
            (CART, (13.0, 4.2, EAST), to(1.0, 4.2)),
        )
    )


def test_a_change_of_mode_takes_its_time(solve):
    """Between two unlike ways of moving, at least 0.7 s pass at rest."""
    stiff = replace(CART, mode_switch=0.7)
    plan = solve(team(room(10.0, 6.0), (stiff, (1.0, 1.0, EAST), to(8.0, 4.5, NORTH))))
    trajectory = plan.trajectories["a"]
    timed = list(zip(trajectory.pieces, trajectory.timing, strict=True))
    changes = [
        later[1][0] - earlier[1][1]
        for earlier, later in pairwise(timed)
        if earlier[0].mode != later[0].mode
    ]
    assert changes
    assert min(changes) >= 700


def test_a_robot_drives_only_in_its_own_modes(solve):
    """What drives like a car neither turns on the spot nor moves sideways."""
    plan = solve(team(room(12.0, 8.0), (CAR, (2.0, 2.0, EAST), to(3.0, 6.0, WEST))))
    assert {piece.mode for piece in plan.trajectories["a"].pieces} <= set(CAR.modes)


# When there is no plan


def cell():
    """A room of 20 m x 10 m whose north-eastern corner is walled off."""
    return room(20.0, 10.0, wall(15.0, 6.0, 20.0, 6.0), wall(15.0, 6.0, 15.0, 10.0))


@pytest.mark.parametrize(
    ("start", "goal"), [((3.0, 3.0), (17.5, 8.0)), ((17.5, 8.0), (3.0, 3.0))], ids=["out", "in"]
)
def test_a_robot_walled_in_is_reported_as_infeasible(planner, start, goal):
    """Walls keep even the disc inside its body from the goal, and that is a proof."""
    problem = team(
        cell(), (CARRIER, (*start, EAST), to(*goal)), (CART, (8.0, 2.0, EAST), to(10.0, 8.0))
    )
    plan = planner(problem, Budget(expansions=200_000), 0)
    assert plan.status is Status.INFEASIBLE
    assert plan.concerned == ("a",)
    assert "a" in plan.reason
    assert judged(problem, plan) == []
    assert plan.counters["expansions"] < 20_000


def test_what_only_the_lattice_excludes_is_stopped_and_not_infeasible(planner):
    """There is room for the disc inside its body, but this robot only goes straight."""
    problem = team(room(20.0, 10.0), (TRAIN, (2.0, 5.0, EAST), to(10.0, 7.0)))
    plan = planner(problem, Budget(expansions=60_000), 0)
    assert plan.status is Status.STOPPED
    assert "lattice" in plan.reason
    assert plan.concerned == ("a",)
    assert judged(problem, plan) == []


def test_robots_that_block_each_other_are_not_called_infeasible(planner):
    """Nobody can swap in a corridor of one lane, but each alone could go: it is a stop."""
    problem = swapping_corridor()
    plan = planner(problem, Budget(expansions=5_000), 0)
    assert plan.status is Status.STOPPED
    assert plan.reason
    assert set(plan.concerned) <= {"a", "b"}
    assert plan.concerned
    assert judged(problem, plan) == []


def test_who_stands_in_the_way_for_ever_stops_the_others(planner):
    """A robot without a tour fills the corridor; nothing is proven of the site, so it is a stop."""
    problem = team(
        room(12.0, 1.0), (CART, (1.0, 0.5, EAST), to(11.0, 0.5)), (CART, (6.0, 0.5, EAST))
    )
    plan = planner(problem, Budget(expansions=3_000), 0)
    assert plan.status is Status.STOPPED
    assert plan.concerned == ("a",)
    assert judged(problem, plan) == []
