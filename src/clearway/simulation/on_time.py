"""Robots that do exactly what they are committed to."""

from collections.abc import Mapping, Sequence

from clearway.model import Commitment, Robot, Trajectory, Trip
from clearway.simulation.kernel import Kernel
from clearway.simulation.motion import Occurrence


class OnTime:
    """Moves robots as planned."""

    def __init__(self, robots: Sequence[Robot]) -> None:
        self._ahead: Kernel[tuple[int, Occurrence]] = Kernel()
        self._paths = {robot.id: Trajectory(robot.id, robot.start) for robot in robots}
        self._told = {robot.id: 0 for robot in robots}
        self._driven: dict[str, list[Trajectory]] = {robot.id: [] for robot in robots}
        # What is ahead of a robot counts until it is committed to something else.
        self._version = {robot.id: 0 for robot in robots}
        self._trips: dict[str, Trip | None] = {robot.id: None for robot in robots}
        self._occurred: dict[str, set[tuple[str, int]]] = {robot.id: set() for robot in robots}

    def commit(self, commitments: Mapping[str, Commitment], now: int) -> None:
        """Take over commitments; see `RobotMotion`."""
        for robot, commitment in commitments.items():
            self._keep(robot, now)
            self._paths[robot] = commitment.trajectory
            self._version[robot] += 1
            if commitment.trip is not self._trips[robot]:
                self._trips[robot] = commitment.trip
                self._occurred[robot] = set()
            occurrences = []
            for stop in commitment.trajectory.stops:
                occurrences.append(Occurrence(stop.arrive, robot, "arrived", stop.visit))
                occurrences.append(Occurrence(stop.leave, robot, "left", stop.visit))
            for wait in commitment.waits:
                occurrences.append(Occurrence(wait.begin, robot, "waits", wait=wait))
            for occurrence in sorted(occurrences, key=lambda one: one.tick):
                if occurrence.tick >= now and self._is_new(occurrence):
                    self._ahead.at(occurrence.tick, (self._version[robot], occurrence))

    def next_tick(self) -> int | None:
        """Return when something occurs next, if anything does."""
        while (tick := self._ahead.next_tick()) is not None:
            item = self._ahead.first()
            assert item is not None
            if item[0] == self._version[item[1].robot]:
                return tick
            self._ahead.pop(tick)
        return None

    def advance(self, now: int) -> Sequence[Occurrence]:
        """Move everybody on; see `RobotMotion`."""
        occurred = []
        while (item := self._ahead.pop(now)) is not None:
            version, occurrence = item
            if version == self._version[occurrence.robot]:
                self._occurred[occurrence.robot].add((occurrence.kind, occurrence.visit))
                occurred.append(occurrence)
        return occurred

    def driven(self, robot: str, now: int) -> Trajectory:
        """Return what a robot has driven since last asked, up to now."""
        self._keep(robot, now)
        parts = self._driven[robot]
        self._driven[robot] = []
        return Trajectory(
            robot,
            parts[0].start,
            tuple(piece for part in parts for piece in part.pieces),
            tuple(span for part in parts for span in part.timing),
        )

    def expected(self, now: int) -> None:
        """Nobody is ever late."""

    def _is_new(self, one: Occurrence) -> bool:
        return one.kind == "waits" or (one.kind, one.visit) not in self._occurred[one.robot]

    def _keep(self, robot: str, now: int) -> None:
        self._driven[robot].append(self._paths[robot].part(self._told[robot], now))
        self._told[robot] = now
