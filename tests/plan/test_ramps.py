"""Plans of robots whose acceleration is limited pass the judge; those made without do not."""

import random
from dataclasses import replace

import pytest
from tests.plan.random_teams import random_team
from tests.plan.rooms import CARRIER, CART, EAST, FLOAT, judged, room, swapping_corridor, team, to

from clearway.model import FOUR_WHEEL_MODES, Limits, Pose, RobotState, Status
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Budget

RATES = (0.3, 0.5, 1.16, 2.31, 5.0)
TOUR = ((1.0, 6.0, EAST), to(11.0, 6.0))
EFFORT = Budget(expansions=20_000)


def limited(problem, rng):
    """The problem with limits drawn for each type that can keep them."""
    types = {}
    for name, kind in problem.robot_types.items():
        up, down = rng.choice([*RATES, None]), rng.choice(RATES)
        if kind.kinematics != "holonomic":
            limits = replace(kind.limits, acceleration=up, deceleration=down)
            kind = replace(kind, limits=limits)
        types[name] = kind
    return replace(problem, robot_types=types)


@pytest.mark.parametrize("seed", range(20))
def test_random_teams_keep_their_limits(seed):
    """Unlike robots among obstacles, with loads and services; modes are called as ever."""
    problem = limited(random_team(seed), random.Random(seed))
    plan = PrioritisedPlanner()(problem, EFFORT, seed)
    assert [str(violation) for violation in judged(problem, plan)] == []
    for robot in problem.robots:
        path = plan.trajectories.get(robot.id)
        if path and problem.robot_types[robot.type].kinematics == "four_wheel":
            assert {piece.mode for piece in path.pieces} <= set(FOUR_WHEEL_MODES)


def test_most_random_teams_are_solved_with_limits_too():
    """Nearly as many as without; 17 of 20 when this was written."""
    planner = PrioritisedPlanner()
    problems = [limited(random_team(seed), random.Random(seed)) for seed in range(20)]
    plans = [planner(problem, EFFORT, 0) for problem in problems]
    assert sum(plan.status is Status.SOLVED for plan in plans) >= 14


@pytest.mark.parametrize("seed", range(8))
def test_a_plan_without_limits_fails_the_judge_who_knows_them(seed):
    """Where anybody with limits moves at all, it starts and stops at once."""
    free = random_team(seed)
    plan = PrioritisedPlanner()(free, EFFORT, seed)
    bound = limited(free, random.Random(seed))
    moving = [
        robot
        for robot in bound.robots
        if bound.robot_types[robot.type].limits.has_ramps
        and robot.id in plan.trajectories
        and any(piece.length for piece in plan.trajectories[robot.id].pieces)
    ]
    kinds = {violation.kind for violation in judged(bound, plan)}
    assert moving
    assert kinds & {"acceleration", "deceleration"}


def test_a_straight_drive_takes_what_a_trapezoid_takes():
    """20 m at 2.5 m/s, 95 % of 1 m/s^2 both ways: 20 / 2.5 + 2.5 / 0.95 = 10.63 s."""
    limits = replace(CARRIER.limits, acceleration=1.0, deceleration=1.0)
    problem = team(
        room(30.0, 6.0), (replace(CARRIER, limits=limits), (4.0, 3.0, EAST), to(24.0, 3.0))
    )
    plan = PrioritisedPlanner()(problem, EFFORT, 0)
    assert plan.trajectories["a"].end == pytest.approx(10632, abs=40)
    assert judged(problem, plan) == []


def test_nobody_waits_at_speed():
    """One crosses the other's way: whoever lets the other pass has come to rest before."""
    limits = replace(CART.limits, acceleration=0.5, deceleration=0.4)
    heavy = replace(CART, limits=limits)
    problem = team(
        room(12.0, 12.0),
        (heavy, *TOUR),
        (heavy, (6.0, 1.0, 1.5707963), to(6.0, 11.0, 1.5707963)),
    )
    plan = PrioritisedPlanner()(problem, EFFORT, 0)
    assert plan.status is Status.SOLVED
    assert judged(problem, plan) == []
    alone = PrioritisedPlanner()(team(problem.site, (heavy, *TOUR)), EFFORT, 0)
    first, second = sorted(path.end for path in plan.trajectories.values())
    assert first == alone.trajectories["a"].end < second


def test_what_cannot_be_done_without_limits_cannot_be_done_with_them():
    """A corridor of one lane stays what it is."""
    problem = swapping_corridor()
    (kind,) = problem.robot_types.values()
    heavy = replace(kind, limits=replace(kind.limits, acceleration=1.0, deceleration=1.0))
    problem = replace(problem, robot_types={kind.name: heavy})
    plan = PrioritisedPlanner()(problem, EFFORT, 0)
    assert plan.status is not Status.SOLVED
    assert judged(problem, plan) == []


def test_a_plan_may_go_on_from_a_committed_motion_that_rests():
    """Cut in the middle of the drive the rest is refused by name; at its end it is planned."""
    limits = Limits(speed=1.0, yaw_rate=0.8, turning_radius=1.0, acceleration=0.5)
    heavy = replace(CART, limits=limits)
    problem = team(room(14.0, 4.0), (heavy, (1.0, 2.0, EAST), to(7.0, 2.0)))
    planner = PrioritisedPlanner()
    path = planner(problem, EFFORT, 0).trajectories["a"]

    def on_from(count):
        pieces, timing = path.pieces[:count], path.timing[:count]
        prefix = replace(path, pieces=pieces, timing=timing, stops=())
        at = RobotState(pieces[-1].end, pieces[-1].mode, timing[-1][1], committed=prefix)
        tours = {"a": (to(12.0, 2.0),)}
        return replace(problem, tours=tours, states={"a": at})

    (reason,) = planner.unsupported(on_from(len(path.pieces) // 2))
    assert "robot a" in reason
    assert "at speed" in reason
    whole = on_from(len(path.pieces))
    assert planner.unsupported(whole) == ()
    plan = planner(whole, EFFORT, 0)
    assert plan.trajectories["a"].pieces[-1].end == pytest.approx(Pose(12.0, 2.0, 0.0))
    assert judged(whole, plan) == []


def test_who_drives_in_any_direction_is_refused_with_limits():
    """By the name of its type, with the mend."""
    heavy = replace(FLOAT, limits=replace(FLOAT.limits, acceleration=0.5))
    problem = team(room(10.0, 4.0), (heavy, (1.0, 2.0, EAST), to(9.0, 2.0)))
    (reason,) = PrioritisedPlanner().unsupported(problem)
    assert reason.startswith("robot type float: acceleration limits")
    assert "remove them" in reason
