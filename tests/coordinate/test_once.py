"""Planning once for all orders: who is asked what, and in which order."""

from dataclasses import dataclass, field

import pytest

from clearway.coordinate import System, Unsupported, plan_once
from clearway.model import (
    Footprint,
    Limits,
    Order,
    Plan,
    Pose,
    Robot,
    RobotType,
    Scenario,
    Site,
    Status,
    Task,
    Visit,
)
from clearway.protocols import Budget, Weights

CART = RobotType(
    "cart",
    Footprint.rectangle(1.0, 0.6),
    "four_wheel",
    Limits(speed=1.0, yaw_rate=0.8, turning_radius=1.0),
)
PARKING = Visit(None, Pose(1.0, 4.0, 0.0))


def scenario():
    """Two robots on a floor of 10 m x 6 m with three tasks, one of them of two visits."""
    visits = {
        "t1": (Visit("t1", Pose(3.0, 1.0, 0.0)),),
        "t2": (Visit("t2", Pose(5.0, 1.0, 0.0)), Visit("t2", Pose(5.0, 4.0, 0.0))),
        "t3": (Visit("t3", Pose(8.0, 4.0, 0.0)),),
    }
    return Scenario(
        "floor",
        Site(((0, 0), (10, 0), (10, 6), (0, 6))),
        {"cart": CART},
        (Robot("west", "cart", Pose(1.0, 1.0, 0.0)), Robot("east", "cart", Pose(9.0, 1.0, 0.0))),
        tuple(Order(Task(name, stops)) for name, stops in visits.items()),
    )


@dataclass
class Clerk:
    """Plays all parts of a system, and writes down what each is asked."""

    refusals: dict = field(default_factory=dict)
    asked: list = field(default_factory=list)

    def system(self):
        return System("clerk", Assigning(self), self.own_tasks, Planning(self), Weights(2, 3, 5))

    def own_tasks(self, scenario, tours):
        self.asked.append(("own tasks", dict(tours)))
        return {**tours, "east": (*tours["east"], PARKING)}


@dataclass
class Assigning:
    clerk: Clerk

    def __call__(self, problem, seed):
        self.clerk.asked.append(("assign", (problem, seed)))
        return ((1, 0), (2,))

    def unsupported(self, problem):
        return self.clerk.refusals.get("assign", ())


@dataclass
class Planning:
    clerk: Clerk

    def __call__(self, problem, budget, seed, progress=None):
        self.clerk.asked.append(("plan", (problem, budget, seed, progress)))
        return Plan(Status.SOLVED, {}, problem.tours, {})

    def unsupported(self, problem):
        return self.clerk.refusals.get("plan", ())


def test_each_part_is_asked_once_and_in_this_order():
    """Assign, add the robots' own tasks, plan; the clock is read just before planning."""
    clerk = Clerk()
    before = []
    plan_once(
        scenario(),
        clerk.system(),
        Budget(),
        4,
        before_planning=lambda: before.append([name for name, _ in clerk.asked]),
    )
    assert [name for name, _ in clerk.asked] == ["assign", "own tasks", "plan"]
    assert before == [["assign", "own tasks"]]


def test_the_assigner_sees_the_work_and_the_weights_of_the_system():
    """Robots and tasks by id, in the scenario's order."""
    clerk = Clerk()
    plan_once(scenario(), clerk.system(), Budget(), 4)
    problem, seed = dict(clerk.asked)["assign"]
    assert problem.robots == ("west", "east")
    assert problem.tasks == ("t1", "t2", "t3")
    assert problem.weights == Weights(2, 3, 5)
    assert seed == 4


def test_routes_become_tours_of_visits():
    """West does t2 with both of its visits, then t1; east does t3."""
    clerk = Clerk()
    plan_once(scenario(), clerk.system(), Budget(), 0)
    tours = dict(clerk.asked)["own tasks"]
    assert [(visit.task, visit.pose.y) for visit in tours["west"]] == [
        ("t2", 1.0),
        ("t2", 4.0),
        ("t1", 1.0),
    ]
    assert [visit.task for visit in tours["east"]] == ["t3"]


def test_the_planner_gets_the_robots_own_tasks_too():
    """Parking stands at the end of the tour, and effort, seed and progress are passed on."""
    clerk, budget = Clerk(), Budget(expansions=5)

    def progress(planned, total, expansions):
        """Nobody looks."""

    plan = plan_once(scenario(), clerk.system(), budget, 9, progress)
    problem, *rest = dict(clerk.asked)["plan"]
    assert problem.tours["east"][-1] == PARKING
    assert rest == [budget, 9, progress]
    assert problem.robots == scenario().robots
    assert plan.status is Status.SOLVED


@pytest.mark.parametrize(("part", "asked_by_then"), [("assign", []), ("plan", ["assign"])])
def test_what_a_part_cannot_take_ends_it_before_that_part_begins(part, asked_by_then):
    """All reasons are told at once, and the part that refuses is not called."""
    clerk = Clerk({part: ("no fish", "no chips")})
    with pytest.raises(Unsupported, match="no fish; no chips"):
        plan_once(scenario(), clerk.system(), Budget(), 0)
    assert [name for name, _ in clerk.asked if name != "own tasks"] == asked_by_then
