"""The tightest spot around a body that stands somewhere."""

from dataclasses import dataclass

from clearway.model import RobotType, Scenario
from clearway.world.shapes import Shape, ShapeIndex, obstacle_shape, room_inside

# The judge's tolerances (m): bodies among each other and obstacles, bodies and bounds.
OVERLAP = 0.001
OUTSIDE = 0.002


@dataclass(frozen=True)
class Spot:
    """The tightest spot around a body: its gap (m), and the key path of what is there."""

    gap: float
    key: str

    @property
    def is_outside(self) -> bool:
        """Whether the bounds are what is nearest."""
        return self.key == "site.bounds"

    @property
    def is_legal(self) -> bool:
        """Whether a body may stand here."""
        return self.gap >= (-OUTSIDE if self.is_outside else -OVERLAP)


class Floors:
    """The obstacles for each robot type and load state."""

    def __init__(self, scenario: Scenario) -> None:
        self._site = scenario.site
        self._shapes = [obstacle_shape(obstacle) for obstacle in scenario.site.obstacles]
        self._indices: dict[tuple[str, bool], tuple[list[int], ShapeIndex]] = {}

    def tightest(self, kind: RobotType, loaded: bool, body: Shape) -> Spot:
        """Return the worst spot: an illegal one if there is any, else the least gap."""
        spots = [Spot(float("inf"), "")]
        if self._site.border == "closed":
            spots.append(Spot(room_inside(self._site.bounds, body), "site.bounds"))
        numbers, index = self._index(kind.name, loaded)
        touched = [(-body.overlap(index.shapes[i]), i) for _, i in index.near(body)]
        nearest = min(touched, default=None) or index.nearest(body)
        if nearest is not None:
            spots.append(Spot(nearest[0], f"site.obstacles[{numbers[nearest[1]]}]"))
        return min(spots, key=lambda spot: (spot.is_legal, spot.gap))

    def _index(self, type_name: str, loaded: bool) -> tuple[list[int], ShapeIndex]:
        if (type_name, loaded) not in self._indices:
            stopping = [i for i, o in enumerate(self._site.obstacles) if o.stops(type_name, loaded)]
            index = ShapeIndex([self._shapes[i] for i in stopping])
            self._indices[type_name, loaded] = (stopping, index)
        return self._indices[type_name, loaded]
