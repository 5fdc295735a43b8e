"""The system that a scenario names, with its settings checked."""

import json

from pydantic import TypeAdapter, ValidationError

from clearway.coordinate import System
from clearway.model import Scenario
from clearway.systems.hierarchical import HierarchicalSettings, hierarchical
from clearway.systems.settings import SettingsError

SYSTEMS = {"hierarchical": (HierarchicalSettings, hierarchical)}


def choose_system(scenario: Scenario) -> System:
    """Return the system of a scenario.

    Raises
    ------
    SettingsError
        If the system is unknown, or a setting is unknown or has a wrong value.
    """
    if scenario.system not in SYSTEMS:
        raise SettingsError("system.name", scenario.system, f"known: {', '.join(SYSTEMS)}")
    settings_type, build = SYSTEMS[scenario.system]
    known = list(settings_type.__dataclass_fields__)
    for key, value in scenario.settings.items():
        if key not in known:
            raise SettingsError(f"system.{key}", value, f"unknown; known: {', '.join(known)}")
    try:
        given = json.dumps(dict(scenario.settings))
        settings = TypeAdapter(settings_type).validate_json(given, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        cause = first.get("ctx", {}).get("error")
        if isinstance(cause, SettingsError):
            raise cause from None
        key = ".".join(str(part) for part in first["loc"])
        raise SettingsError(f"system.{key}", first["input"], first["msg"]) from None
    return build(settings)
