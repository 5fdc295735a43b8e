"""What all tables of a scenario file have in common."""

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, model_validator

from clearway.formats.scenario_error import Misfit, closest

Load = Literal["pick", "drop"]
ZoneKind = Literal["shelf", "station", "charger", "parking", "lane", "one_way", "speed", "closed"]


class Table(BaseModel):
    """A table that knows its keys."""

    model_config = ConfigDict(extra="forbid", strict=True)

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, given: Any) -> Any:
        if isinstance(given, dict) and cls.model_config.get("extra") == "forbid":
            for key in given:
                if key not in cls.model_fields:
                    mend = closest(key, cls.model_fields)
                    raise Misfit("unknown key", mend, given[key], (key,))
        return given


def require_one(table: Table, keys: tuple[str, ...], what: str) -> None:
    """Refuse a table that has none of some keys, or several."""
    given = [key for key in keys if getattr(table, key) is not None]
    if len(given) != 1:
        mend = f"keep one of {', '.join(keys)}" if given else f"add one of {', '.join(keys)}"
        raise Misfit(f"{what} is exactly one of {', '.join(keys)}", mend, given)
