"""Clearway assigns work to mixed robot fleets in confined sites and plans how they all move.

``solve`` does a scenario from file to judged plan; ``read_scenario`` and ``validate_plan``
are its first and last step on their own.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from clearway.formats.plan_file import read_plan, write_plan
    from clearway.formats.scenario_file import parse_scenario, read_scenario
    from clearway.protocols import Budget
    from clearway.systems.solve import Run, solve
    from clearway.validate import validate_plan

_HOMES = {
    "Budget": "clearway.protocols",
    "Run": "clearway.systems.solve",
    "parse_scenario": "clearway.formats.scenario_file",
    "read_plan": "clearway.formats.plan_file",
    "read_scenario": "clearway.formats.scenario_file",
    "solve": "clearway.systems.solve",
    "validate_plan": "clearway.validate",
    "write_plan": "clearway.formats.plan_file",
}

__all__ = [
    "Budget",
    "Run",
    "parse_scenario",
    "read_plan",
    "read_scenario",
    "solve",
    "validate_plan",
    "write_plan",
]


def __getattr__(name: str) -> Any:
    """Import on first use, so that importing clearway costs nothing."""
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module 'clearway' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
