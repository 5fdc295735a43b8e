"""How particles fly."""

import math

import numpy as np
import pytest

from clearway.assign import Coefficients, FlightParams
from clearway.assign.flight import fly

HERE = np.array([[0, 1, 2, 3, 4, 5, 6, 7]])
LEFT = HERE[:, ::-1]


def step(params, coefficients, velocities, bests=HERE, leader=HERE[0], seed=0):
    rng = np.random.default_rng(seed)
    return fly(rng, params, coefficients, HERE, velocities, bests, leader)


def test_the_printed_position_follows_the_velocity_before():
    """Nothing pulls: half of a velocity of 2 is kept, and the printed rule moves by all of it."""
    before = np.full(HERE.shape, 2.0)
    drift = Coefficients(inertia=0.5, cognitive=0.0, social=0.0)
    printed, kept = step(FlightParams("printed"), drift, before)
    textbook, _ = step(FlightParams("textbook"), drift, before)
    assert (kept == 1.0).all()
    assert printed[0].tolist() == [2, 3, 4, 5, 6, 7, 7, 7]
    assert textbook[0].tolist() == [1, 2, 3, 4, 5, 6, 7, 7]


@pytest.mark.parametrize("pull", ["cognitive", "social"])
def test_each_coordinate_is_drawn_by_a_random_share(pull):
    """A best at the mirrored place pulls by between none and c times the way there, unevenly."""
    c = Coefficients(**({"inertia": 0.0, "cognitive": 0.0, "social": 0.0} | {pull: 2.0}))
    bests, leader = (LEFT, HERE[0]) if pull == "cognitive" else (HERE, LEFT[0])
    _, velocities = step(FlightParams(), c, np.zeros(HERE.shape), bests, leader)
    share = velocities / (2.0 * (LEFT - HERE))
    assert ((share > 0.0) & (share < 1.0)).all()
    assert np.unique(share).size == share.size


def test_both_bests_pull_by_shares_of_their_own():
    """Equal pulls to opposite sides would cancel if they were drawn by the same share."""
    c = Coefficients(inertia=0.0, cognitive=1.0, social=1.0)
    leader = (2 * HERE - LEFT)[0]
    _, velocities = step(FlightParams(), c, np.zeros(HERE.shape), LEFT, leader)
    assert (np.abs(velocities) > 1e-3).all()


def test_positions_stay_among_the_tasks():
    """However fast, a coordinate ends at the first or the last number."""
    for speed, end in ((100.0, 7.0), (-100.0, 0.0)):
        moved, _ = step(FlightParams(), Coefficients(), np.full(HERE.shape, speed))
        assert (moved == end).all()


def test_velocity_is_bounded_on_demand():
    """A velocity of 100 is kept in full without a bound, and is 3 with a bound of 3."""
    keep = Coefficients(1.0, 0.0, 0.0)
    before = np.full(HERE.shape, 100.0)
    assert (step(FlightParams(), keep, before)[1] == 100.0).all()
    assert (step(FlightParams(velocity_bound=3.0), keep, before)[1] == 3.0).all()
    assert (step(FlightParams(velocity_bound=3.0), keep, -before)[1] == -3.0).all()


@pytest.mark.parametrize("value", [-1.0, math.nan, math.inf])
@pytest.mark.parametrize("name", ["inertia", "cognitive", "social"])
def test_wrong_coefficients_are_named(name, value):
    with pytest.raises(ValueError, match=name):
        Coefficients(**{name: value})


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"position": "new"}, "position must be printed or textbook, got 'new'"),
        ({"velocity_bound": -1.0}, "velocity_bound must be 0 or above"),
        ({"velocity_bound": math.nan}, "velocity_bound"),
    ],
)
def test_wrong_choices_are_named(changes, told):
    with pytest.raises(ValueError, match=told):
        FlightParams(**changes)
