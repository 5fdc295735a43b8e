"""Tasks that wait for others, as they are planned to move."""

from dataclasses import replace
from itertools import pairwise

import pytest
from tests.plan.rooms import CART, EAST, WEST, judged, room, team, to

from clearway.coordinate.precedence import SHARE, plan_in_order
from clearway.model import Plan, Site, Status, Stop, Trajectory
from clearway.plan import PrioritisedPlanner
from clearway.protocols import Budget


def waiting(visit, *tasks):
    return replace(visit, after=tasks)


def times(problem, plan):
    """Begin and end (s) of each task."""
    return {
        problem.tours[robot][stop.visit].task: (stop.arrive / 1000.0, stop.leave / 1000.0)
        for robot, path in plan.trajectories.items()
        for stop in path.stops
    }


def two():
    """a serves for 5 s, 8 m away; b, 2 m from its visit, waits for that."""
    return team(
        room(12.0, 8.0),
        (CART, (1.0, 1.0, EAST), to(9.0, 1.0, EAST, 5.0)),
        (CART, (1.0, 5.0, EAST), waiting(to(3.0, 5.0), "a 9/1"), to(9.0, 5.0)),
    )


def test_a_task_is_served_once_those_before_it_are_finished():
    """a is done at 13 s, so b, which is there after 2 s, goes on at 13 s to drive 6 m."""
    problem = two()
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert judged(problem, plan) == []
    done = times(problem, plan)
    assert done["a 9/1"][1] == pytest.approx(13.0, abs=0.1)
    assert done["b 3/5"][0] == pytest.approx(done["a 9/1"][1], abs=0.1)
    assert plan.trajectories["b"].end == pytest.approx(19_000, abs=200)
    assert plan.counters["trials"] == 1


def test_the_plan_tells_what_was_asked_not_the_times_it_was_planned_with():
    """The tours are those of the problem, and the bound is one on them: 8 + 13 + 6 s."""
    problem = two()
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert plan.tours == problem.tours
    assert plan.lower_bound == pytest.approx(27.0)


def test_a_chain_of_tasks_goes_from_robot_to_robot():
    """Four robots side by side serve 3 s each, one after another; the first is 8 m away."""
    members = [
        (CART, (1.0, 1.0 + 2.0 * i, EAST), waiting(to(9.0, 1.0 + 2.0 * i, EAST, 3.0)))
        for i in range(4)
    ]
    problem = team(room(12.0, 8.0), *members)
    names = [tour[0].task for tour in problem.tours.values()]
    tours = {
        robot: (waiting(tour[0], *names[:i][-1:]),)
        for i, (robot, tour) in enumerate(problem.tours.items())
    }
    problem = replace(problem, tours=tours)
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert judged(problem, plan) == []
    done = times(problem, plan)
    assert all(done[one][1] <= done[other][0] for one, other in pairwise(names))
    assert done[names[-1]][1] == pytest.approx(20.0, abs=1.0)


def test_where_a_task_takes_longer_than_its_bound_the_next_plan_waits_for_it():
    """8 m and half a turn take longer than the longer of the two, so b's first time is too soon."""
    problem = team(
        room(12.0, 8.0),
        (CART, (1.0, 1.0, EAST), to(9.0, 1.0, WEST, 5.0)),
        (CART, (1.0, 5.0, EAST), waiting(to(3.0, 5.0), "a 9/1"), to(9.0, 5.0)),
    )
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert judged(problem, plan) == []
    assert plan.counters["trials"] == 2
    done = times(problem, plan)
    assert done["b 3/5"][0] == done["a 9/1"][1] > 13.5


def test_nobody_waits_where_it_keeps_those_away_whom_it_waits_for():
    """a serves at the mouth of a dead end of one lane, after b has served at its bottom."""
    dead_end = Site(((0, 0), (6, 0), (16, 0), (16, 1), (6, 1), (6, 6), (0, 6)))
    problem = team(
        dead_end,
        (CART, (4.0, 3.0, EAST), waiting(to(8.0, 0.5), "b 14/0.5"), to(4.0, 3.0, EAST)),
        (CART, (1.0, 5.0, EAST), to(14.0, 0.5, EAST, 5.0), to(1.0, 5.0, EAST)),
    )
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert plan.status is Status.SOLVED
    assert judged(problem, plan) == []


class Stubborn:
    """Serves b's visit at its time, and a's task always a second later than that."""

    def __init__(self):
        self.budgets = []

    def __call__(self, problem, budget, seed, progress=None):
        self.budgets.append(budget)
        begin = int(1000 * problem.tours["b"][0].not_before)
        stops = {"a": (Stop(0, begin, begin + 1000),), "b": (Stop(0, begin, begin),)}
        paths = {r.id: Trajectory(r.id, r.start, stops=stops[r.id]) for r in problem.robots}
        return Plan(Status.SOLVED, paths, problem.tours, {}, lower_bound=begin / 1000.0)

    def unsupported(self, problem):
        return ()


def test_what_never_settles_is_told_with_the_tasks():
    """Whatever time b gets, a is later."""
    plan = plan_in_order(Stubborn(), two(), Budget(), 0)
    assert plan.status is Status.STOPPED
    assert plan.concerned == ("b",)
    assert "too early for the tasks they wait for: b 3/5" in plan.reason
    assert plan.lower_bound == pytest.approx(13.0)


def test_a_budget_is_shared_out_and_never_exceeded():
    """Small shares for first plans until the order is kept, then the rest."""
    planner = Stubborn()
    plan_in_order(planner, two(), Budget(seconds=16.0, expansions=1600), 0)
    *trials, last = planner.budgets
    assert set(trials) == {Budget(seconds=16.0 * SHARE, expansions=100, improve=False)}
    assert last.improve
    assert sum(b.expansions for b in planner.budgets) == 1600
    assert last.seconds == 16.0 - len(trials)


def test_once_the_order_is_kept_the_rest_of_the_budget_improves_the_plan():
    """A first plan costs little, and all but that is for the second one."""
    spent = []

    def planner(problem, budget, seed, progress=None):
        answer = PrioritisedPlanner()(problem, budget, seed, progress)
        spent.append((budget, answer.counters["expansions"]))
        return answer

    budget = Budget(expansions=80_000)
    plan = plan_in_order(planner, two(), budget, 0)
    assert judged(two(), plan) == []
    assert [given.improve for given, _ in spent] == [False, True]
    assert spent[1][0].expansions == budget.expansions - spent[0][1]
    assert plan.counters["expansions"] == sum(count for _, count in spent) <= budget.expansions


def test_an_interrupt_ends_it_with_the_plan_that_keeps_the_order():
    """The first plan is in order; the second one is interrupted, and no better."""
    asked = []

    def planner(problem, budget, seed, progress=None):
        asked.append(budget)
        answer = PrioritisedPlanner()(problem, Budget(), seed, progress)
        if len(asked) == 1:
            return answer
        stopped = {**answer.counters, "interrupted": 1}
        return replace(answer, status=Status.STOPPED, reason="interrupted", counters=stopped)

    plan = plan_in_order(planner, two(), Budget(expansions=80_000), 0)
    assert plan.status is Status.SOLVED
    assert plan.counters["interrupted"] == 1
    assert len(asked) == 2


def test_a_share_that_is_too_small_for_a_plan_is_doubled():
    """A sixteenth, an eighth, and then the plan that a quarter is enough for."""
    shares = []

    def planner(problem, budget, seed, progress=None):
        shares.append(budget.seconds)
        if budget.seconds < 4.0:
            return Plan(Status.STOPPED, {}, problem.tours, {}, reason="the budget ended")
        return PrioritisedPlanner()(problem, Budget(), seed, progress)

    plan = plan_in_order(planner, two(), Budget(seconds=16.0), 0)
    assert plan.status is Status.SOLVED
    assert shares == [1.0, 2.0, 4.0, 9.0]


def test_tours_that_wait_for_each_other_are_told():
    """a begins with what waits for b's second task, b with what waits for a's second."""
    problem = team(
        room(12.0, 8.0),
        (CART, (1.0, 1.0, EAST), waiting(to(3.0, 1.0), "b 6/5"), to(6.0, 1.0)),
        (CART, (1.0, 5.0, WEST), waiting(to(3.0, 5.0), "a 6/1"), to(6.0, 5.0)),
    )
    plan = plan_in_order(PrioritisedPlanner(), problem, Budget(), 0)
    assert plan.status is Status.STOPPED
    assert "wait for each other at a 3/1, a 6/1, b 3/5, b 6/5" in plan.reason
    assert plan.concerned == ("a", "b")
    assert judged(problem, plan) == []


def test_without_waiting_the_planner_is_asked_once_with_everything():
    """Nothing is shared out where nobody waits."""
    planner, budget = Stubborn(), Budget(seconds=3.0)
    problem = team(
        room(12.0, 8.0),
        (CART, (1.0, 1.0, EAST), to(3.0, 1.0)),
        (CART, (1.0, 5.0, WEST), to(3.0, 5.0)),
    )
    plan_in_order(planner, problem, budget, 0)
    assert planner.budgets == [budget]
