"""The system that a scenario names, with its settings checked."""

import json
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from typing import Any

from pydantic import TypeAdapter, ValidationError

from clearway.coordinate import Lifelong, System
from clearway.model import Scenario
from clearway.systems.bidirectional import BidirectionalSettings, bidirectional
from clearway.systems.hierarchical import HierarchicalSettings, hierarchical
from clearway.systems.hierarchical_lifelong import hierarchical_lifelong
from clearway.systems.settings import SettingsError

SETTINGS: Mapping[str, Any] = {
    "hierarchical": HierarchicalSettings,
    "bidirectional": BidirectionalSettings,
}
# Systems that plan once for all orders, and those that do orders as they come.
ONCE: Mapping[str, Callable[[Any], System]] = {"hierarchical": hierarchical}
LIFELONG: Mapping[str, Callable[[Any], Lifelong]] = {
    "hierarchical": hierarchical_lifelong,
    "bidirectional": bidirectional,
}


def choose_system(scenario: Scenario) -> System:
    """Return the system of a scenario that plans once.

    Raises
    ------
    SettingsError
        If the system is unknown or only runs through time, or a setting is unknown or has a wrong
        value.
    """
    if scenario.system in LIFELONG and scenario.system not in ONCE:
        mend = f"it runs through time: use clearway simulate; planned at once: {', '.join(ONCE)}"
        raise SettingsError("system.name", scenario.system, mend)
    return ONCE[_known(scenario)](settings_of(scenario))


def choose_lifelong(scenario: Scenario) -> Lifelong:
    """Return the system of a scenario that does orders as they come.

    Raises
    ------
    SettingsError
        As `choose_system`.
    """
    return LIFELONG[_known(scenario)](settings_of(scenario))


def settings_of(scenario: Scenario) -> Any:
    """Return the checked settings of a scenario's system.

    Raises
    ------
    SettingsError
        If the system is unknown, or a setting is unknown or has a wrong value.
    """
    settings_type = SETTINGS[_known(scenario)]
    known = list(settings_type.__dataclass_fields__)
    for key, value in scenario.settings.items():
        if key not in known:
            meant = get_close_matches(key, known, n=1)
            guess = f"did you mean {meant[0]!r}? " if meant else ""
            mend = f"{scenario.system} has no such setting; {guess}known: {', '.join(known)}"
            raise SettingsError(f"system.{key}", value, mend)
    try:
        given = json.dumps(dict(scenario.settings))
        return TypeAdapter(settings_type).validate_json(given, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        cause = first.get("ctx", {}).get("error")
        if isinstance(cause, SettingsError):
            raise cause from None
        key = ".".join(str(part) for part in first["loc"])
        raise SettingsError(f"system.{key}", first["input"], first["msg"]) from None


def _known(scenario: Scenario) -> str:
    if scenario.system not in SETTINGS:
        raise SettingsError("system.name", scenario.system, f"known: {', '.join(SETTINGS)}")
    return scenario.system
