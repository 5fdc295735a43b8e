"""What holds for every plan of every generated instance: about 2,000 small ones of all kinds."""

import itertools
from collections import Counter

import pytest
from benchmarks.property import draw, examine, plan

from clearway.world.fleets import FLEETS
from clearway.world.sites import KINDS

# Trailers are drawn slowly.
SEEDS = {**dict.fromkeys(KINDS, 70), "yards": 8}
CELLS = list(itertools.product(KINDS, FLEETS))
EXPANSIONS = 3_000


def instances(kind, fleet, count):
    """Two to four robots on 18 to 26 m, as far as they fit."""
    drawn = (draw(kind, fleet, seed, range(18, 27), (2, 2, 3, 3, 4)) for seed in range(count))
    return [scenario for scenario in drawn if scenario]


@pytest.fixture(scope="module")
def tally():
    """Instances and those solved, over all cells."""
    return Counter()


@pytest.mark.parametrize(("kind", "fleet"), CELLS)
def test_every_plan_is_right(kind, fleet, tally):
    """Solved or not, the judge finds nothing wrong, and the bound is below what was found."""
    outcomes = [examine(scenario, EXPANSIONS) for scenario in instances(kind, fleet, SEEDS[kind])]
    tally["instances"] += len(outcomes)
    tally["solved"] += sum(outcome.solved for outcome in outcomes)
    assert {outcome.name: outcome.wrong for outcome in outcomes if outcome.wrong} == {}


def test_nearly_all_are_solved(tally):
    """At least 95 of 100, of as many as were drawn."""
    print(f"{tally['instances']} instances, {tally['solved']} solved")
    assert tally["instances"] >= 1_900
    assert tally["solved"] >= 0.95 * tally["instances"]


@pytest.mark.parametrize(("kind", "fleet"), CELLS)
def test_the_same_seed_gives_the_same_plan(kind, fleet):
    """Piece by piece, finished or not."""
    for scenario in instances(kind, fleet, 3):
        assert plan(scenario, EXPANSIONS) == plan(scenario, EXPANSIONS)
