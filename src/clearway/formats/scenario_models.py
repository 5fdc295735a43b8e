"""The tables of a scenario file, key by key, as pydantic models."""

from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    WithJsonSchema,
    model_validator,
)
from pydantic.config import JsonDict

from clearway.formats.scenario_dump import FORMAT
from clearway.formats.scenario_error import Misfit, closest
from clearway.formats.scenario_fields import (
    DiscField,
    FootprintField,
    Name,
    PolygonField,
    PoseField,
    Seconds,
    WallField,
)
from clearway.model.robot import FOUR_WHEEL_MODES, Kinematics
from clearway.motion import MODELS, models_for


def _check_mode(mode: str) -> str:
    if mode not in FOUR_WHEEL_MODES:
        raise Misfit("is not a known mode", closest(mode, FOUR_WHEEL_MODES), mode)
    return mode


Mode = Annotated[
    str,
    AfterValidator(_check_mode),
    WithJsonSchema({"type": "string", "enum": list(FOUR_WHEEL_MODES)}),
]
ZoneKind = Literal["shelf", "station", "charger", "parking", "lane", "one_way", "speed", "closed"]
Load = Literal["pick", "drop"]
Speed = Annotated[float, Field(gt=0.0, le=50.0)]
Acceleration = Annotated[float, Field(gt=0.0, le=50.0)]


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


def _require_one(table: Table, keys: tuple[str, ...], what: str) -> None:
    given = [key for key in keys if getattr(table, key) is not None]
    if len(given) != 1:
        mend = f"keep one of {', '.join(keys)}" if given else f"add one of {', '.join(keys)}"
        raise Misfit(f"{what} is exactly one of {', '.join(keys)}", mend, given)


class ObstacleTable(Table):
    """A fixed obstacle: one of polygon, disc and wall."""

    polygon: PolygonField | None = None
    disc: DiscField | None = None
    wall: WallField | None = None
    blocks: list[str] = Field(
        default=[],
        description='Whom it stops, "TYPE" or "TYPE:loaded"; empty: everyone.',
        examples=[["carrier:loaded"]],
    )

    @model_validator(mode="after")
    def _check(self) -> "ObstacleTable":
        _require_one(self, ("polygon", "disc", "wall"), "an obstacle")
        return self


class ZoneTable(Table):
    """A named area with a use or a rule."""

    name: Name
    kind: ZoneKind
    polygon: PolygonField
    pose: PoseField | None = Field(
        default=None,
        description="Where a robot stands to use it; needed for parking, station and charger.",
    )
    value: float | None = Field(
        default=None, description="Speed limit (m/s) of a speed zone, direction (rad) of one_way."
    )

    @model_validator(mode="after")
    def _check(self) -> "ZoneTable":
        if self.kind in ("parking", "station", "charger") and self.pose is None:
            mend = "add pose = [x, y, theta], where a robot stands to use it"
            raise Misfit(f"a zone of kind {self.kind} needs a pose", mend, self.name)
        if self.kind in ("speed", "one_way") and self.value is None:
            unit = "m/s" if self.kind == "speed" else "rad"
            raise Misfit(
                f"a zone of kind {self.kind} needs a value", f"add value ({unit})", self.name
            )
        if self.kind == "speed" and self.value is not None and not 0.0 < self.value <= 50.0:
            what = "a speed limit must be above 0 and at most 50"
            raise Misfit(what, "write it in m/s", self.value, ("value",))
        if self.kind == "one_way" and self.value is not None and abs(self.value) > 6.2832:
            raise Misfit(
                "must be at most a full turn, 2 pi", "write it in rad", self.value, ("value",)
            )
        return self


class SiteTable(Table):
    """The place: bounds, border, obstacles and zones."""

    bounds: PolygonField
    border: Literal["closed", "open"] = Field(
        default="closed", description="Whether bodies must stay inside the bounds."
    )
    obstacles: list[ObstacleTable] = []
    zones: list[ZoneTable] = []

    @model_validator(mode="after")
    def _check(self) -> "SiteTable":
        for axis in (0, 1):
            values = [point[axis] for point in self.bounds]
            if max(values) - min(values) > 100_000.0:
                what = "a site is at most 100 km wide"
                mend = "write coordinates in m (not mm)"
                raise Misfit(what, mend, max(values) - min(values), ("bounds",))
        return self


class LimitsTable(Table):
    """What a robot type cannot exceed; a limit left out does not bind."""

    speed: Speed = Field(description="Top speed (m/s).", examples=[2.5])
    reverse_speed: Annotated[float, Field(ge=0.0, le=50.0)] | None = Field(
        default=None, description="Top speed backwards (m/s); 0 forbids reversing."
    )
    yaw_rate: Annotated[float, Field(gt=0.0, le=20.0)] | None = Field(
        default=None, description="Turning rate (rad/s).", examples=[0.57]
    )
    turning_radius: Annotated[float, Field(gt=0.0, le=100.0)] | None = Field(
        default=None, description="Least radius of an arc (m).", examples=[3.0]
    )
    acceleration: Acceleration | None = Field(default=None, description="m/s^2.")
    deceleration: Acceleration | None = Field(default=None, description="m/s^2.")


class BatteryTable(Table):
    """Energy store."""

    capacity: Annotated[float, Field(gt=0.0, le=1e9)] = Field(
        description="Running time on a full charge (s).", examples=[14400.0]
    )
    reserve: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(
        default=0.2, description="Fraction of capacity below which a charger is sought."
    )


class RobotTypeTable(Table):
    """What all robots of one make share."""

    kinematics: Kinematics = Field(examples=["four_wheel"])
    footprint: FootprintField
    loaded_footprint: FootprintField | None = None
    clearance: Annotated[float, Field(ge=0.0, le=10.0)] = Field(
        default=0.0, description="Gap planned for on top of the footprint (m)."
    )
    limits: LimitsTable
    motion: str | None = Field(
        default=None,
        description="Name of the motion model; absent: the one for its kinematics.",
        examples=list(MODELS),
    )
    modes: list[Mode] = Field(
        default=[], description="Modes that may be used (four_wheel only); empty: all."
    )
    mode_switch: Annotated[float, Field(ge=0.0, le=3600.0)] = Field(
        default=0.0, description="Time at rest that a change of mode takes (s)."
    )
    capacity: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        default=1, description="Loads carried at once."
    )
    capabilities: list[Name] = Field(default=[], examples=[["lift"]])
    battery: BatteryTable | None = None

    @model_validator(mode="after")
    def _check(self) -> "RobotTypeTable":
        if self.modes and self.kinematics != "four_wheel":
            what = f"a {self.kinematics} robot has no modes"
            raise Misfit(
                what, "remove modes or set kinematics = 'four_wheel'", self.modes, ("modes",)
            )
        known = models_for(self.kinematics)
        if self.motion not in (None, *known):
            what = f"is no motion model of {self.kinematics} robots"
            raise Misfit(what, closest(self.motion, known), self.motion, ("motion",))
        return self


class RobotTable(Table):
    """One robot and where it starts."""

    id: Name = Field(examples=["r1"])
    type: str = Field(examples=["carrier"])
    start: PoseField
    start_speed: Annotated[float, Field(ge=-50.0, le=50.0)] = Field(
        default=0.0, description="Speed at the start (m/s)."
    )
    start_mode: str | None = None


class VisitTable(Table):
    """One stop: a pose or a station with a pose."""

    pose: PoseField | None = None
    station: str | None = Field(default=None, description="Name of a zone that has a pose.")
    service: Seconds = Field(default=0.0, description="Time to stand there (s).")
    load: Load | None = Field(default=None, description="Takes effect at the end of the service.")
    needs: Name | None = Field(default=None, description="Capability the robot must have.")
    together: list[str] = Field(
        default=[], description="Robots that stand at their own poses in the same interval."
    )

    @model_validator(mode="after")
    def _check(self) -> "VisitTable":
        _require_one(self, ("pose", "station"), "a visit's place")
        return self


class TaskTable(Table):
    """Visits that one robot does in order; a task of one visit may hold the visit's keys."""

    id: Name = Field(examples=["t1"])
    visits: list[VisitTable] | None = Field(default=None, min_length=1)
    pose: PoseField | None = None
    station: str | None = None
    service: Seconds | None = None
    load: Load | None = None
    needs: Name | None = None
    together: list[str] | None = None
    robot: str | None = Field(default=None, description="The only robot that may do it.")
    release: Seconds = Field(default=0.0, description="Not before (s).")
    due: Seconds | None = Field(default=None, description="To be done by (s).")
    priority: float = Field(default=0.0, description="Larger is more urgent.")
    after: list[str] = Field(
        default=[],
        description="Ids of tasks that must be finished before its first visit is served.",
        examples=[["t1"]],
    )

    @model_validator(mode="after")
    def _check(self) -> "TaskTable":
        _require_one(self, ("visits", "pose", "station"), "a task's place")
        if self.visits is not None:
            for key in ("service", "load", "needs", "together"):
                if getattr(self, key) is not None:
                    mend = f"move {key} into a visit"
                    raise Misfit("does not stand beside visits", mend, getattr(self, key), (key,))
        if self.due is not None and self.due < self.release:
            what = f"is before its release at {self.release:g} s"
            raise Misfit(what, "make due at least release", self.due, ("due",))
        return self

    def stops(self) -> list[VisitTable]:
        """Return the visits, also where the one-visit shorthand was used."""
        if self.visits is not None:
            return self.visits
        return [
            VisitTable.model_construct(
                pose=self.pose,
                station=self.station,
                service=self.service or 0.0,
                load=self.load,
                needs=self.needs,
                together=self.together or [],
            )
        ]


class SystemTable(Table):
    """The composition by name; every other key is one of its settings."""

    model_config = ConfigDict(extra="allow", strict=True)

    name: Name = Field(default="hierarchical", examples=["hierarchical"])

    @model_validator(mode="after")
    def _check(self) -> "SystemTable":
        for key, value in (self.model_extra or {}).items():
            if not isinstance(value, str | int | float | bool):
                what = "a setting is one string, number or boolean"
                raise Misfit(what, "write a single value", value, (key,))
        return self


_EXAMPLE: JsonDict = {
    "format": FORMAT,
    "name": "one-carrier",
    "robots": [{"id": "r1", "type": "carrier", "start": [5.0, 3.0, 0.0]}],
    "tasks": [{"id": "t1", "pose": [15.0, 3.0, 0.0], "service": 5.0}],
    "site": {"bounds": [[0, 0], [20, 0], [20, 10], [0, 10]]},
    "robot_types": {
        "carrier": {
            "kinematics": "four_wheel",
            "footprint": [[1.5, 1.0], [-1.5, 1.0], [-1.5, -1.0], [1.5, -1.0]],
            "limits": {"speed": 2.5, "yaw_rate": 0.57, "turning_radius": 3.0},
        }
    },
    "system": {"name": "hierarchical"},
}


class ScenarioTable(Table):
    """A scenario: site, fleet, work and the parts chosen to do it. SI units and radians."""

    model_config = ConfigDict(
        extra="forbid",
        strict=True,
        title="Clearway scenario",
        json_schema_extra={"examples": [_EXAMPLE]},
    )

    format: Literal["clearway.scenario/1"]
    name: Name = Field(examples=["warehouse-8x24"])
    seed: Annotated[int, Field(ge=0, le=2**63 - 1)] = 0
    site: SiteTable
    robot_types: dict[str, RobotTypeTable] = Field(min_length=1)
    robots: list[RobotTable] = Field(min_length=1)
    tasks: list[TaskTable] = []
    system: SystemTable = Field(default_factory=SystemTable)
