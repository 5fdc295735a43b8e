"""Clearway assigns work to mixed robot fleets in confined sites and plans how they all move.

``solve`` does a scenario from file to judged plan, ``simulate`` runs it through time;
``read_scenario``, ``validate_plan`` and ``validate_trace`` are first and last steps on their own.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from clearway.formats.plan_file import read_plan, write_plan
    from clearway.formats.scenario_file import parse_scenario, read_scenario
    from clearway.formats.trace_file import read_trace
    from clearway.protocols import Budget
    from clearway.systems.simulate import Simulated, simulate
    from clearway.systems.solve import Run, solve
    from clearway.validate import validate_plan
    from clearway.validate.trace_judge import validate_trace

_HOMES = {
    "Budget": "clearway.protocols",
    "Run": "clearway.systems.solve",
    "Simulated": "clearway.systems.simulate",
    "parse_scenario": "clearway.formats.scenario_file",
    "read_plan": "clearway.formats.plan_file",
    "read_scenario": "clearway.formats.scenario_file",
    "read_trace": "clearway.formats.trace_file",
    "simulate": "clearway.systems.simulate",
    "solve": "clearway.systems.solve",
    "validate_plan": "clearway.validate",
    "validate_trace": "clearway.validate.trace_judge",
    "write_plan": "clearway.formats.plan_file",
}

__all__ = [
    "Budget",
    "Run",
    "Simulated",
    "parse_scenario",
    "read_plan",
    "read_scenario",
    "read_trace",
    "simulate",
    "solve",
    "validate_plan",
    "validate_trace",
    "write_plan",
]


def __getattr__(name: str) -> Any:
    """Import on first use, so that importing clearway costs nothing."""
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module 'clearway' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
