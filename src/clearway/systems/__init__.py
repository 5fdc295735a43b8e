"""Published systems as compositions: each page chooses parts."""

from clearway.systems.choose import SettingsError, choose_system
from clearway.systems.hierarchical import HierarchicalSettings, hierarchical
from clearway.systems.solve import IllegalScenario, Run, solve

__all__ = [
    "HierarchicalSettings",
    "IllegalScenario",
    "Run",
    "SettingsError",
    "choose_system",
    "hierarchical",
    "solve",
]
