"""Trips on lanes: always possible, never two robots in a cell."""

import pytest
from tests.plan.lane_traffic import LAYOUTS, Traffic

from clearway.model import Layout
from clearway.validate import validate_plan


@pytest.mark.parametrize("rules", ["waiting", "search"])
@pytest.mark.parametrize("turn_seconds", [0.0, 1.0])
@pytest.mark.parametrize("rule", LAYOUTS)
def test_random_trips_all_end_and_no_bodies_meet(rule, turn_seconds, rules):
    """Twenty robots on every layout, judged on their true bodies."""
    traffic = Traffic(Layout(rule), 20, turn_seconds, seed=1, rules=rules)
    traffic.run(150)
    assert validate_plan(traffic.record()) == []
