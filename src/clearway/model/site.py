"""The site: bounds, obstacles, zones."""

import math
from dataclasses import dataclass
from typing import Literal

from clearway.model.footprint import Point, Polygon, check_polygon
from clearway.model.pose import Pose, check_pose

Border = Literal["closed", "open"]


@dataclass(frozen=True)
class Obstacle:
    """One fixed obstacle: a simple polygon, a disc or a wall without thickness.

    ``blocks`` names whom it stops, ``"TYPE"`` or ``"TYPE:loaded"``; empty: everyone.
    """

    polygon: Polygon | None = None
    disc: tuple[float, float, float] | None = None
    wall: tuple[Point, Point] | None = None
    blocks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        given = [k for k in ("polygon", "disc", "wall") if getattr(self, k) is not None]
        if len(given) != 1:
            raise ValueError(f"an obstacle is one of polygon, disc or wall, got {given or 'none'}")
        if self.polygon is not None:
            object.__setattr__(self, "polygon", check_polygon(self.polygon, "obstacle polygon"))
        if self.disc is not None:
            if len(self.disc) != 3 or not all(math.isfinite(v) for v in self.disc):
                raise ValueError(f"a disc is three finite numbers [x, y, radius], got {self.disc}")
            if self.disc[2] <= 0.0:
                raise ValueError(f"a disc's radius must be above 0, got {self.disc[2]}")
        if self.wall is not None:
            if not all(len(p) == 2 and all(math.isfinite(v) for v in p) for p in self.wall):
                raise ValueError(f"a wall is two points of two finite numbers, got {self.wall}")
            if self.wall[0] == self.wall[1]:
                raise ValueError(f"a wall's two points coincide: {self.wall[0]}")

    def stops(self, type_name: str, loaded: bool) -> bool:
        """Whether a robot of this type and load state must stay out."""
        if not self.blocks:
            return True
        return type_name in self.blocks or (loaded and f"{type_name}:loaded" in self.blocks)


@dataclass(frozen=True)
class Zone:
    """A named area with a rule or a use; ``pose`` is where a robot stands to use it.

    ``kind`` is ``shelf``, ``station``, ``charger``, ``parking``, ``lane``, ``one_way``,
    ``speed`` or ``closed``; ``value`` is the speed limit (m/s) or the direction (rad).
    """

    name: str
    kind: str
    polygon: Polygon
    pose: Pose | None = None
    value: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "polygon", check_polygon(self.polygon, f"zone {self.name}"))
        if self.pose is not None:
            object.__setattr__(self, "pose", check_pose(self.pose, f"pose of zone {self.name}"))


@dataclass(frozen=True)
class Layout:
    """Lanes and places that a site is made of by rule (see `clearway.world.channels`).

    Parameters
    ----------
    rule
        ``bidirectional``, or one of its one-way counterparts ``compact`` and ``one_way``.
    blocks
        Lengths of the blocks of shelves from left to right (cells).
    bands
        Pairs of shelf rows from bottom to top.
    cell
        Side of a cell (m).
    """

    rule: str
    blocks: tuple[int, ...] = (9, 9, 11)
    bands: int = 7
    cell: float = 1.0


@dataclass(frozen=True)
class Site:
    """A confined place: simple polygon ``bounds`` (m), obstacles and zones.

    ``layout`` is the rule that it was made by, where it was.
    """

    bounds: Polygon
    obstacles: tuple[Obstacle, ...] = ()
    zones: tuple[Zone, ...] = ()
    border: Border = "closed"
    layout: Layout | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "bounds", check_polygon(self.bounds, "site bounds"))
        if self.border not in ("closed", "open"):
            raise ValueError(f"border must be 'closed' or 'open', got {self.border!r}")

    def zones_of(self, kind: str) -> tuple[Zone, ...]:
        """Return the zones of one kind, in the order given."""
        return tuple(zone for zone in self.zones if zone.kind == kind)
