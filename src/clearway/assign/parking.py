"""Where robots rest once their tasks are done, so that nobody is shut in."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal

import numpy as np

from clearway.assign.costs import half_width
from clearway.model import LOAD_CHANGE, Pose, Robot, RobotType, Site, Visit
from clearway.world.grid import Grid
from clearway.world.shapes import Shape, ShapeIndex, body_shape

Tours = Mapping[str, tuple[Visit, ...]]
Kind = tuple[str, bool]

# Cells fine enough to tell whether a body passes another in an aisle (m).
CELL = 0.5
# A way round a resting body that leads further than this from it is no way past it (m).
REACH = 6.0
# Bodies that overlap no deeper than this touch (m).
TOUCHING = 1e-3


def park(
    site: Site,
    robot_types: Mapping[str, RobotType],
    robots: Sequence[Robot],
    tours: Tours,
    when: Literal["blocking", "always", "never"],
) -> dict[str, tuple[Visit, ...]]:
    """Return the tours, ended in a parking bay where a robot must not rest at its last visit.

    A bay is a zone of kind ``parking`` with a pose. It is open to a robot if its body there
    is clear of all starts, visits and rests of others; bays are shared out for the least sum
    of grid distances. Where there are too few, the robots left over stay where they are.

    Parameters
    ----------
    when
        ``blocking``: robots park that, resting where they end (an idle robot at its start),
        would cover or shut off a start or visit of another, or close a passage; robots
        before them in ``robots`` rest first. ``always``: every robot parks. ``never``: none.
    """
    ended = {robot.id: tuple(tours.get(robot.id, ())) for robot in robots}
    bays = [zone.pose for zone in site.zones_of("parking") if zone.pose is not None]
    if when == "never" or not bays:
        return ended
    stays = [_Stay(robot, robot_types[robot.type], ended[robot.id]) for robot in robots]
    leaving = stays if when == "always" else _blocking(site, stays)
    for stay, bay in _bays(site, stays, leaving, bays):
        if stay.rest != bay:
            ended[stay.robot.id] += (Visit(task=None, pose=bay),)
    return ended


class _Stay:
    """Where a robot stands in the course of its tour, and with which body."""

    def __init__(self, robot: Robot, robot_type: RobotType, tour: tuple[Visit, ...]) -> None:
        self.robot, self.type = robot, robot_type
        self.poses = [robot.start, *(visit.pose for visit in tour)]
        self.rest = self.poses[-1]
        bodies = [body_shape(robot_type.shape(False), robot.start)]
        loads = 0
        self.carries = False
        for visit in tour:
            for change in (0, LOAD_CHANGE[visit.load]):
                loads += change
                bodies.append(body_shape(robot_type.shape(loads > 0), visit.pose))
            self.carries = self.carries or loads > 0
        self.loaded = loads > 0
        self.bodies = bodies

    def at(self, bay: Pose) -> Shape:
        """Return the body in a bay."""
        return body_shape(self.type.shape(self.loaded), bay)

    @property
    def kind(self) -> Kind:
        """Type and load state that decide where it can go: loaded if it ever carries one."""
        return self.type.name, self.carries


def _grids(site: Site, stays: Iterable[_Stay], cell: float) -> dict[Kind, Grid]:
    return {
        stay.kind: Grid(site, *stay.kind, half_width(stay.type.shape(stay.carries)), cell)
        for stay in {stay.kind: stay for stay in stays}.values()
    }


def _blocking(site: Site, stays: Sequence[_Stay]) -> list[_Stay]:
    """Return the robots that must not rest where they end."""
    grids = _grids(site, stays, CELL)
    blocking = []
    for stay in stays:
        body = stay.bodies[-1]
        others = [other for other in stays if other is not stay]
        closed = {kind: grid.beside(body) for kind, grid in grids.items()}
        if (
            _covers(stay, others)
            or any(grids[kind].is_split_by(body, REACH) for kind in {o.kind for o in others})
            or _buries(grids, closed, others)
        ):
            blocking.append(stay)
        else:
            grids = closed
    return blocking


def _covers(stay: _Stay, others: Iterable[_Stay]) -> bool:
    """Whether a robot's rest overlaps a place where another stands."""
    return _overlaps(stay.bodies[-1], _all_bodies(others))


def _all_bodies(stays: Iterable[_Stay]) -> ShapeIndex:
    return ShapeIndex([body for stay in stays for body in stay.bodies])


def _buries(
    before: Mapping[Kind, Grid], after: Mapping[Kind, Grid], others: Iterable[_Stay]
) -> bool:
    """Whether a place of another has lost all free cells around it."""
    for other in others:
        points = [(pose.x, pose.y) for pose in other.poses]
        had = before[other.kind].components(points) >= 0
        has = after[other.kind].components(points) >= 0
        if (had & ~has).any():
            return True
    return False


def _bays(
    site: Site, stays: Sequence[_Stay], leaving: Sequence[_Stay], bays: Sequence[Pose]
) -> list[tuple[_Stay, Pose]]:
    """Return who parks where: as many robots as can, for the least sum of distances."""
    from scipy.optimize import linear_sum_assignment

    grids = _grids(site, leaving, 1.0)
    goals = [(bay.x, bay.y) for bay in bays]
    costs = np.full((len(leaving), len(bays)), np.inf)
    for row, stay in enumerate(leaving):
        others = _all_bodies(other for other in stays if other is not stay)
        costs[row] = grids[stay.kind].distances([(stay.rest.x, stay.rest.y)], goals)[0]
        for column, bay in enumerate(bays):
            if _overlaps(stay.at(bay), others):
                costs[row, column] = np.inf
    known = np.isfinite(costs)
    # One robot more in a bay is worth any distance.
    dear = 1.0 + costs[known].sum()
    rows, columns = linear_sum_assignment(np.where(known, costs, dear))
    parked: list[tuple[_Stay, Pose]] = []
    for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
        stay, bay = leaving[row], bays[column]
        taken = ShapeIndex([other.at(place) for other, place in parked])
        if known[row, column] and not _overlaps(stay.at(bay), taken):
            parked.append((stay, bay))
    return parked


def _overlaps(body: Shape, others: ShapeIndex) -> bool:
    return any(body.overlap(others.shapes[i]) > TOUCHING for _, i in others.near(body))
