"""The exam that every planner sits: tours, each other, effort, and what it says."""

from dataclasses import replace
from itertools import pairwise

import pytest
from tests.contracts.conftest import skip_refused
from tests.plan.random_teams import random_team
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
    TRUCK,
    TUG,
    WEST,
    judged,
    record,
    room,
    swapping_corridor,
    team,
    to,
)

from clearway.model import (
    Limits,
    Obstacle,
    Pose,
    Problem,
    RobotState,
    Site,
    Status,
    Trajectory,
    to_ticks,
)
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Budget
from clearway.validate import separations

ENOUGH = Budget(expansions=60_000)


# What robots are asked to do


def test_one_robot_crosses_an_empty_room(solve):
    """8 m straight ahead at 1 m/s take 8 s, and at most a tenth for rounding to ticks."""
    plan = solve(team(room(10.0, 4.0), (CART, (1.0, 2.0, EAST), to(9.0, 2.0))))
    assert to_ticks(8.0) <= plan.trajectories["a"].end <= to_ticks(8.1)
    assert plan.trajectories["a"].final_pose[:2] == pytest.approx((9.0, 2.0))


def test_a_problem_without_robots_has_an_empty_plan(solve):
    """Nobody to plan for is not an error."""
    plan = solve(Problem(room(5.0, 5.0), {"cart": CART}, (), {}))
    assert plan.trajectories == {}


def test_robots_without_tours_stand_at_their_starts(solve):
    """Nobody has anything to do, so nobody has a trajectory."""
    plan = solve(team(room(10.0, 5.0), (CART, (1.0, 1.0, EAST)), (DRUM, (5.0, 3.0, EAST))))
    assert plan.trajectories == {}
    assert plan.assignment == {"a": (), "b": ()}


def test_a_robot_that_is_there_already_stays(solve):
    """A visit at the start pose costs no motion, and its service is still given."""
    plan = solve(team(room(10.0, 5.0), (CART, (1.0, 1.0, EAST), to(1.0, 1.0, service=2.0))))
    assert plan.trajectories["a"].distance == 0.0
    (stop,) = plan.trajectories["a"].stops
    assert (stop.arrive, stop.leave) == (0, to_ticks(2.0))


def test_several_visits_are_made_in_order_each_for_its_service(solve):
    """Three visits of 0, 3 and 1.5 s, with headings of their own."""
    visits = (to(9.0, 1.0, NORTH), to(1.0, 5.0, WEST, 3.0), to(5.0, 3.0, 0.7, 1.5))
    plan = solve(team(room(10.0, 6.0), (CART, (1.0, 1.0, EAST), *visits)))
    stops = plan.trajectories["a"].stops
    assert [stop.visit for stop in stops] == [0, 1, 2]
    assert [stop.leave - stop.arrive for stop in stops] == [0, 3000, 1500]
    assert all(one.leave <= other.arrive for one, other in pairwise(stops))
    assert plan.assignment["a"] == ("a 9/1", "a 1/5", "a 5/3")


def test_no_service_begins_before_its_time(solve):
    """8 m and 4 m at 1 m/s; between them the robot waits until 30 s, and after them it rests."""
    early, late = to(9.0, 1.0, EAST, 2.0), to(5.0, 1.0, EAST, 1.0)
    visits = replace(early, not_before=30.0), replace(late, not_before=50.0)
    plan = solve(team(room(10.0, 6.0), (CART, (1.0, 1.0, EAST), *visits)))
    first, last = plan.trajectories["a"].stops
    assert (first.arrive, first.leave) == (30_000, 32_000)
    assert (last.arrive, last.leave) == (50_000, 51_000)
    assert to_ticks(36.0) <= plan.trajectories["a"].end <= to_ticks(37.0)


def test_nobody_waits_for_its_time_where_another_must_pass(solve):
    """In a lane of one body, a could be at its visit long before b has left the lane by it."""
    hall = Site(((0, 0), (16, 0), (16, 1), (10, 1), (10, 4), (6, 4), (6, 1), (0, 1)))
    wait = replace(to(12.0, 0.5, EAST), not_before=60.0)
    plan = solve(
        team(hall, (CART, (1.0, 0.5, EAST), wait), (CART, (14.5, 0.5, EAST), to(1.0, 0.5, EAST)))
    )
    assert plan.trajectories["a"].stops[0].arrive == 60_000


def test_a_first_plan_is_not_improved_where_nobody_asks_for_more(planner):
    """It is the plan that an unlimited search ends with; what is left of the effort stays."""
    if not isinstance(planner, PrioritisedPlanner):
        pytest.skip("it has no phase of improvement")
    problem = random_team(3)
    first = planner(problem, Budget(expansions=200_000, improve=False), 0)
    assert first.trajectories == planner(problem, Budget(), 0).trajectories
    assert first.counters["expansions"] < 200_000


def test_a_task_of_two_visits_is_assigned_once(solve):
    """Tasks count in the order of their first visit, and parking belongs to none."""
    visits = [
        replace(to(x, 2.0), task=task) for x, task in ((4, "t"), (7, "u"), (9, "t"), (8, None))
    ]
    problem = team(room(10.0, 4.0), (CART, (1.0, 2.0, EAST)))
    plan = solve(replace(problem, tours={"a": tuple(visits)}))
    assert plan.assignment["a"] == ("t", "u")


@pytest.mark.parametrize("theta", [0.1, -2.0, 3.1415])
def test_headings_between_those_of_any_table(solve, theta):
    """Start and goal at headings that no table of 16 or 32 has."""
    solve(team(room(12.0, 8.0), (CARRIER, (3.0, 4.0, theta), to(8.0, 4.0, theta + 0.321))))


# Each other


def test_two_robots_swap_ends_of_a_corridor_with_a_siding(solve):
    """A lane of 1 m is too narrow to pass, a siding of 3 m x 1.2 m is enough."""
    siding = Site(((0, 0), (12, 0), (12, 1), (7.5, 1), (7.5, 2.2), (4.5, 2.2), (4.5, 1), (0, 1)))
    east, west = to(11.0, 0.5), to(1.0, 0.5)
    plan = solve(team(siding, (CART, (1.0, 0.5, EAST), east), (CART, (11.0, 0.5, EAST), west)))
    assert max(trajectory.distance for trajectory in plan.trajectories.values()) > 10.5


def test_a_robot_without_a_tour_is_gone_round(solve):
    """It stands on the straight line, so the way is longer than that."""
    plan = solve(
        team(room(10.0, 4.0), (CART, (1.0, 2.0, EAST), to(9.0, 2.0)), (CART, (5.0, 2.0, NORTH)))
    )
    assert "b" not in plan.trajectories
    assert plan.trajectories["a"].end > to_ticks(8.0)


def test_a_robot_waits_for_its_neighbour_to_leave_its_start(solve):
    """In a lane of one body, the goal of the one behind lies beyond the start of the one ahead."""
    plan = solve(
        team(
            room(14.0, 1.0),
            (CART, (1.0, 0.5, EAST), to(10.0, 0.5)),
            (CART, (3.0, 0.5, EAST), to(12.0, 0.5, service=2.0)),
        )
    )
    assert plan.trajectories["a"].final_pose.x < plan.trajectories["b"].final_pose.x


def test_the_goal_of_one_is_the_start_of_the_next(solve):
    """Four robots in a ring, each going to where the next one stands."""
    poses = [(2.0, 2.0), (8.0, 2.0), (8.0, 6.0), (2.0, 6.0)]
    members = [
        (CART, (*here, EAST), to(*there))
        for here, there in zip(poses, poses[1:] + poses[:1], strict=True)
    ]
    solve(team(room(10.0, 8.0), *members))


def test_a_final_rest_is_respected_for_ever(solve):
    """Who ends in the middle of a lane lets those pass first who must go through it."""
    plan = solve(
        team(
            Site(((0, 0), (14, 0), (14, 1), (4, 1), (4, 3), (0, 3))),
            (CART, (3.0, 0.5, EAST), to(8.0, 0.5)),
            (CART, (1.0, 2.5, EAST), to(13.0, 0.5)),
        )
    )
    passed = plan.trajectories["b"].end
    assert plan.trajectories["a"].end < passed + to_ticks(60.0)


def test_four_robots_cross_in_the_middle(solve):
    """Each drives to the side opposite."""
    solve(
        team(
            room(10.0, 10.0),
            (CART, (1.0, 5.0, EAST), to(9.0, 5.0)),
            (DRUM, (9.0, 4.8, EAST), to(1.0, 5.1)),
            (HOOK, (5.0, 1.2, NORTH), to(5.0, 8.5, NORTH)),
            (CAR, (5.0, 8.5, SOUTH), to(5.0, 1.5, SOUTH)),
        )
    )


def test_a_mixed_fleet_crosses_in_the_middle(solve):
    """Unlike in size, speed, radius and ways of moving, all on one clock."""
    solve(
        team(
            room(16.0, 16.0),
            (CARRIER, (2.0, 8.0, EAST), to(14.0, 8.0)),
            (TRUCK, (13.0, 10.5, WEST), to(3.0, 10.5, WEST)),
            (STACKER, (8.0, 2.0, NORTH), to(8.0, 14.0, SOUTH)),
            (TUG, (5.0, 14.0, SOUTH), to(11.0, 2.0, SOUTH)),
            (FLOAT, (14.0, 5.0, 0.3), to(2.0, 5.0, 1.9)),
            (PIVOT, (14.0, 14.0, WEST), to(2.0, 2.0, WEST)),
        )
    )


@pytest.mark.parametrize(
    "robot_type", [TRUCK, STACKER, PIVOT, TUG, FLOAT], ids=lambda kind: kind.name
)
def test_each_kind_turns_about_beside_another_one(solve, robot_type):
    """To where it stood, facing the other way, while a cart passes by."""
    solve(
        team(
            room(14.0, 10.0),
            (robot_type, (7.0, 5.0, EAST), to(7.0, 5.0, WEST)),
            (CART, (1.0, 2.0, EAST), to(13.0, 8.0)),
        )
    )


def test_a_start_in_motion_costs_its_change_of_mode(solve):
    """Driving ahead it goes on at once; sideways only after the 2 s that a change takes."""
    stiff = replace(CART, mode_switch=2.0)
    for goal, change in ((to(8.0, 2.0), 0.0), (to(2.0, 5.0), 2.0)):
        problem = team(room(10.0, 7.0), (stiff, (2.0, 2.0, EAST), goal))
        (robot,) = problem.robots
        moving = replace(robot, start_speed=0.5, start_mode="forward")
        plan = solve(replace(problem, robots=(moving,)))
        timing = plan.trajectories["a"].timing
        assert timing[0][0] == to_ticks(change)
        at_rest = replace(robot, start_mode="stop")
        assert solve(replace(problem, robots=(at_rest,))).trajectories["a"].timing[0][0] == 0


def test_the_clearance_is_kept_where_the_poses_leave_it(solve):
    """With 0.4 m asked for and starts and goals farther apart, bodies stay 0.4 m apart."""
    shy = replace(CART, clearance=0.4)
    problem = team(
        room(12.0, 6.0),
        (shy, (1.0, 3.0, EAST), to(11.0, 3.0)),
        (shy, (11.0, 3.0, EAST), to(1.0, 3.0)),
    )
    plan = solve(problem)
    ((_, _, gap, _),) = separations(record(problem, plan))
    assert gap >= 0.4 - 2e-3


# Fixed trajectories and starts in motion


def fixed_crossing(planner):
    """A robot that is known to drive through the middle of a room from west to east."""
    alone = team(room(12.0, 5.0), (CART, (1.0, 2.5, EAST), to(11.0, 2.5)))
    return planner(alone, ENOUGH, 0).trajectories["a"]


def test_fixed_trajectories_are_kept_and_avoided(planner, solve):
    """Head on against a robot that is not replanned, the other one gives way."""
    fixed = fixed_crossing(planner)
    problem = team(
        room(12.0, 5.0),
        (CART, (1.0, 2.5, EAST), to(11.0, 2.5)),
        (CART, (11.0, 2.5, EAST), to(1.0, 2.5)),
        fixed={"a": fixed},
    )
    plan = solve(problem)
    assert plan.trajectories["a"] == fixed
    assert plan.trajectories["b"].distance > 10.0


def test_a_robot_leaves_its_start_before_a_fixed_one_comes(planner, solve):
    """It stands in the way of a robot that will not stop for it."""
    problem = team(
        room(12.0, 5.0),
        (CART, (1.0, 2.5, EAST), to(11.0, 2.5)),
        (CART, (6.0, 2.5, EAST), to(6.0, 4.0)),
        fixed={"a": fixed_crossing(planner)},
    )
    solve(problem)


def test_a_plan_without_effort_says_until_when_it_is_free_of_conflict(planner):
    """A fixed robot runs over one that is not planned: the plan holds until then, and says so."""
    problem = team(
        room(12.0, 5.0),
        (CART, (1.0, 2.5, EAST), to(11.0, 2.5)),
        (CART, (6.0, 2.5, EAST), to(6.0, 4.0)),
        fixed={"a": fixed_crossing(planner)},
    )
    skip_refused(planner, problem)
    plan = planner(problem, Budget(expansions=0), 0)
    assert plan.status is Status.STOPPED
    assert judged(problem, plan) == []


def test_nobody_changes_its_mode_where_a_fixed_one_passes(planner, solve):
    """It rolls ahead in a lane; a change takes 7 s, and the one behind is there after 4 s.

    So it rolls on until the other one has stopped, and only then goes to the side.
    """
    stiff = replace(CART, name="stiff", mode_switch=7.0)
    problem = team(
        room(22.0, 5.0),
        (CART, (1.0, 2.5, EAST), to(11.0, 2.5)),
        (stiff, (6.0, 2.5, EAST), to(6.0, 4.3)),
        fixed={"a": fixed_crossing(planner)},
    )
    first, second = problem.robots
    moving = replace(second, start_speed=1.0, start_mode="forward")
    plan = solve(replace(problem, robots=(first, moving)))
    assert plan.trajectories["b"].pieces[0].mode == "forward"


def committed_crossing(planner):
    """A problem whose first robot is bound to its first metres, half-way through a room."""
    problem = team(
        room(12.0, 5.0),
        (CART, (1.0, 1.5, EAST), to(7.0, 1.5), to(11.0, 4.0)),
        (CART, (6.0, 0.5, EAST), to(6.0, 4.5)),
    )
    whole = planner(team(problem.site, (CART, (1.0, 1.5, EAST), to(7.0, 1.5))), ENOUGH, 0)
    way = whole.trajectories["a"]
    bound = Trajectory("a", way.start, way.pieces, way.timing)
    state = RobotState(bound.final_pose, None, bound.end, False, bound)
    tours = {**problem.tours, "a": problem.tours["a"][1:]}
    return replace(problem, tours=tours, states={"a": state}), bound


def test_what_a_robot_is_committed_to_is_driven(planner, solve):
    """Its trajectory begins with the committed pieces, and others keep out of their way."""
    problem, bound = committed_crossing(planner)
    trajectory = solve(problem).trajectories["a"]
    count = len(bound.pieces)
    assert trajectory.pieces[:count] == bound.pieces
    assert trajectory.timing[:count] == bound.timing
    assert trajectory.start == bound.start


@pytest.mark.parametrize("case", ["no tour", "no effort"])
def test_what_a_robot_is_committed_to_is_in_every_plan(planner, case):
    """Without a tour, or not planned in time, it still drives what it is bound to and stops."""
    problem, bound = committed_crossing(planner)
    if case == "no tour":
        problem = replace(problem, tours={"b": problem.tours["b"]})
    skip_refused(planner, problem)
    plan = planner(problem, ENOUGH if case == "no tour" else Budget(expansions=0), 0)
    assert plan.trajectories["a"].pieces[: len(bound.pieces)] == bound.pieces
    assert judged(problem, plan) == []


def test_nothing_begins_before_its_state(solve):
    """A robot that is free from 4 s on stands until then."""
    problem = team(room(10.0, 4.0), (CART, (1.0, 2.0, EAST), to(9.0, 2.0)))
    state = RobotState(Pose(1.0, 2.0, EAST), None, to_ticks(4.0))
    plan = solve(replace(problem, states={"a": state}))
    assert plan.trajectories["a"].timing[0][0] >= to_ticks(4.0)


# Effort


@pytest.mark.parametrize("expansions", [0, 1, 10, 100, 1000])
def test_a_budget_of_expansions_is_obeyed(planner, expansions):
    """No more is spent; what is planned by then is right, and the rest is named."""
    problem = team(
        room(12.0, 6.0, Obstacle(disc=(6.0, 3.0, 1.0))),
        (CART, (1.0, 1.0, EAST), to(11.0, 5.0)),
        (CART, (11.0, 1.0, EAST), to(1.0, 5.0)),
        (DRUM, (1.0, 3.0, EAST), to(11.0, 3.0)),
        (HOOK, (11.0, 3.2, EAST), to(1.2, 3.2)),
    )
    plan = planner(problem, Budget(expansions=expansions), 0)
    assert plan.counters["expansions"] <= expansions
    assert judged(problem, plan) == []
    if plan.status is not Status.SOLVED:
        assert plan.status is Status.STOPPED
        assert plan.reason
        assert set(plan.concerned) == set("abcd") - set(plan.trajectories)


def test_without_any_effort_everybody_is_named(planner):
    """A budget of 0 plans nobody who has to move."""
    problem = team(
        room(10.0, 4.0), (CART, (1.0, 1.0, EAST), to(9.0, 1.0)), (CART, (1.0, 3.0, EAST))
    )
    plan = planner(problem, Budget(expansions=0), 0)
    assert plan.status is Status.STOPPED
    assert plan.concerned == ("a",)
    assert plan.trajectories == {}


def test_a_budget_of_seconds_stops_a_search_that_would_go_on(planner):
    """The corridor without a siding is never solved; it ends when the time is up."""
    plan = planner(swapping_corridor(), Budget(seconds=0.05), 0)
    assert plan.status is Status.STOPPED


@pytest.mark.parametrize("expansions", [300, 30_000])
def test_the_same_seed_and_budget_give_the_same_plan(planner, made_anew, expansions):
    """Plans are equal piece by piece, finished or not, also from a planner made anew."""
    problem = random_team(4)
    budget = Budget(expansions=expansions)
    one, other = planner(problem, budget, 7), planner(problem, budget, 7)
    assert one == other
    assert made_anew(problem, budget, 7) == one


def test_more_effort_never_makes_a_plan_worse(planner):
    """The first plan is what there is without a budget; twice the effort keeps what half found."""
    problem = team(
        room(10.0, 6.0),
        (CART, (1.0, 1.0, EAST), to(9.0, 5.0)),
        (CART, (9.0, 1.0, EAST), to(1.0, 5.0)),
    )
    plans = [planner(problem, Budget(expansions=n), 3) for n in (None, 20_000, 40_000)]
    arrivals = [sum(path.end for path in plan.trajectories.values()) for plan in plans]
    assert arrivals == sorted(arrivals, reverse=True)


def test_progress_is_told_in_numbers_that_make_sense(planner):
    """Planned robots of all robots, and an effort that does not fall."""
    told = []
    planner(
        swapping_corridor(),
        Budget(expansions=120_000),
        0,
        lambda planned, total, spent, *_: told.append((planned, total, spent)),
    )
    assert all(0 <= planned <= total == 2 for planned, total, _ in told)
    assert [spent for *_, spent in told] == sorted(spent for *_, spent in told)


# What it says of itself


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"limits": Limits(speed=1.0, acceleration=0.5, turning_radius=1.0)}, "acceleration"),
        ({"kinematics": "holonomic"}, "holonomic"),
        ({"motion": "forklift"}, "forklift"),
        ({"motion": "hover"}, "hover"),
    ],
)
def test_what_it_cannot_take_it_says_by_name(planner, change, said):
    """Reasons name the robot type and the feature, or there are none and it plans it."""
    odd = replace(CART, name="odd", **change)
    problem = team(room(10.0, 4.0), (odd, (1.0, 2.0, EAST), to(9.0, 2.0)))
    reasons = planner.unsupported(problem)
    if not reasons:
        assert judged(problem, planner(problem, ENOUGH, 0)) == []
    for reason in reasons:
        assert "odd" in reason
        assert said in reason


def test_visits_together_and_starts_in_motion_are_named(planner):
    """Both are told at once, each with its robot."""
    problem = team(
        room(10.0, 4.0), (CART, (1.0, 2.0, EAST), to(9.0, 2.0)), (CART, (5.0, 1.0, EAST))
    )
    first, second = problem.robots
    meeting = tuple(replace(visit, together=("b",)) for visit in problem.tours["a"])
    problem = replace(
        problem,
        robots=(first, replace(second, start_speed=0.5)),
        tours={"a": meeting},
        robot_types={"cart": replace(CART, limits=replace(CART.limits, acceleration=0.5))},
    )
    reasons = planner.unsupported(problem)
    assert any("robot a" in reason and "together" in reason for reason in reasons)
    assert any("robot b" in reason and "motion" in reason for reason in reasons)


def test_the_lower_bound_is_below_the_sum_of_costs(solve):
    """5 m at 1 m/s, 3 s of service, 5 m more, and nobody in the way: 13 s bound and cost."""
    problem = team(
        room(14.0, 4.0),
        (CART, (1.0, 2.0, EAST), to(6.0, 2.0, service=3.0), to(11.0, 2.0, service=9.0)),
    )
    plan = solve(problem)
    assert plan.lower_bound == pytest.approx(13.0)
    assert plan.trajectories["a"].end >= to_ticks(13.0)


# At random


@pytest.mark.parametrize("seed", range(40))
def test_small_random_teams(planner, seed):
    """Two to four unlike robots among obstacles: whatever becomes of it, it is right and told."""
    problem = random_team(seed)
    for expansions in (300, 20_000):
        plan = planner(problem, Budget(expansions=expansions), seed)
        assert [str(violation) for violation in judged(problem, plan)] == []
        assert (plan.status is Status.SOLVED) == (plan.reason is None)
        assert bool(plan.concerned) == (plan.status is not Status.SOLVED)
        if plan.status is Status.SOLVED:
            ends = sum(trajectory.end for trajectory in plan.trajectories.values()) / 1000.0
            assert plan.lower_bound <= ends + 1e-3


def test_most_small_random_teams_are_solved(planner):
    """Not a figure to be proud of, but one that shows when a planner has lost its way."""
    plans = [planner(random_team(seed), Budget(expansions=20_000), seed) for seed in range(40)]
    assert sum(plan.status is Status.SOLVED for plan in plans) >= 28
