"""Published systems as compositions: each page chooses parts."""

from clearway.systems.choose import choose_system
from clearway.systems.hierarchical import HierarchicalSettings, hierarchical
from clearway.systems.settings import SettingsError
from clearway.systems.solve import IllegalScenario, Planned, Run, judge_plan, make_plan, solve

__all__ = [
    "HierarchicalSettings",
    "IllegalScenario",
    "Planned",
    "Run",
    "SettingsError",
    "choose_system",
    "hierarchical",
    "judge_plan",
    "make_plan",
    "solve",
]
