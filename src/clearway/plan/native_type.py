"""One robot type in the native core: its number there, and its motions to and fro."""

from collections.abc import Sequence

from clearway import _core
from clearway.model import LOAD_CHANGE, Piece, Pose, RobotType, Site, Visit, to_ticks, wrap
from clearway.plan.native_team import free_tables, native_model
from clearway.world.obstacles import native_body, native_obstacles

Motion = tuple[tuple[Piece, ...], tuple[tuple[int, int], ...]]  # pieces and their timing


class NativeType:
    """A type as number ``index`` among the core's models, all made with the same ``reach`` (m)."""

    def __init__(self, index: int, robot_type: RobotType, site: Site, reach: float) -> None:
        self.index = index
        self.type = robot_type
        self.model = native_model(site, robot_type, reach)
        self.modes = free_tables(robot_type)[0].modes
        self._reach = reach

    def body(self, loads: int) -> int:
        """Return the number of the body that it has with that many loads."""
        return min(int(loads > 0), self.model.num_bodies - 1)

    def mode(self, name: str | None) -> int:
        """Return the number of a mode; -1 for standing, from which no change of mode is due."""
        for i, known in enumerate(self.modes):
            if known.name == name and known.is_moving:
                return i
        return -1

    def is_clear(self, statics: Sequence[_core.Statics], pose: Pose) -> bool:
        """Whether it can stand at a pose, loaded or not, by what `statics` returned for a site."""
        bodies = (native_body(self.type.shape(loaded)) for loaded in (False, True))
        return all(
            s.gap(b, _core.Pose(*pose)) >= 0.0 for s, b in zip(statics, bodies, strict=False)
        )

    def statics(self, site: Site) -> list[_core.Statics]:
        """Return what stands on a site in the way of each of its bodies."""
        return [
            _core.Statics(native_obstacles(site, self.type.name, loaded), self._reach)
            for loaded in (False, True)[: self.model.num_bodies]
        ]

    def legs(self, visits: Sequence[Visit], loads: int) -> tuple[list[_core.Leg], int]:
        """Return the legs to visits, and how many loads it has in the end."""
        legs = []
        for visit in visits:
            pose, ready = _core.Pose(*visit.pose), to_ticks(visit.not_before)
            legs.append(_core.Leg(pose, to_ticks(visit.service), self.body(loads), ready))
            loads += LOAD_CHANGE[visit.load]
        return legs, loads

    def timed(self, motion: Motion, since: int, until: int, loads: int) -> list[_core.TimedPiece]:
        """Return pieces without gaps from ``since`` to ``until``.

        It stands between them as it came; ``loads`` are those with which it stands at first.
        """
        out: list[_core.TimedPiece] = []
        tick, body = since, self.body(loads)
        for piece, (begin, end) in zip(*motion, strict=True):
            start = _core.Pose(*piece.start)
            if begin > tick:
                out.append(_standing(tick, begin, start, body))
            body = self.body(int(piece.loaded))
            mode = max(0, self.mode(piece.mode))
            out.append(_core.TimedPiece(begin, end, start, _core.Twist(*piece.twist), mode, body))
            tick = end
        if motion[0] and until > tick:
            out.append(_standing(tick, until, _core.Pose(*motion[0][-1].end), body))
        return out

    def motion(
        self,
        native: Sequence[_core.TimedPiece],
        stops: Sequence[_core.TourStop],
        visits: Sequence[Visit],
        loads: int,
        first_id: int,
    ) -> Motion:
        """Return the moving pieces of a native motion, numbered from ``first_id``."""
        pieces: list[Piece] = []
        timing: list[tuple[int, int]] = []
        ahead = list(stops)
        for part in native:
            if part.mode < 0:
                continue
            while ahead and ahead[0].leave <= part.begin:
                loads += LOAD_CHANGE[visits[ahead.pop(0).leg].load]
            pose = Pose(part.start.x, part.start.y, wrap(part.start.theta))
            twist = (part.twist.a, part.twist.b, part.twist.c)
            name = self.modes[part.mode].name
            pieces.append(Piece(first_id + len(pieces), name, pose, twist, loads > 0))
            timing.append((part.begin, part.end))
        return tuple(pieces), tuple(timing)


def _standing(begin: int, end: int, pose: _core.Pose, body: int) -> _core.TimedPiece:
    return _core.TimedPiece(begin, end, pose, _core.Twist(0.0, 0.0, 0.0), -1, body)
