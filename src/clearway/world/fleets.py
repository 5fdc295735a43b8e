"""The fleets of generated instances, with the lanes that their robots need."""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from clearway.model import Footprint, Limits, RobotType
from clearway.world.reach import inscribed_disc
from clearway.world.warehouse import four_wheel_carrier

# What is left over where a body of the fleet passes (m).
SPARE = 1.0

CAR = RobotType(
    name="car",
    footprint=Footprint.rectangle(3.0, 2.0, rear=1.0),
    kinematics="ackermann",
    limits=Limits(speed=1.0, turning_radius=3.0),
)
CARRIER = replace(four_wheel_carrier(), clearance=0.0)
FORKLIFT = RobotType(
    name="forklift",
    footprint=Footprint(
        parts=(
            ((2.0, 0.6), (-0.3, 0.6), (-0.3, -0.6), (2.0, -0.6)),
            ((-0.3, 0.3), (-1.4, 0.3), (-1.4, -0.3), (-0.3, -0.3)),
        )
    ),
    kinematics="ackermann",
    limits=Limits(speed=1.5, reverse_speed=1.0, turning_radius=1.8),
    motion="forklift",
)
SHUTTLE = RobotType(
    name="shuttle",
    footprint=Footprint.rectangle(2.0, 1.2),
    kinematics="four_wheel",
    limits=Limits(speed=1.5, yaw_rate=0.8, turning_radius=1.5),
)
DIFFERENTIAL = RobotType(
    name="differential",
    footprint=Footprint.rectangle(1.2, 0.8),
    kinematics="differential",
    limits=Limits(speed=1.2, yaw_rate=1.0),
)
HOLONOMIC = RobotType(
    name="holonomic",
    footprint=Footprint(radius=0.5),
    kinematics="holonomic",
    limits=Limits(speed=1.0, yaw_rate=1.0),
)

# The types of a fleet take turns among its robots.
FLEETS: Mapping[str, tuple[RobotType, ...]] = {
    "cars": (CAR,),
    "carriers": (CARRIER,),
    "forklifts": (FORKLIFT,),
    "shuttles": (SHUTTLE,),
    "differentials": (DIFFERENTIAL,),
    "holonomics": (HOLONOMIC,),
    "mixed": (CAR, FORKLIFT, SHUTTLE, DIFFERENTIAL, HOLONOMIC),
}


@dataclass(frozen=True)
class Lanes:
    """Widths (m) that a fleet needs of a site.

    Parameters
    ----------
    door
        Lets any body through, whichever way it points.
    aisle
        Lets any body pass one that stands along a side, whichever way that one points.
    """

    door: float
    aisle: float


def lanes_of(types: Sequence[RobotType]) -> Lanes:
    """Return the lanes for a fleet: a car's girth is 3.6 m, so doors of 4.6, aisles of 6.6 m."""
    girth = max(_girth(kind.footprint) for kind in types)
    return Lanes(girth + SPARE, girth + 2.0 * widest_disc(types) + SPARE)


def widest_disc(types: Sequence[RobotType]) -> float:
    """Return the largest radius (m) of a disc inside a body of the fleet."""
    return max(inscribed_disc(kind.footprint)[1] for kind in types)


def _girth(footprint: Footprint) -> float:
    """Return the largest distance between two points of a body (m)."""
    if footprint.radius:
        return 2.0 * footprint.radius
    corners = [corner for part in footprint.parts for corner in part]
    return max(math.dist(a, b) for a, b in itertools.combinations(corners, 2))
