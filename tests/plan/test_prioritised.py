"""What is particular to prioritised planning."""

import random
from dataclasses import replace

import pytest
from tests.plan.random_teams import random_team
from tests.plan.rooms import (
    CARRIER,
    EAST,
    NORTH,
    SOUTH,
    TRAIN,
    WEST,
    block,
    judged,
    record,
    room,
    swapping_corridor,
    team,
    to,
)

from clearway.metrics.paper_cost import paper_cost
from clearway.model import Footprint, Status
from clearway.plan import PrioritisedPlanner, TeamParams
from clearway.protocols import Budget
from clearway.validate import separations

WIDE = Footprint.rectangle(1.6, 1.6)


def door(width):
    """A wall across a room of 16 m x 6 m with a door in its middle."""
    return block(7.5, 0.0, 8.5, 3.0 - width / 2.0), block(7.5, 3.0 + width / 2.0, 8.5, 6.0)


def params(**changes):
    """Parameters with some of the search's, the objective's or the team's changed."""
    chosen = TeamParams()
    for name, value in changes.items():
        group, _, field = name.rpartition("__")
        if group:
            part = getattr(chosen, group)
            setattr(part, field, value)
            setattr(chosen, group, part)
        else:
            setattr(chosen, field, value)
    return chosen


def test_its_parameters_are_those_given():
    """Parameters are the core's own, without a twin."""
    chosen = params(search__weight=1.7, margin=0.25)
    assert PrioritisedPlanner(chosen).params is chosen
    assert chosen.search.weight == 1.7


def test_a_margin_is_kept_between_bodies():
    """Types ask for no clearance; a margin of 0.3 m holds all the same."""
    problem = team(
        room(14.0, 8.0),
        (CARRIER, (2.0, 2.0, EAST), to(12.0, 6.0)),
        (CARRIER, (12.0, 2.0, EAST), to(2.0, 6.0)),
    )
    plan = PrioritisedPlanner(params(margin=0.3))(problem, Budget(expansions=60_000), 0)
    assert plan.status is Status.SOLVED
    ((_, _, gap, _),) = separations(record(problem, plan))
    assert gap >= 0.3 - 2e-3


def test_counters_tell_what_was_done():
    """One search each where nobody is in the way; rip-ups where robots hit each other."""
    easy = team(
        room(12.0, 10.0),
        (CARRIER, (2.0, 2.0, EAST), to(9.0, 2.0)),
        (CARRIER, (2.0, 8.0, EAST), to(9.0, 8.0)),
    )
    counters = PrioritisedPlanner()(easy, Budget(expansions=60_000), 0).counters
    assert (counters["searches"], counters["rip_ups"], counters["restarts"]) == (2, 0, 0)
    assert counters["interrupted"] == 0
    hard = PrioritisedPlanner()(swapping_corridor(), Budget(expansions=60_000), 0).counters
    assert hard["rip_ups"] > 0
    assert hard["searches"] > 2


def test_an_objective_of_length_turns_less_than_one_of_time():
    """Over a dozen goals, plans made for the paper's cost have a tenth less of it."""
    chance = random.Random(1)
    costs = {True: 0.0, False: 0.0}
    for _ in range(12):
        x, y = chance.uniform(3.0, 13.0), chance.uniform(3.0, 7.0)
        goal = to(x, y, chance.choice([EAST, NORTH, WEST, SOUTH]))
        problem = team(room(16.0, 10.0), (CARRIER, (3.0, 3.0, EAST), goal))
        for time in (True, False):
            planner = PrioritisedPlanner(params(objective__time=time, search__weight=1.0))
            plan = planner(problem, Budget(expansions=60_000), 0)
            assert plan.status is Status.SOLVED
            assert judged(problem, plan) == []
            costs[time] += paper_cost(plan.trajectories["a"], CARRIER)
    assert costs[False] <= 0.9 * costs[True]


@pytest.mark.parametrize("seed", range(8))
def test_the_paper_objective_gives_right_plans_too(seed):
    """Small random teams with cost in metres."""
    problem = random_team(seed)
    planner = PrioritisedPlanner(params(objective__time=False))
    plan = planner(problem, Budget(expansions=10_000), seed)
    assert [str(violation) for violation in judged(problem, plan)] == []


def test_the_reason_names_everybody_without_a_plan():
    """A person reads who is left and why."""
    plan = PrioritisedPlanner()(swapping_corridor(), Budget(expansions=2_000), 0)
    assert plan.status is Status.STOPPED
    for name in plan.concerned:
        assert name in plan.reason


def test_the_empty_body_proves_nothing_about_a_narrower_loaded_one():
    """Folded with its load, a robot could pass a door that is too narrow for it when empty.

    It only goes straight and so cannot get to a goal beside its line: a stop, not a proof.
    """
    folding = replace(TRAIN, name="folding", footprint=WIDE, loaded_footprint=TRAIN.footprint)
    problem = team(
        room(16.0, 6.0, *door(0.8)),
        (folding, (3.0, 3.0, EAST), to(5.0, 3.0, load="pick"), to(13.0, 4.0)),
    )
    plan = PrioritisedPlanner()(problem, Budget(expansions=60_000), 0)
    assert plan.status is Status.STOPPED
