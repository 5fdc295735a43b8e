"""Sharing tasks out anew for what their ways have proved to take."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from tests.plan.rooms import CART, EAST, room

from clearway.assign import build, tours_of
from clearway.coordinate.reassign import TRIALS, Reassignment, learned
from clearway.coordinate.value import sum_of_costs
from clearway.model import (
    Order,
    Piece,
    Plan,
    Pose,
    Robot,
    Scenario,
    Status,
    Stop,
    Task,
    Trajectory,
    Visit,
)
from clearway.protocols import Budget

START = Pose(1.5, 1.5, EAST)


def scenario(*tasks, **times):
    """One robot, and tasks of as many visits as said, all 4 m ahead with 2 s of service."""
    orders = tuple(
        Order(Task(name, (Visit(name, Pose(5.5, 1.5, EAST), 2.0),) * visits), **times)
        for name, visits in tasks
    )
    robots = Robot("a", "cart", START), Robot("b", "cart", Pose(1.5, 5.5, EAST))
    return Scenario("hall", room(20.0, 10.0), {"cart": CART}, robots, orders)


def driven(work, routes, *stops):
    """Return a plan in which a's visits are served at these times (s)."""
    path = Trajectory(
        "a",
        START,
        stops=tuple(Stop(i, int(1e3 * t), int(1e3 * u)) for i, (t, u) in enumerate(stops)),
    )
    return Plan(Status.SOLVED, {"a": path}, tours_of(work, routes), {})


def test_legs_are_believed_to_last_as_long_as_they_did():
    """7 s to t, 3 s on to u; the other robot and the other order are believed as before."""
    work = scenario(("t", 1), ("u", 1))
    problem, routes = build(work), ((0, 1), ())
    again = learned(work, problem, routes, driven(work, routes, (7, 9), (12, 14)))
    assert again.start_to_task.tolist() == [[7.0, 4.0], problem.start_to_task[1].tolist()]
    assert again.task_to_task[0].tolist() == [[0.0, 3.0], [0.0, 0.0]]
    assert (again.task_to_task[1] == problem.task_to_task[1]).all()


def test_ways_within_a_task_are_learnt_without_their_services():
    """Three visits of 2 s: 1 s and 5 s between them."""
    work = scenario(("t", 3))
    problem, routes = build(work), ((0,), ())
    again = learned(work, problem, routes, driven(work, routes, (4, 6), (7, 9), (14, 16)))
    assert again.start_to_task[0].tolist() == [4.0]
    assert again.inner.tolist() == [[6.0], [0.0]]


def test_what_waited_for_its_time_teaches_nothing():
    """Released at 60 s, the visit is served then: that is not how long the way is."""
    work = scenario(("t", 1), release=60.0)
    problem, routes = build(work), ((0,), ())
    again = learned(work, problem, routes, driven(work, routes, (60, 62)))
    assert (again.start_to_task == problem.start_to_task).all()


WORK = scenario(("t", 1), ("u", 1))
UNLIMITED = Budget()


@dataclass
class Offices:
    """Plays assigner and planner: routes come from a list, and so do the plans' costs (s)."""

    routes: list
    costs: list
    solved: list = field(default_factory=lambda: [True] * 9)
    interrupted: int = 0
    problems: list = field(default_factory=list)
    budgets: list = field(default_factory=list)
    planned: list = field(default_factory=list)
    served: list | None = None
    due: float | None = None

    def assign(self, problem):
        self.problems.append(problem)
        return self.routes[len(self.problems)]

    def plan(self, routes, budget):
        number = len(self.planned)
        self.budgets.append(budget)
        self.planned.append(routes)
        end = int(1000 * self.costs[number])
        served = int(1000 * (self.served or self.costs)[number])
        piece = Piece(0, "forward", START, (1.0, 0.0, 0.0))
        tours = tours_of(WORK, routes)
        stops = {
            robot: tuple(Stop(i, served, served) for i in range(len(tours[robot])))
            for robot in "ab"
        }
        paths = {
            "a": Trajectory("a", START, (piece,), ((0, end),), stops["a"]),
            "b": Trajectory("b", START, stops=stops["b"]),
        }
        tours = {r: tuple(replace(v, due=self.due) for v in tour) for r, tour in tours.items()}
        status = Status.SOLVED if self.solved[number] else Status.STOPPED
        counters = {"expansions": 10, "interrupted": self.interrupted}
        return Plan(status, paths, tours, {}, counters=counters)

    def run(self, rounds, budget=UNLIMITED):
        office = Reassignment(WORK, self.assign, self.plan, sum_of_costs, rounds)
        return office(build(WORK), self.routes[0], budget)


BOTH, SWAPPED, SPLIT = ((0, 1), ()), ((1, 0), ()), ((0,), (1,))


def test_the_better_plan_is_kept_and_its_gain_told():
    """20 s, then 15 s: a quarter less. The assigner was told that the way to t takes 20 s."""
    offices = Offices([BOTH, SWAPPED], [20.0, 15.0])
    plan = offices.run(1)
    assert plan.trajectories["a"].end == 15_000
    assert plan.counters["reassigned"] == 1
    assert plan.counters["reassignment_gain_permille"] == 250
    assert plan.counters["expansions"] == 20
    assert offices.problems[0].start_to_task[0, 0] == 20.0


def test_a_worse_plan_is_dropped():
    """20 s stay, for 25 s and 22 s were no better."""
    offices = Offices([BOTH, SWAPPED, SPLIT], [20.0, 25.0, 22.0])
    plan = offices.run(2)
    assert plan.trajectories["a"].end == 20_000
    assert plan.counters["reassigned"] == 0
    assert plan.counters["reassignment_gain_permille"] == 0
    assert offices.planned == [BOTH, SWAPPED, SPLIT]


def test_a_plan_that_fails_ends_the_rounds():
    """Nothing is learnt from it, and it is not kept."""
    offices = Offices([BOTH, SWAPPED, SPLIT], [20.0, 5.0], solved=[True, False])
    plan = offices.run(5)
    assert plan.trajectories["a"].end == 20_000
    assert len(offices.problems) == 1


def test_routes_seen_before_end_the_rounds():
    """Learning the same again would lead round and round."""
    offices = Offices([BOTH, SWAPPED, BOTH], [20.0, 25.0])
    offices.run(5)
    assert offices.planned == [BOTH, SWAPPED]


def test_due_times_go_before_costs():
    """A plan of 15 s is no better than one of 20 s if it serves what is due at 25 s at 30 s."""
    for due, reassigned in ((25.0, 0), (31.0, 1), (None, 1)):
        offices = Offices([BOTH, SWAPPED], [20.0, 15.0], served=[20.0, 30.0], due=due)
        assert offices.run(1).counters["reassigned"] == reassigned


def test_a_limited_budget_is_shared_and_its_rest_goes_into_the_best_routes():
    """At most an eighth for each of two first plans, of which they take 10 expansions each."""
    offices = Offices([BOTH, SWAPPED], [20.0, 15.0, 14.0])
    plan = offices.run(1, Budget(expansions=800))
    assert [budget.expansions for budget in offices.budgets] == [100, 100, 780]
    assert [budget.improve for budget in offices.budgets] == [False, False, True]
    assert offices.planned == [BOTH, SWAPPED, SWAPPED]
    assert plan.trajectories["a"].end == 14_000
    assert plan.counters["reassignment_gain_permille"] == 250
    assert TRIALS == 0.25


def test_who_finds_no_plan_in_its_share_has_the_rest_for_it():
    """The first routes are planned once more."""
    offices = Offices([BOTH], [20.0, 18.0], solved=[False, True])
    plan = offices.run(1, Budget(expansions=800))
    assert [budget.expansions for budget in offices.budgets] == [100, 790]
    assert plan
    assert plan.trajectories["a"].end == 18_000


def test_an_interrupt_ends_it_with_what_there_is():
    """No further plan, and the plan tells of the interrupt."""
    offices = Offices([BOTH, SWAPPED], [20.0], interrupted=1)
    plan = offices.run(3, Budget(expansions=800))
    assert len(offices.planned) == 1
    assert plan.counters["interrupted"] == 1


def test_a_seen_detour_changes_hands():
    """Learnt ways reach the assigner as distances at the problem's speed."""
    quick = replace(CART, limits=replace(CART.limits, speed=2.0))
    work = replace(scenario(("t", 1)), robot_types={"cart": quick})
    problem, routes = build(work), ((0,), ())
    again = learned(work, problem, routes, driven(work, routes, (7, 9)))
    assert again.start_to_task[0, 0] == pytest.approx(14.0)
    assert np.isfinite(again.start_to_task).all()
