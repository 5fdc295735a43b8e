"""The tables of a scenario file that tell the site."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from clearway.formats.scenario_error import Misfit
from clearway.formats.scenario_fields import DiscField, Name, PolygonField, PoseField, WallField
from clearway.formats.scenario_table import Table, ZoneKind, require_one
from clearway.model import Layout, Obstacle, Site, Zone

MOST_SHELVES = 100_000


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
        require_one(self, ("polygon", "disc", "wall"), "an obstacle")
        return self

    def built(self) -> Obstacle:
        """Return the obstacle."""
        return Obstacle(self.polygon, self.disc, self.wall, tuple(self.blocks))


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


class LayoutTable(Table):
    """A rule that makes the whole site: bounds, lanes and places."""

    rule: Literal["bidirectional", "compact", "one_way"]
    blocks: Annotated[list[Annotated[int, Field(ge=1, le=1000)]], Field(min_length=1)] = Field(
        default=list(Layout("").blocks),
        description="Lengths of the blocks of shelves from left to right (cells).",
    )
    bands: Annotated[int, Field(ge=1, le=1000)] = Field(
        default=Layout("").bands, description="Pairs of shelf rows from bottom to top."
    )
    cell: Annotated[float, Field(gt=0.0, le=100.0)] = Field(
        default=Layout("").cell, description="Side of a cell (m)."
    )

    @model_validator(mode="after")
    def _check(self) -> "LayoutTable":
        shelves = 2 * self.bands * sum(self.blocks)
        if shelves > MOST_SHELVES:
            what = f"makes {shelves} places for shelves, more than {MOST_SHELVES}"
            raise Misfit(what, "lower bands, or the lengths of blocks", self.bands, ("bands",))
        return self

    def built(self) -> Layout:
        """Return the layout."""
        return Layout(self.rule, tuple(self.blocks), self.bands, self.cell)


class SiteTable(Table):
    """The place: bounds, border, obstacles and zones, or the layout that makes them all."""

    layout: LayoutTable | None = None
    bounds: PolygonField | None = None
    border: Literal["closed", "open"] = Field(
        default="closed", description="Whether bodies must stay inside the bounds."
    )
    obstacles: list[ObstacleTable] = Field(default=[])
    zones: list[ZoneTable] = Field(default=[])

    @model_validator(mode="after")
    def _check(self) -> "SiteTable":
        require_one(self, ("bounds", "layout"), "what makes a site")
        for key in ("border", "obstacles", "zones"):
            if self.layout is not None and key in self.model_fields_set:
                what = "does not stand beside a layout, which makes the whole site"
                mend = f"drop {key}, or write bounds and all zones instead of the layout"
                raise Misfit(what, mend, getattr(self, key), (key,))
        for axis in (0, 1):
            values = [point[axis] for point in self.bounds or ()]
            if values and max(values) - min(values) > 100_000.0:
                what = "a site is at most 100 km wide"
                mend = "write coordinates in m (not mm)"
                raise Misfit(what, mend, max(values) - min(values), ("bounds",))
        return self

    def built(self) -> Site:
        """Return the site.

        Raises
        ------
        ValueError
            If a layout's rule cannot make it.
        """
        if self.layout is not None:
            from clearway.world.channels import site_of

            return site_of(self.layout.built())
        assert self.bounds is not None
        zones = tuple(Zone(z.name, z.kind, z.polygon, z.pose, z.value) for z in self.zones)
        obstacles = tuple(obstacle.built() for obstacle in self.obstacles)
        return Site(self.bounds, obstacles, zones, self.border)
