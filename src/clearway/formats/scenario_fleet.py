"""The tables of a scenario file that tell robot types and robots."""

from typing import Annotated

from pydantic import AfterValidator, Field, WithJsonSchema, model_validator

from clearway.formats.scenario_error import Misfit, closest
from clearway.formats.scenario_fields import FootprintField, Levels, Name, PoseField, Share
from clearway.formats.scenario_table import Table, ZoneKind
from clearway.model import Battery, Limits, Robot, RobotType
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
Speed = Annotated[float, Field(gt=0.0, le=50.0)]
Acceleration = Annotated[float, Field(gt=0.0, le=50.0)]


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
    charging: Annotated[float, Field(gt=0.0, le=1e9)] = Field(
        default=500.0, description="Time from empty to capacity at a charger (s)."
    )
    full: Annotated[float, Field(gt=0.0, le=1.0)] = Field(
        default=0.95, description="Fraction of capacity up to which a robot charges."
    )

    @model_validator(mode="after")
    def _check(self) -> "BatteryTable":
        if self.full <= self.reserve:
            what = f"must be above reserve, which is {self.reserve:g}"
            key = "full" if "full" in self.model_fields_set else "reserve"
            if key == "reserve":
                what = f"must be below full, which is {self.full:g}"
            raise Misfit(what, "leave room between them", getattr(self, key), (key,))
        return self


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

    def built(self, name: str) -> RobotType:
        """Return the robot type."""
        return RobotType(
            name=name,
            footprint=self.footprint,
            kinematics=self.kinematics,
            limits=Limits(**self.limits.model_dump()),
            loaded_footprint=self.loaded_footprint,
            clearance=self.clearance,
            modes=tuple(self.modes),
            mode_switch=self.mode_switch,
            capacity=self.capacity,
            capabilities=frozenset(self.capabilities),
            battery=Battery(**self.battery.model_dump()) if self.battery else None,
            motion=self.motion,
        )


class RobotTable(Table):
    """One robot and where it starts."""

    id: Name = Field(examples=["r1"])
    type: str = Field(examples=["carrier"])
    start: PoseField
    start_speed: Annotated[float, Field(ge=-50.0, le=50.0)] = Field(
        default=0.0, description="Speed at the start (m/s)."
    )
    start_mode: str | None = None
    energy: Share = Field(default=1.0, description="Level of its battery at the start.")

    def built(self) -> Robot:
        """Return the robot."""
        return Robot(self.id, self.type, self.start, self.start_speed, self.start_mode, self.energy)


class FleetTable(Table):
    """Equal robots that start in zones of one kind, spread evenly over them."""

    name: Name = Field(description="Its robots are NAME-1, NAME-2, ..", examples=["agv"])
    type: str = Field(examples=["agv"])
    count: Annotated[int, Field(ge=1, le=100_000)]
    at: ZoneKind = Field(
        description="Kind of the zones, at whose poses they start.", examples=["parking"]
    )
    row: Annotated[int, Field(ge=0)] | None = Field(
        default=None, description="Only zones in this row of the layout's cells, 0 at the bottom."
    )
    energy: Levels = Field(default=[1.0])

    def level(self, i: int) -> float:
        """Return the energy of robot ``i``, counted from 0."""
        first, last = self.energy[0], self.energy[-1]
        return first + (last - first) * i / max(1, self.count - 1)
