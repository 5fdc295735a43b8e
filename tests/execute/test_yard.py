"""A planned yard, driven by robots that stop and are slow."""

from pathlib import Path

import pytest
from tests.execute.late import Late

from clearway import read_scenario, solve
from clearway.execute import BodyConflicts, RightOfWay, TrackPlan
from clearway.model import Commitment, Trip

SCENARIOS = Path(__file__).parents[2] / "scenarios"


@pytest.fixture(scope="module")
def yard():
    """Commitments and types of the robots of yard-30, planned."""
    scenario = read_scenario(SCENARIOS / "yard-30.toml")
    plan = solve(scenario, seed=0).plan
    commitments = {
        robot: Commitment(robot, path, Trip(robot, tuple(plan.tours[robot]), "order"))
        for robot, path in plan.trajectories.items()
    }
    return commitments, {robot.id: scenario.type_of(robot) for robot in scenario.robots}


@pytest.mark.parametrize("seed", range(3))
def test_all_arrive_and_nobody_is_touched(yard, seed):
    """30 robots on a yard of 60 m; stops of up to 15 s, every third slow or not heard of."""
    commitments, types = yard
    conflicts = BodyConflicts(types)
    ledger = RightOfWay(conflicts)
    fleet = Late(commitments, ledger, seed)
    while not fleet.is_done:
        fleet.step()
        assert fleet.now < 600_000
        assert ledger.overlapping(conflicts.overlap) == ()
    assert fleet.overlaps(types) == []


def test_robots_on_time_lose_next_to_nothing(yard):
    """Granted what they may every 100 ms, they arrive at most 200 ms after the plan."""
    commitments, types = yard
    fleet = Late(commitments, RightOfWay(BodyConflicts(types)), 0, stops=0.0, slow=0.0, lost=0.0)
    while not fleet.is_done:
        fleet.step()
        for robot, commitment in commitments.items():
            if fleet.now >= commitment.trajectory.end + 200:
                assert fleet.progress[robot] >= commitment.trajectory.end


def test_without_the_order_of_passage_they_collide(yard):
    commitments, types = yard
    fleet = Late(commitments, TrackPlan(), 0)
    while not fleet.is_done:
        fleet.step()
    assert fleet.overlaps(types) != []


def test_what_is_left_out_on_purpose_is_caught(yard):
    """Granted as far as they may, two robots that know of no conflict have reserves that meet.

    Of the pairs in which somebody waits, five are tried.
    """
    commitments, types = yard
    whole = BodyConflicts(types)
    names = sorted(commitments)
    found = [
        (one, other, steps)
        for k, one in enumerate(names)
        for other in names[k + 1 :]
        for steps in (whole(commitments[one], commitments[other])[0],)
        if steps
    ]
    for one, other, steps in found[:: len(found) // 5][:5]:
        ledger = RightOfWay(lambda *_: ((), ()), look_ahead=100_000)
        ledger.commit({name: commitments[name] for name in (one, other)}, 0)
        assert ledger.grant(one) > steps[0].at
        assert ledger.grant(other) >= steps[0].passed
        assert ledger.overlapping(whole.overlap) == ((one, other),)
        kept = RightOfWay(whole, look_ahead=100_000)
        kept.commit({name: commitments[name] for name in (one, other)}, 0)
        kept.grant(one)
        kept.grant(other)
        assert kept.overlapping(whole.overlap) == ()
