"""When visits are made, and what the figures of a plan come to."""

import math
from dataclasses import replace
from types import ModuleType

import pytest

from clearway.model import Pose, Visit
from clearway.validate import validate_plan
from clearway.validate.judge import _motions
from clearway.validate.paper_cost import paper_cost
from clearway.validate.steps import Steps
from clearway.validate.visits import loads_of, windows_at


def kinds(plan) -> list[str]:
    return [violation.kind for violation in validate_plan(plan)]


def test_a_pose_passed_at_speed(by_hand: ModuleType) -> None:
    """A cart at 1 m/s is within 1 cm of a point on its way for 20 ms: 1.99 s to 2.01 s."""
    plan = by_hand.alone(by_hand.CART, by_hand.ahead(5.0))
    steps = Steps.from_track(plan.tracks["a"], 10.0)
    [(begin, end)] = windows_at(steps, Pose(7.0, 5.0, 0.0))
    assert (begin, end) == (pytest.approx(1.99), pytest.approx(2.01))
    assert windows_at(steps, Pose(7.0, 5.0, math.radians(1.01))) == []
    [(begin, end)] = windows_at(steps, Pose(10.0, 5.0, math.radians(-0.99)))
    assert (begin, end) == (pytest.approx(4.99), math.inf)


def test_a_pose_met_while_turning(by_hand: ModuleType) -> None:
    """Turning at 1 rad/s from 3 rad, a cart has the heading -3 rad after 2 pi - 6 s.

    It is within 1 degree of it from 0.01745 s before to 0.01745 s after.
    """
    spin = by_hand.journey("a", Pose(5.0, 5.0, 3.0), (None, (0.0, 0.0, 2.0), 2.0))
    steps = Steps.from_track(by_hand.plan([by_hand.CART], [spin]).tracks["a"], 10.0)
    [(begin, end)] = windows_at(steps, Pose(5.0, 5.0, -3.0))
    met = 2.0 * math.pi - 6.0
    assert begin == pytest.approx(met - math.radians(1.0), abs=1e-6)
    assert end == pytest.approx(met + math.radians(1.0), abs=1e-6)


def test_service_begins_at_rest_and_loads_change_at_its_end(by_hand: ModuleType) -> None:
    """The lifter picks from 0 to 2 s and, arriving at 7 s, drops until 8 s."""
    _, schedule = _motions(by_hand.delivery())
    pick, drop = schedule["a"]
    assert (pick.begin, pick.end) == (0.0, 2.0)
    assert (drop.begin, drop.end) == (pytest.approx(7.0), pytest.approx(8.0))
    assert loads_of(schedule["a"]) == ((2.0, True), (pytest.approx(8.0), False))


def test_two_services_at_one_pose_follow_each_other(by_hand: ModuleType) -> None:
    """Services of 1 s and 2 s at one pose need 3 s there."""
    here = Pose(5.0, 5.0, 0.0)
    tours = {"a": (Visit("t1", here, 1.0), Visit("t2", here, 2.0))}
    for stay, found in ((3.0, []), (2.9, ["service"])):
        trip = by_hand.journey("a", here, stay, by_hand.ahead(1.0))
        assert kinds(by_hand.plan([by_hand.CART], [trip], tours)) == found


def test_a_partner_who_comes_late_is_waited_for(by_hand: ModuleType) -> None:
    """Giver a comes after 2 s, taker b after 1 s; both serve from 2 s to 5 s."""
    _, schedule = _motions(by_hand.hand_over(4.0))
    for name in ("a", "b"):
        [service] = schedule[name]
        assert (service.begin, service.end) == (pytest.approx(2.0), pytest.approx(5.0))


def test_partners_who_wait_for_each_other_for_ever(by_hand: ModuleType) -> None:
    """If a's first visit goes with b's second and a's second with b's first, none begins."""
    here, there = Pose(5.0, 5.0, 0.0), Pose(5.0, 7.0, 0.0)
    tours = {
        "a": (Visit("x", here, 1.0, together=("b",)), Visit("y", here, 1.0, together=("c",))),
        "b": (Visit("z", there, 1.0, together=("c",)), Visit("x", there, 1.0, together=("a",))),
        "c": (
            Visit("y", Pose(5.0, 3.0, 0.0), 1.0, together=("a",)),
            Visit("z", Pose(5.0, 3.0, 0.0), 1.0, together=("b",)),
        ),
    }
    journeys = [by_hand.journey(k, tours[k][0].pose) for k in "abc"]
    found = kinds(by_hand.plan([by_hand.CART] * 3, journeys, tours))
    assert set(found) == {"together"}


def test_unfinished_plans_need_not_make_their_visits(by_hand: ModuleType) -> None:
    """A plan that was stopped is right without its visits, if it says why."""
    plan = by_hand.wrong_plans()["visit--no-trajectory"]
    stopped = replace(plan, status=type(plan.status).STOPPED, reason="the budget ended")
    assert kinds(stopped) == []


def test_the_papers_cost_by_hand(by_hand: ModuleType) -> None:
    """2 + 4 + 2 * (pi / 2 - 1.4) + 2 switches of 3 + 3 s of waiting at 0.1.

    That is 12.3 + 0.3415926... The rotation counts half a body of 2 m per radian.
    """
    plan = by_hand.paper(0.0)
    _, schedule = _motions(plan)
    cost = paper_cost(plan, plan.robots[0], schedule["a"])
    assert cost == pytest.approx(12.3 + 2.0 * (math.pi / 2.0 - 1.4), abs=1e-6)


def test_service_is_not_waiting(by_hand: ModuleType) -> None:
    """Of 3 s at rest, 2 s are service: 1 s costs 0.1 instead of 0.3."""
    plan = by_hand.paper(0.0)
    visit = Visit("t1", Pose(7.0, 5.0, 0.0), 2.0)
    served = replace(plan, tours={"a": (visit,)}, assignment={"a": ("t1",)})
    costs = []
    for record in (plan, served):
        _, schedule = _motions(record)
        costs.append(paper_cost(record, record.robots[0], schedule["a"]))
    assert costs[0] - costs[1] == pytest.approx(0.2, abs=1e-3)


def test_one_thing_wrong_is_said_in_a_sentence(by_hand: ModuleType) -> None:
    """A violation prints its kind, robots, time and place, and the figures."""
    [found] = validate_plan(by_hand.wrong_plans()["visit"])
    assert str(found) == (
        "visit a at 2.000 s, (10.000, 5.011): visit 1 (task t1) is not made: "
        "never within 1 cm and 1 degree of its pose"
    )


def test_a_visit_is_made_once_the_task_that_it_waits_for_is_finished(by_hand: ModuleType) -> None:
    """b stands there from 1 s on; t1 is finished at 5 s, so t2 takes from 5 s to 6 s."""
    _, schedule = _motions(by_hand.in_turn(6.0))
    [(begin, end)] = [(service.begin, service.end) for service in schedule["b"]]
    assert (begin, end) == (pytest.approx(5.0), pytest.approx(6.0))


def test_a_chain_of_tasks_is_followed_to_its_end(by_hand: ModuleType) -> None:
    """Each of three carts serves 2 s, the next one after it; the last one may go at 6 s."""
    names = ("a", "b", "c")
    tours = {
        name: (Visit(name, Pose(2.0, 2.0 + 2 * i, 0.0), 2.0, after=tuple(names[:i][-1:])),)
        for i, name in enumerate(names)
    }
    for stay, found in ((6.0, []), (5.9, ["after"])):
        trips = [
            by_hand.journey(name, tours[name][0].pose, stay, by_hand.ahead(1.0)) for name in names
        ]
        assert kinds(by_hand.plan([by_hand.CART] * 3, trips, tours)) == found


def test_tasks_that_wait_for_each_other_are_never_made(by_hand: ModuleType) -> None:
    """Both carts stand at their poses for ever, and neither may begin."""
    tours = {
        "a": (Visit("t", Pose(2.0, 2.0, 0.0), 1.0, after=("u",)),),
        "b": (Visit("u", Pose(2.0, 5.0, 0.0), 1.0, after=("t",)),),
    }
    trips = [by_hand.journey(name, tour[0].pose) for name, tour in tours.items()]
    assert set(kinds(by_hand.plan([by_hand.CART] * 2, trips, tours))) == {"after"}
