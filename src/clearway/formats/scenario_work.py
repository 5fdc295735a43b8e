"""The tables of a scenario file, and of order files, that tell what is to be done."""

from collections.abc import Mapping

from pydantic import Field, model_validator

from clearway.formats.scenario_error import Misfit
from clearway.formats.scenario_fields import Name, PoseField, Seconds
from clearway.formats.scenario_table import Load, Table, require_one
from clearway.model import Order, Pose, Task, Visit


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
        require_one(self, ("pose", "station"), "a visit's place")
        return self

    def built(self, task: str, poses: Mapping[str, Pose]) -> Visit:
        """Return the visit of a task; ``poses`` are those of zones by name."""
        pose = self.pose if self.pose is not None else poses[self.station or ""]
        return Visit(task, pose, self.service, self.load, self.needs, tuple(self.together))


class OrderTable(Table):
    """Visits that one robot does in order; an order of one visit may hold the visit's keys.

    One that fetches a shelf has no visits: the system chooses where it is brought.
    """

    id: Name = Field(examples=["t1"])
    visits: list[VisitTable] | None = Field(default=None, min_length=1)
    pose: PoseField | None = None
    station: str | None = None
    fetches: str | None = Field(
        default=None, description="Name of a shelf that is brought to a station and stored again."
    )
    service: Seconds | None = None
    load: Load | None = None
    needs: Name | None = None
    together: list[str] | None = None
    robot: str | None = Field(default=None, description="The only robot that may do it.")
    release: Seconds = Field(default=0.0, description="Not before (s).")
    due: Seconds | None = Field(default=None, description="To be done by (s).")
    priority: float = Field(default=0.0, description="Larger is more urgent.")

    @model_validator(mode="after")
    def _check(self) -> "OrderTable":
        require_one(self, ("visits", "pose", "station", "fetches"), "a task's place")
        beside = "visits" if self.visits is not None else "fetches"
        if getattr(self, beside) is not None:
            for key in ("service", "load", "needs", "together"):
                if getattr(self, key) is not None:
                    mend = f"move {key} into a visit" if beside == "visits" else f"drop {key}"
                    what = f"does not stand beside {beside}"
                    raise Misfit(what, mend, getattr(self, key), (key,))
        if self.due is not None and self.due < self.release:
            what = f"is before its release at {self.release:g} s"
            raise Misfit(what, "make due at least release", self.due, ("due",))
        return self

    def stops(self) -> list[VisitTable]:
        """Return the visits, also where the one-visit shorthand was used."""
        if self.visits is not None:
            return self.visits
        if self.fetches is not None:
            return []
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

    def built(self, poses: Mapping[str, Pose], after: tuple[str, ...] = ()) -> Order:
        """Return the order; ``poses`` are those of zones by name."""
        visits = tuple(visit.built(self.id, poses) for visit in self.stops())
        task = Task(self.id, visits, self.robot, self.fetches)
        return Order(task, self.release, self.due, self.priority, after)


class TaskTable(OrderTable):
    """An order that may wait for others of the scenario."""

    after: list[str] = Field(
        default=[],
        description="Ids of tasks that must be finished before its first visit is served.",
        examples=[["t1"]],
    )
