"""Where robots of true shapes need the same floor."""

from collections.abc import Iterable, Mapping

from clearway import _core
from clearway.execute.course import NEVER, Course
from clearway.model import LOAD_CHANGE, Commitment, RobotType
from clearway.protocols import Precedence
from clearway.world.obstacles import native_body

Found = tuple[tuple[Precedence, ...], tuple[Precedence, ...]]

# Longest motion (m) within one cell of a path, and within the finest that is told.
CELL, FINEST = 0.5, 0.05
# Least clearance (m) of a type that can be carried out under delay.
LEAST_CLEARANCE = 0.02


class BodyConflicts:
    """Finds where the bodies on two committed paths would come within a margin of each other.

    A place of conflict is told by cells of half a metre of motion, near the planned times by ever
    finer ones, so that nothing the plan does is forbidden: robots that are planned to drive
    closely behind each other stay as close. No point of a body moves more than `FINEST` within
    the finest cells, so clearances of that and more cost no time. Below them robots wait for each
    other in small steps.

    Parameters
    ----------
    types
        Robot type of each robot.
    margin
        Gap (m) that is kept whatever happens, for errors of position.

    Raises
    ------
    ValueError
        A type has less clearance than the margin and `LEAST_CLEARANCE` together.
    """

    def __init__(self, types: Mapping[str, RobotType], margin: float = 0.0) -> None:
        for robot_type in types.values():
            needed = margin + LEAST_CLEARANCE
            if robot_type.clearance < needed:
                raise ValueError(
                    f"robot type {robot_type.name}: a clearance of {robot_type.clearance:g} m is "
                    f"too little to go on under delay; give it {needed:g} m or more"
                )
        self._types = dict(types)
        self._bodies = {robot: _bodies(kind) for robot, kind in types.items()}
        self._params = _core.PathParams()
        self._params.margin = margin
        self._params.finest = FINEST
        self._known: dict[str, tuple[Commitment, _core.CommittedPath]] = {}

    def __call__(self, one: Commitment, other: Commitment, done: tuple[int, int] = (0, 0)) -> Found:
        """Return what each of two robots must wait for; see `clearway.protocols.Conflicts`.

        Raises
        ------
        ValueError
            By plan their bodies are in each other at some tick.
        """
        found = _core.path_conflicts(
            self._path(one), done[0], self._path(other), done[1], self._params
        )
        if found.meeting >= 0:
            raise ValueError(
                f"robots {one.robot} and {other.robot} are in each other at tick {found.meeting} "
                "of their motions; commitments must be free of conflicts"
            )
        return _steps(found.first, other.robot), _steps(found.second, one.robot)

    def overlap(
        self, one: Commitment, ticks: tuple[int, int], other: Commitment, its: tuple[int, int]
    ) -> bool:
        """Return whether bodies are in each other for some tick of each of two stretches."""
        return _core.paths_overlap(self._path(one), *ticks, self._path(other), *its)

    def _path(self, commitment: Commitment) -> _core.CommittedPath:
        known = self._known.get(commitment.robot)
        if known is None or known[0] is not commitment:
            path = native_path(commitment, self._bodies[commitment.robot])
            known = self._known[commitment.robot] = (commitment, path)
        return known[1]


def native_path(commitment: Commitment, bodies: list[_core.Body]) -> _core.CommittedPath:
    """Return a robot's motion for the core, with the body that it has at each moment."""
    trajectory = commitment.trajectory
    visits = commitment.trip.visits if commitment.trip else ()
    changes = {k: LOAD_CHANGE[visit.load] for k, visit in enumerate(visits)}
    pose, pieces, tick = trajectory.start, [], 0
    loads = _loads_at_start(commitment, changes)
    for stretch in Course(trajectory).stretches:
        piece = stretch.piece
        loads = int(piece.loaded) if piece else loads
        body = min(loads, len(bodies) - 1)
        if piece:
            twist = _core.Twist(*piece.twist)
            start = _core.Pose(*piece.start)
            pieces.append(_core.TimedPiece(stretch.begin, stretch.end, start, twist, 0, body))
            pose = piece.end
        elif stretch.duration:
            # It rests for ever with the body of its last tick.
            end = min(stretch.end, tick + 1) if stretch.end == NEVER else stretch.end
            still = _core.Twist(0.0, 0.0, 0.0)
            pieces.append(_core.TimedPiece(tick, end, _core.Pose(*pose), still, -1, body))
        tick = stretch.end
        if stretch.visit is not None:
            loads = max(0, loads + changes.get(stretch.visit, 0))
    return _core.CommittedPath(bodies, _core.Pose(*trajectory.start), pieces, CELL)


def _loads_at_start(commitment: Commitment, changes: Mapping[int, int]) -> int:
    """Return how many loads a robot carries before its first piece and its first service."""
    trajectory, trip = commitment.trajectory, commitment.trip
    if not trajectory.pieces:
        return int(bool(trip and trip.carries))
    first = trajectory.timing[0][0]
    before = (changes.get(stop.visit, 0) for stop in trajectory.stops if stop.leave <= first)
    return max(0, int(trajectory.pieces[0].loaded) - sum(before))


def _bodies(robot_type: RobotType) -> list[_core.Body]:
    loaded = robot_type.loaded_footprint is not None
    return [
        native_body(robot_type.shape(state)) for state in ((False, True) if loaded else (False,))
    ]


def _steps(passages: Iterable[tuple[int, int]], other: str) -> tuple[Precedence, ...]:
    return tuple(Precedence(at, other, passed) for at, passed in passages)
