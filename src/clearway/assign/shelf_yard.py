"""Who owns which shelf, place, station and charger of a warehouse whose robots carry shelves."""

from collections.abc import Iterable

from clearway.assign.nearby import Nearby
from clearway.model import Pose, Site

KINDS = ("shelf", "station", "charger", "parking")


class ShelfYard:
    """State of shelves, places, stations and chargers (paper B, R-B12).

    A *place* is a zone of kind ``shelf``; at first each holds the shelf named like it. Every robot
    owns one endpoint: the one that it stands at, or is on its way to. No two own the same.

    Parameters
    ----------
    site
        Its zones of kind ``shelf``, ``station``, ``charger`` and ``parking`` with poses.

    Attributes
    ----------
    stations, chargers
        Those that nobody owns.
    vacant
        Places without a shelf that no shelf is to come to.
    sheltered
        Places whose shelf nobody is under or has selected.
    where
        Place of each shelf; ``None`` while it is carried.
    is_whole
        Whether no obstacle has driven a robot off.
    freed
        Shelves that may have become available since the list was last emptied.
    """

    def __init__(self, site: Site) -> None:
        zones = [zone for zone in site.zones if zone.kind in KINDS and zone.pose is not None]
        self.pose: dict[str, Pose] = {z.name: z.pose for z in zones if z.pose is not None}
        self.kind = {zone.name: zone.kind for zone in zones}
        of = {kind: {n: self.pose[n] for n in self.pose if self.kind[n] == kind} for kind in KINDS}
        self.stations = Nearby(of["station"], of["station"])
        self.chargers = Nearby(of["charger"], of["charger"])
        self.vacant = Nearby(of["shelf"])
        self.sheltered = Nearby(of["shelf"], of["shelf"])
        self.where: dict[str, str | None] = {place: place for place in of["shelf"]}
        self.freed: list[str] = []
        self._shelf_in = {place: place for place in of["shelf"]}
        self._selected: set[str] = set()
        self._carried: dict[str, str] = {}
        self.is_whole = True
        self._owner: dict[str, str] = {}
        self._owned: dict[str, str] = {}
        self._at = {self._spot(pose): name for name, pose in self.pose.items()}

    def endpoint_at(self, pose: Pose) -> str | None:
        """Return the endpoint within a millimetre of a pose, if there is one."""
        return self._at.get(self._spot(pose))

    def owner(self, endpoint: str) -> str | None:
        """Return the robot that owns an endpoint."""
        return self._owner.get(endpoint)

    def owned(self, robot: str) -> str | None:
        """Return the endpoint that a robot owns."""
        return self._owned.get(robot)

    def carried(self, robot: str) -> str:
        """Return the shelf that a robot carries, or is under to lift it."""
        return self._carried[robot]

    def held_by(self, robot: str) -> str | None:
        """Return the shelf that a robot has on board, or is under."""
        under = self._shelf_in.get(self._owned.get(robot, ""))
        return self._carried.get(robot, under)

    def is_free(self, shelf: str) -> bool:
        """Whether a shelf is stored and no order has it; somebody may rest under it."""
        return self.where[shelf] is not None and shelf not in self._selected

    def move(self, robot: str, endpoint: str) -> None:
        """Let a robot give up its endpoint for another."""
        other = self._owner.get(endpoint, robot)
        assert other == robot, f"{endpoint} of {other} was given to {robot}"
        left = self._owned.get(robot)
        if left is not None:
            del self._owner[left]
        self._owner[endpoint] = robot
        self._owned[robot] = endpoint
        self._refresh(endpoint if left is None else left, endpoint)
        if left is not None and left in self._shelf_in:
            self.freed.append(self._shelf_in[left])

    def select(self, robot: str, shelf: str) -> None:
        """Let a robot go under a shelf to lift it: nobody else may have it now."""
        place = self.where[shelf]
        assert place is not None and shelf not in self._selected
        self._selected.add(shelf)
        self._carried[robot] = shelf
        self.move(robot, place)

    def carry_off(self, robot: str, station: str) -> None:
        """Let a robot leave for a station with its shelf, whose place becomes vacant."""
        shelf = self._carried[robot]
        place = self.where[shelf]
        if place is not None:
            assert self._owned[robot] == place
            self.where[shelf] = None
            del self._shelf_in[place]
        self.move(robot, station)
        self._check()

    def bring_back(self, robot: str, place: str) -> None:
        """Let a robot leave its station for a vacant place, which becomes its own."""
        assert place in self.vacant, f"{robot} cannot store at {place}, which is not vacant"
        self.move(robot, place)
        self._check()

    def lower(self, robot: str) -> None:
        """Let a robot put its shelf down where it is; it stays under it."""
        shelf = self._carried.pop(robot)
        place = self._owned[robot]
        self.where[shelf] = place
        self._shelf_in[place] = shelf
        self._selected.discard(shelf)
        self.freed.append(shelf)

    def give_up(self, robot: str) -> None:
        """Let a robot have no endpoint any more: an obstacle has driven it off."""
        self.is_whole = False
        left = self._owned.pop(robot, None)
        if left is not None:
            del self._owner[left]
            self._refresh(left)
            if left in self._shelf_in:
                self.freed.append(self._shelf_in[left])

    def drop_selection(self, robot: str) -> None:
        """Let a robot not lift the shelf that it was bound for: others may have it."""
        shelf = self._carried.pop(robot)
        self._selected.discard(shelf)
        self.freed.append(shelf)

    def blocks_place(self, robot: str) -> bool:
        """Whether a robot without a shelf rests at a place without one, which others need."""
        place = self._owned.get(robot, "")
        return (
            self.kind.get(place) == "shelf"
            and place not in self._shelf_in
            and robot not in self._carried
        )

    def free_above(self, robot: str) -> None:
        """Let the shelf that a robot rests under be asked for again."""
        place = self._owned[robot]
        if place in self._shelf_in:
            self.freed.append(self._shelf_in[place])

    def _refresh(self, *endpoints: str) -> None:
        for name in endpoints:
            kind = self.kind[name]
            is_owned = name in self._owner
            if kind == "station":
                self._set(self.stations, name, not is_owned)
            elif kind == "charger":
                self._set(self.chargers, name, not is_owned)
            elif kind == "shelf":
                has_shelf = name in self._shelf_in
                self._set(self.vacant, name, not is_owned and not has_shelf)
                self._set(self.sheltered, name, not is_owned and has_shelf)

    @staticmethod
    def _set(index: Nearby, name: str, is_there: bool) -> None:
        if is_there:
            index.add(name)
        else:
            index.discard(name)

    @property
    def homeless(self) -> int:
        """Number of shelves on board without a place to go to."""
        return sum(
            self.where[shelf] is None and self.kind.get(self._owned.get(robot, "")) != "shelf"
            for robot, shelf in self._carried.items()
        )

    def _check(self) -> None:
        """Whoever carries a shelf finds a place for it (R-B13), if no obstacle has come between."""
        assert not self.is_whole or len(self.vacant) >= self.homeless, (
            f"{self.homeless} shelves on board need a place, {len(self.vacant)} are vacant"
        )

    @staticmethod
    def _spot(pose: Pose) -> tuple[int, int]:
        return round(pose.x * 1000.0), round(pose.y * 1000.0)


def require_shelves(yard: ShelfYard, orders: Iterable[tuple[str, str | None]]) -> None:
    """Check that orders, as (id, shelf), fetch shelves of the site.

    Raises
    ------
    ValueError
        If an order fetches nothing, or a shelf that there is none of.
    """
    for order, shelf in orders:
        if shelf is None:
            raise ValueError(
                f"order {order} fetches no shelf; give `fetches`, or a system that visits poses"
            )
        if shelf not in yard.where:
            raise ValueError(
                f"order {order} fetches {shelf}, which is no shelf; shelves are named like the "
                f"zones of kind shelf that they start in, such as {next(iter(yard.where), 'none')}"
            )
