"""A scenario file as a whole, as a pydantic model."""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, model_validator
from pydantic.config import JsonDict

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_dump import FORMAT
from clearway.formats.scenario_error import Misfit
from clearway.formats.scenario_fields import FileNames, Name
from clearway.formats.scenario_fleet import FleetTable, RobotTable, RobotTypeTable
from clearway.formats.scenario_simulation import SimulationTable
from clearway.formats.scenario_site import SiteTable
from clearway.formats.scenario_table import Table
from clearway.formats.scenario_work import TaskTable


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
        json_schema_extra={
            "examples": [_EXAMPLE],
            "anyOf": [{"required": ["robots"]}, {"required": ["fleets"]}],
        },
    )

    format: Literal["clearway.scenario/1"]
    name: Name = Field(examples=["warehouse-8x24"])
    seed: Annotated[int, Field(ge=0, le=2**63 - 1)] = 0
    site: SiteTable
    robot_types: dict[str, RobotTypeTable] = Field(min_length=1)
    robots: list[RobotTable] = Field(default=[])
    fleets: list[FleetTable] = Field(default=[])
    tasks: list[TaskTable] = Field(default=[])
    orders: FileNames = Field(default=[])
    system: SystemTable = Field(default_factory=SystemTable)
    simulation: SimulationTable = Field(default_factory=SimulationTable)

    @model_validator(mode="after")
    def _check(self) -> "ScenarioTable":
        if not self.robots and not self.fleets:
            mend = "add a robot: {id = 'r1', type = .., start = [x, y, theta]}"
            raise Misfit("the fleet is empty", mend, ABSENT, ("robots",))
        return self
