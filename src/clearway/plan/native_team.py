"""A planning problem handed to the native core, and its answer read back."""

from collections.abc import Callable, Sequence

from clearway import _core
from clearway.model import (
    LOAD_CHANGE,
    TICKS_PER_SECOND,
    Piece,
    Pose,
    Problem,
    RobotType,
    Site,
    Stop,
    Trajectory,
    to_ticks,
    wrap,
)
from clearway.motion import MotionModel, model_of
from clearway.motion.native import native_table
from clearway.plan.bounds import Bounds
from clearway.world.obstacles import native_body, native_obstacles

COARSE_HEADINGS, FINE_HEADINGS = 16, 64


def free_tables(robot_type: RobotType) -> tuple[MotionModel, MotionModel]:
    """Return the model of a type at 16 headings, and that at 64 for a robot that is stuck."""
    return model_of(robot_type, COARSE_HEADINGS), model_of(robot_type, FINE_HEADINGS)


Tables = Callable[[RobotType], tuple[MotionModel, MotionModel]]


def native_model(
    site: Site, robot_type: RobotType, reach: float, tables: Tables = free_tables
) -> _core.Model:
    """Return what the core needs of a type; ``reach`` (m) is the largest body's on the site."""
    changes = robot_type.loaded_footprint is not None or any(o.blocks for o in site.obstacles)
    states = (False, True) if changes else (False,)
    statics = [
        _core.Statics(native_obstacles(site, robot_type.name, loaded), reach) for loaded in states
    ]
    table, fine = tables(robot_type)
    return _core.Model(
        [native_body(robot_type.shape(loaded)) for loaded in states],
        statics,
        native_table(table),
        native_table(fine),
        robot_type.clearance,
    )


class NativeTeam:
    """Models and agents of a problem, in the problem's order.

    ``tables`` gives a type's motion model and its finer one.
    """

    def __init__(
        self,
        problem: Problem,
        bounds: Bounds,
        tables: Tables = free_tables,
    ) -> None:
        self.problem = problem
        self._tables = tables
        self.bounds = bounds
        used = {robot.type for robot in problem.robots}
        self.type_names = [name for name in problem.robot_types if name in used]
        self.motion: dict[str, MotionModel] = {}
        types = [problem.robot_types[name] for name in self.type_names]
        reach = max(t.shape(loaded).circumradius for t in types for loaded in (False, True))
        self.models = [self._model(robot_type, reach) for robot_type in types]
        self.agents = [self._agent(i) for i in range(len(problem.robots))]

    def _model(self, robot_type: RobotType, reach: float) -> _core.Model:
        self.motion[robot_type.name] = self._tables(robot_type)[0]
        return native_model(self.problem.site, robot_type, reach, self._tables)

    def _body(self, robot_type: str, loads: int) -> int:
        """Return the number of the body that a robot has with that many loads."""
        return min(int(loads > 0), self.models[self.type_names.index(robot_type)].num_bodies - 1)

    def _agent(self, index: int) -> _core.Agent:
        robot = self.problem.robots[index]
        state = self.problem.state_of(robot)
        agent = _core.Agent()
        agent.model = self.type_names.index(robot.type)
        fixed = self.problem.fixed.get(robot.id)
        prefix = fixed or state.committed
        start = prefix.start if prefix else state.pose
        agent.start = _core.Pose(*start)
        agent.mode = self._moving_mode(robot.type, state.mode)
        agent.ready = state.tick
        agent.bound = int(self.bounds.arrival[robot.id] * TICKS_PER_SECOND)
        agent.fixed = fixed is not None
        loads = int(state.loaded)
        if prefix:
            agent.committed = self._timed(prefix, robot.type)
        legs = []
        for visit in self.problem.tours.get(robot.id, ()):
            body = self._body(robot.type, loads)
            ready = to_ticks(visit.not_before)
            legs.append(_core.Leg(_core.Pose(*visit.pose), to_ticks(visit.service), body, ready))
            loads += LOAD_CHANGE[visit.load]
        agent.legs = [] if fixed else legs
        agent.rest_body = self._body(robot.type, loads)
        return agent

    def _moving_mode(self, type_name: str, mode: str | None) -> int:
        """Return the number of a mode; -1 for standing, from which no change of mode is due."""
        for i, known in enumerate(self.motion[type_name].modes):
            if known.name == mode and known.is_moving:
                return i
        return -1

    def _timed(self, trajectory: Trajectory, type_name: str) -> list[_core.TimedPiece]:
        numbers = {mode.name: i for i, mode in enumerate(self.motion[type_name].modes)}
        out, tick, pose, body = [], 0, trajectory.start, 0
        for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
            if begin > tick:
                out.append(
                    _core.TimedPiece(tick, begin, _core.Pose(*pose), _core.Twist(0, 0, 0), -1, body)
                )
            body = self._body(type_name, int(piece.loaded))
            mode = numbers.get(piece.mode or "", 0)
            out.append(
                _core.TimedPiece(
                    begin, end, _core.Pose(*piece.start), _core.Twist(*piece.twist), mode, body
                )
            )
            tick, pose = end, piece.end
        return out

    def trajectory(self, index: int, tour: _core.TourResult) -> Trajectory:
        """Return a robot's trajectory from the core's answer."""
        robot = self.problem.robots[index]
        state = self.problem.state_of(robot)
        names = [mode.name for mode in self.motion[robot.type].modes]
        pieces: list[Piece] = []
        timing: list[tuple[int, int]] = []
        start = state.pose
        if state.committed:
            start = state.committed.start
            pieces += state.committed.pieces
            timing += state.committed.timing
        stops = tuple(Stop(stop.leg, stop.arrive, stop.leave) for stop in tour.stops)
        loads, ahead = int(state.loaded), list(stops)
        for native in tour.pieces:
            if native.mode < 0:
                continue
            while ahead and ahead[0].leave <= native.begin:
                loads += LOAD_CHANGE[self.problem.tours[robot.id][ahead.pop(0).visit].load]
            pose = Pose(native.start.x, native.start.y, wrap(native.start.theta))
            twist = (native.twist.a, native.twist.b, native.twist.c)
            pieces.append(Piece(len(pieces), names[native.mode], pose, twist, loads > 0))
            timing.append((native.begin, native.end))
        return Trajectory(robot.id, start, tuple(pieces), tuple(timing), stops)

    def ids(self, indices: Sequence[int]) -> tuple[str, ...]:
        """Return the robots' ids at those positions."""
        return tuple(self.problem.robots[i].id for i in indices)
