"""The tables of a scenario file that tell what happens while it runs."""

from typing import Annotated

from pydantic import Field, model_validator

from clearway.formats.scenario_error import Misfit
from clearway.formats.scenario_fields import Name, Seconds, Share
from clearway.formats.scenario_site import ObstacleTable
from clearway.formats.scenario_table import Load, Table, ZoneKind, require_one
from clearway.model import Disturbances, Draw, OrderStream, Simulation, Surprise

PerHour = Annotated[float, Field(gt=0.0, le=1e6)]


class DrawTable(Table):
    """A visit at the pose of a zone that is drawn when the order arrives."""

    kind: ZoneKind = Field(description="Kind of the zone, drawn evenly among those with a pose.")
    service: Seconds = Field(default=0.0, description="Time to stand there (s).")
    load: Load | None = Field(default=None, description="Takes effect at the end of the service.")


class StreamTable(Table):
    """Orders that arrive at random."""

    name: Name = Field(description="Its orders are NAME-1, NAME-2, ..", examples=["pallets"])
    rate: PerHour | None = Field(
        default=None, description="Orders an hour, on average: a Poisson process."
    )
    open: Annotated[int, Field(ge=1, le=100_000)] | None = Field(
        default=None,
        description="Orders open at all times: one that is taken up is followed by a new one.",
    )
    visits: list[DrawTable] | None = Field(default=None, min_length=1)
    fetch: bool | None = Field(
        default=None, description="true: each order fetches a shelf that no open one fetches."
    )
    first: Seconds = Field(default=0.0, description="No orders before (s).")
    last: Seconds | None = Field(default=None, description="No orders from then on (s).")
    due_after: Seconds | None = Field(default=None, description="Due so long after release (s).")
    priority: float = Field(default=0.0, description="Larger is more urgent.")

    @model_validator(mode="after")
    def _check(self) -> "StreamTable":
        require_one(self, ("rate", "open"), "how often orders arrive")
        require_one(self, ("visits", "fetch"), "what a stream's orders ask for")
        if self.fetch is False:
            raise Misfit("can only be true", "list visits instead", False, ("fetch",))
        if self.last is not None and self.last <= self.first:
            what = f"is not after first, at {self.first:g} s"
            raise Misfit(what, "make last later than first", self.last, ("last",))
        return self

    def built(self) -> OrderStream:
        """Return the stream."""
        return OrderStream(
            self.name,
            self.rate,
            self.open,
            tuple(Draw(v.kind, v.service, v.load) for v in self.visits or ()),
            self.fetch is True,
            self.first,
            self.last,
            self.due_after,
            self.priority,
        )


class DisturbancesTable(Table):
    """Seeded disturbances of the robots' motion."""

    stops_per_hour: Annotated[float, Field(ge=0.0, le=1e6)] = Field(
        default=0.0, description="Random stops of each robot in an hour of moving."
    )
    stop_seconds: list[Seconds] = Field(
        default=[2.0, 30.0], description="Shortest and longest stop (s)."
    )
    slow: Share = Field(default=0.0, description="Share of robots that drive slower than planned.")
    slowness: Annotated[float, Field(gt=0.0, le=1.0)] = Field(
        default=0.7, description="Their speed as a part of the planned one."
    )

    @model_validator(mode="after")
    def _check(self) -> "DisturbancesTable":
        times = self.stop_seconds
        if len(times) != 2 or times[0] > times[1]:
            mend = "write [shortest, longest]"
            raise Misfit("must be a shortest and a longest", mend, times, ("stop_seconds",))
        return self

    def built(self) -> Disturbances:
        """Return the disturbances."""
        low, high = self.stop_seconds
        return Disturbances(self.stops_per_hour, (low, high), self.slow, self.slowness)


class SurpriseTable(ObstacleTable):
    """An obstacle that nobody knows of before it is there."""

    at: Seconds = Field(description="When it appears (s).")


class SimulationTable(Table):
    """How the scenario runs through time."""

    until: Annotated[float, Field(gt=0.0, le=1e9)] | None = Field(
        default=None, description="Second at which the run ends; absent: when all is done."
    )
    streams: list[StreamTable] = Field(default=[])
    disturbances: DisturbancesTable = Field(default_factory=DisturbancesTable)
    surprises: list[SurpriseTable] = Field(default=[])

    @model_validator(mode="after")
    def _check(self) -> "SimulationTable":
        for i, stream in enumerate(self.streams):
            if stream.last is None and self.until is None:
                mend = "add until to [simulation], or last to the stream"
                raise Misfit("never ends", mend, stream.name, ("streams", i))
        return self

    def built(self) -> Simulation:
        """Return the simulation."""
        return Simulation(
            self.until,
            tuple(stream.built() for stream in self.streams),
            self.disturbances.built(),
            tuple(Surprise(s.at, s.built()) for s in self.surprises),
        )
