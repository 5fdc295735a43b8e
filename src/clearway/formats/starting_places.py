"""Where the robots of a fleet start: in zones of one kind, spread evenly over them."""

from collections.abc import Sequence

from clearway.formats.scenario_error import Problem
from clearway.formats.scenario_fleet import FleetTable
from clearway.model import Pose, Robot, Site


def start_fleets(fleets: Sequence[FleetTable], site: Site) -> tuple[list[Robot], list[Problem]]:
    """Return the robots of all fleets, and what is wrong where they have no room.

    Robot ``i`` of ``n`` starts in zone ``floor((i + 1/2) m / n)`` of the ``m`` that no fleet
    before it has taken, in the order of the site's zones.
    """
    robots: list[Robot] = []
    problems: list[Problem] = []
    taken: set[Pose] = set()
    for i, fleet in enumerate(fleets):
        if fleet.row is not None and site.layout is None:
            mend = "drop row, or write the site as a layout"
            problems.append(Problem(f"fleets[{i}].row", fleet.row, "is a row of no layout", mend))
            continue
        free = [pose for pose in _places(fleet, site) if pose not in taken]
        if fleet.count > len(free):
            where = f"of kind {fleet.at}" + (
                f" in row {fleet.row}" if fleet.row is not None else ""
            )
            what = f"is more than the {len(free)} free zones {where} that have a pose"
            mend = "lower count, or name other zones by at and row"
            problems.append(Problem(f"fleets[{i}].count", fleet.count, what, mend))
            continue
        for k in range(fleet.count):
            pose = free[(2 * k + 1) * len(free) // (2 * fleet.count)]
            taken.add(pose)
            robots.append(Robot(f"{fleet.name}-{k + 1}", fleet.type, pose, energy=fleet.level(k)))
    return robots, problems


def _places(fleet: FleetTable, site: Site) -> list[Pose]:
    poses = [zone.pose for zone in site.zones_of(fleet.at) if zone.pose is not None]
    if fleet.row is None or site.layout is None:
        return poses
    return [pose for pose in poses if int(pose.y // site.layout.cell) == fleet.row]
