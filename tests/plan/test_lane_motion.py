"""Timed routes as trajectories and back."""

import math

import pytest
from tests.plan.lane_traffic import LAYOUTS, Traffic

from clearway import _core
from clearway.model import Layout, Piece, Pose, Stop, Trajectory
from clearway.plan.lane_motion import paused, split, stays_of, timed, trajectory_of
from clearway.world.channels import lane_grid

GRID = lane_grid(Layout("bidirectional"))
WIDTH = GRID.size[0]


def told(stays):
    return [(s.cell, s.arrive, s.depart, s.turn_begin, s.turn_end) for s in stays]


def corner(quarter):
    """East for three cells, north for two, from rest at second 5; a turn of ``quarter`` ticks."""
    cells = [(3, 8), (4, 8), (5, 8), (6, 8), (6, 9), (6, 10)]
    indices = [y * WIDTH + x for x, y in cells]
    turns = [quarter * k for k in (0, 1, 2, 1)]
    stays = timed(indices, WIDTH, 5000, 1000, turns, quarter)
    goal = GRID.centre((6, 10), math.pi / 2.0)
    stop = Stop(0, stays[-1].arrive, stays[-1].arrive)
    return stays, trajectory_of(GRID, "r", GRID.centre((3, 8)), stays, goal, (stop,))


def test_straight_runs_are_one_piece_each():
    """Two runs; a turn that takes no time is a heading that jumps between them."""
    _, path = corner(0)
    assert [piece.twist for piece in path.pieces] == [(3.0, 0.0, 0.0), (2.0, 0.0, 0.0)]
    assert path.timing == ((5000, 8000), (8000, 10000))
    assert path.pieces[1].start == Pose(6.5, 8.5, math.pi / 2.0)


def test_turns_that_take_time_are_pieces():
    """A quarter turn of a second on the spot, between the runs."""
    _, path = corner(1000)
    assert path.timing == ((5000, 8000), (8000, 9000), (9000, 11000))
    assert path.pieces[1].twist == pytest.approx((0.0, 0.0, math.pi / 2.0))


def test_a_pause_splits_a_run_and_delays_what_comes_after():
    """Standing for 4 s in the middle of (5, 8), which it reaches at 7 s."""
    _, path = corner(0)
    later = paused(path, 7000, 4000)
    assert later.timing == ((5000, 7000), (11000, 12000), (12000, 14000))
    assert later.at(9000) == Pose(5.5, 8.5, 0.0)
    assert later.stops[0].arrive == 14000
    assert [piece.id for piece in later.pieces] == [0, 1, 2]


def test_a_robot_between_two_cells_holds_both():
    """Cut half-way from (4, 8) to (5, 8): the one behind is left, the one ahead not yet reached."""
    _, path = corner(0)
    path = split(path, 6500)
    rest = type(path)("r", path.pieces[1].start, path.pieces[1:], path.timing[1:])
    stays = stays_of(GRID, rest)
    assert told(stays)[:2] == [
        (8 * WIDTH + 4, 0, 0, 0, 0),
        (8 * WIDTH + 5, 7000, 7000, 7000, 7000),
    ]


@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_trajectories_tell_the_holds_they_were_made_of(rule, turn_seconds):
    """For random trips by rules, waits of others included."""
    traffic = Traffic(Layout(rule), 30, turn_seconds, seed=5)
    traffic.run(100)
    planner = traffic.planner
    for number, robot in enumerate(traffic.robots):
        route = planner._holds.route(number)
        found = stays_of(traffic.grid, planner.commitment(robot.id).trajectory)
        assert [(s.cell, s.depart) for s in found] == [(s.cell, s.depart) for s in route]
        assert [s.arrive for s in found[1:]] == [s.arrive for s in route[1:]]
        turns = [(s.turn_begin, s.turn_end) for s in route if s.turn_end > s.turn_begin]
        assert turns == [(s.turn_begin, s.turn_end) for s in found if s.turn_end > s.turn_begin]
    assert sum(len(s.trajectory.pieces) for told in traffic.told.values() for s in told) > 200
    assert found[-1].depart == _core.NEVER


@pytest.mark.parametrize("begin", [4.5, 5.8, 6.0])
def test_who_ends_between_two_cells_stays_in_both(begin):
    """From (4, 8) or on the way, to the border of (5, 8) and (6, 8), or there from the first."""
    start, length = Pose(begin, 8.5, 0.0), 6.0 - begin
    path = Trajectory("r", start)
    if length:
        path = Trajectory("r", start, (Piece(0, None, start, (length, 0.0, 0.0)),), ((0, 1500),))
    *_, behind, ahead = stays_of(GRID, path)
    assert (behind.cell, ahead.cell) == (8 * WIDTH + 5, 8 * WIDTH + 6)
    assert behind.depart < 1500
    assert (ahead.arrive, ahead.depart) == (_core.NEVER - 1, _core.NEVER)
