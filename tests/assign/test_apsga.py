"""How the coefficients of APSGA change over a run."""

import json
import math

import pytest
from tests.assign.conftest import ORACLES, random_problem

from clearway.assign import AdaptationParams, Apsga, ApsgaParams, Psga, SwarmParams

MICRO = json.loads(ORACLES.read_text())["micro"]


@pytest.mark.parametrize("case", MICRO["inertia"])
def test_inertia_falls_and_rises_with_agreement(case):
    """The published values, above w_max at the start as printed (EA-5)."""
    params = AdaptationParams(case["w_max"], case["w_min"], case["gamma"])
    step = params.coefficients(case["t"] / case["T"], case["Fg"], case["Fa"])
    assert step.inertia == pytest.approx(case["omega"])


@pytest.mark.parametrize("case", MICRO["learning"])
def test_a_particle_listens_to_itself_first_and_to_the_swarm_later(case):
    params = AdaptationParams(c_max=case["c_max"], c_min=case["c_min"])
    step = params.coefficients(case["t"] / case["T"], 1.0, 1.0)
    assert step.cognitive == pytest.approx(case["c1"])
    assert step.social == pytest.approx(case["c2"])


@pytest.mark.parametrize(("progress", "inertia"), [(0.0, 1.0), (0.1, 1.0), (0.5, 0.7), (1.0, 0.2)])
def test_inertia_is_confined_on_demand(progress, inertia):
    """Of 1.2, 1.1, 0.7 and 0.2 at a swarm that agrees, what is above w_max = 1 is cut."""
    params = AdaptationParams(is_confined=True)
    assert params.coefficients(progress, 5.0, 5.0).inertia == pytest.approx(inertia)


def test_a_site_without_distances_is_as_good_as_its_best():
    """Where everything costs nothing, best and mean are both 0: their ratio counts as 1."""
    assert AdaptationParams().coefficients(0.5, 0.0, 0.0).inertia == pytest.approx(0.7)


def test_adaptation_makes_the_difference_to_psga():
    """The swarms begin alike and then go different ways."""
    problem = random_problem(1, 4, 16)
    adaptive, constant = Apsga().trace(problem, 5).history, Psga().trace(problem, 5).history
    assert adaptive[0] == constant[0]
    assert adaptive != constant


def test_confining_the_inertia_changes_the_run():
    problem = random_problem(1, 4, 16)
    confined = ApsgaParams(adaptation=AdaptationParams(is_confined=True))
    assert Apsga(confined).trace(problem, 5).history != Apsga().trace(problem, 5).history


def test_defaults_are_the_published_ones():
    """N, T, w, gamma and c of the parameter table."""
    assert ApsgaParams().swarm == SwarmParams(particles=30, iterations=200)
    assert ApsgaParams().adaptation == AdaptationParams(1.0, 0.0, 0.2, 2.5, 0.5, False)


@pytest.mark.parametrize("value", [-0.1, math.nan, math.inf])
@pytest.mark.parametrize("name", ["w_max", "w_min", "gamma", "c_max", "c_min"])
def test_wrong_parameters_are_named(name, value):
    with pytest.raises(ValueError, match=name):
        AdaptationParams(**{name: value})


@pytest.mark.parametrize(
    ("changes", "told"), [({"w_min": 2.0}, "w_min"), ({"c_min": 3.0}, "c_min")]
)
def test_limits_are_in_order(changes, told):
    with pytest.raises(ValueError, match=f"{told} must be at most"):
        AdaptationParams(**changes)
