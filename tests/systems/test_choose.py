"""Settings of a system are checked before anything runs."""

from dataclasses import replace
from typing import get_args

import pytest
from tests.systems.sites import hall

from clearway.assign import AutomaticAssigner, RandomAssigner, build
from clearway.coordinate.value import paper
from clearway.plan import ConflictBasedSearch, ConflictParams, PrioritisedPlanner
from clearway.protocols import Weights, check_routes
from clearway.systems import HierarchicalSettings, SettingsError, choose_system


def chosen(**settings):
    return choose_system(replace(hall(), settings=settings))


def test_without_settings_the_defaults_hold():
    """The parameters of the system are its settings, one by one."""
    system = chosen()
    assert system.name == "hierarchical"
    assert isinstance(system.assign, AutomaticAssigner)
    assert isinstance(system.plan, PrioritisedPlanner)
    assert set(system.parameters) == set(HierarchicalSettings.__dataclass_fields__)


def test_settings_reach_their_parts():
    """Assigner, weights, rounds, search weight and objective."""
    system = chosen(
        assign="random", turning=0.0, tardiness=3.0, rounds=2, weight=2.5, objective="paper"
    )
    assert isinstance(system.assign, RandomAssigner)
    assert system.weights == Weights(1.0, 1.0, 0.0, 3.0)
    assert (system.rounds, system.value) == (2, paper)
    assert system.plan.params.search.weight == 2.5
    assert not system.plan.params.objective.time
    assert chosen().plan.params.objective.time


@pytest.mark.parametrize("name", get_args(HierarchicalSettings.__annotations__["assign"]))
@pytest.mark.parametrize("even", [False, True])
def test_every_assigner_has_its_name(name, even):
    """Each of them shares out the work of the hall."""
    system = chosen(assign=name, even=even)
    problem = build(hall())
    assert system.assign.unsupported(problem) == ()
    check_routes(problem, system.assign(problem, 0))


@pytest.mark.parametrize("mode", ["adaptive", "bounded", "optimal"])
def test_search_over_conflicts_is_chosen_by_its_mode(mode):
    """With the objective and the factors given."""
    plan = chosen(plan=mode, factor=1.5, weight=1.7, objective="paper").plan
    assert isinstance(plan, ConflictBasedSearch)
    assert plan.params == ConflictParams(mode=mode, factor=1.5, xi=1.7, paper_cost=True)
    assert not chosen(plan=mode).plan.params.paper_cost


def test_a_whole_number_serves_where_a_number_is_wanted():
    """TOML tells 2 from 2.0; people do not."""
    assert chosen(weight=2).plan.params.search.weight == 2.0


@pytest.mark.parametrize(
    ("settings", "key", "mend"),
    [
        ({"wieght": 2.0}, "system.wieght", "weight"),
        ({"weight": "2.0"}, "system.weight", "number"),
        ({"park": "sometimes"}, "system.park", "never"),
        ({"even": 1}, "system.even", "boolean"),
        ({"weight": 0.0}, "system.weight", "above 0"),
        ({"weight": -2.0}, "system.weight", "above 0"),
        ({"turning": -1.0}, "system.turning", "0 or above"),
        ({"tardiness": -1.0}, "system.tardiness", "0 or above"),
        ({"travel": "flight"}, "system.travel", "planned"),
        ({"rounds": -1}, "system.rounds", "0 to 100"),
        ({"assign": "simplex"}, "system.assign", "memetic"),
        ({"plan": "magic"}, "system.plan", "adaptive"),
        ({"factor": 0.9}, "system.factor", "1 or above"),
        ({"objective": "makespan", "plan": "optimal"}, "system.objective", "paper"),
        ({"weight": 0.5, "plan": "adaptive"}, "system.weight", "1 or above"),
    ],
)
def test_a_setting_that_does_not_fit_is_named(settings, key, mend):
    """Key, value and what would do instead."""
    with pytest.raises(SettingsError) as error:
        chosen(**settings)
    assert error.value.key == key
    assert repr(next(iter(settings.values()))) in str(error.value)
    assert mend in error.value.mend


def test_an_unknown_system_is_told_which_there_are():
    """The known ones are listed."""
    with pytest.raises(SettingsError, match=r"system\.name.*'hierarchic'.*hierarchical"):
        choose_system(replace(hall(), system="hierarchic"))
