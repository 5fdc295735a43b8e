"""Sites of the corridor experiment: as the paper describes them, and always solvable poses."""

import math
from itertools import pairwise

import pytest

from clearway.validate.legality import check_scenario
from clearway.world.corridor import random_corridor
from clearway.world.shapes import body_shape


@pytest.mark.parametrize("robots", [1, 4, 7, 16])
@pytest.mark.parametrize("seed", range(5))
def test_starts_and_targets_are_where_they_should_be(robots, seed):
    """Half on each side, targets on the middle line in slots 3.6 m apart, all of it legal."""
    scenario = random_corridor(robots, seed)
    assert check_scenario(scenario)
    left = [r.start for r in scenario.robots if 1.5 <= r.start.x <= 8.5]
    right = [r.start for r in scenario.robots if 91.5 <= r.start.x <= 98.5]
    assert (len(left), len(right)) == (math.ceil(robots / 2), robots // 2)
    goals = [order.task.visits[0].pose for order in scenario.orders]
    assert {goal.x for goal in goals} == {50.0}
    assert {goal.theta for goal in goals} <= {0.0, math.pi}
    rows = sorted(goal.y for goal in goals)
    assert rows[0] >= 3.0 and rows[-1] <= 57.0
    assert all(b - a >= 3.6 - 1e-9 for a, b in pairwise(rows))
    assert [order.task.robot for order in scenario.orders] == [r.id for r in scenario.robots]


@pytest.mark.parametrize("seed", range(5))
def test_bodies_keep_half_a_metre_at_their_starts(seed):
    """As in the warehouse of the assignment studies."""
    scenario = random_corridor(16, seed)
    bodies = [body_shape(scenario.type_of(r).footprint, r.start) for r in scenario.robots]
    gaps = [a.gap(b) for i, a in enumerate(bodies) for b in bodies[:i]]
    assert min(gaps) >= 0.5 - 1e-9


def test_seeds_repeat_and_differ():
    """One seed, one site."""
    assert random_corridor(8, 3) == random_corridor(8, 3)
    assert random_corridor(8, 3).robots != random_corridor(8, 4).robots


def test_targets_are_shuffled():
    """Robots of both sides have targets all along the line, in no order."""
    rows = [o.task.visits[0].pose.y for o in random_corridor(16, 0).orders]
    assert len(set(rows)) == 16
    assert rows != sorted(rows)


@pytest.mark.parametrize("robots", [0, 17])
def test_more_robots_than_slots_are_refused(robots):
    """The number is named."""
    with pytest.raises(ValueError, match=f"1 to 16 robots, not {robots}"):
        random_corridor(robots, 0)
