"""Standing that is no service, with the names of those whom going on at once would have met."""

from collections.abc import Sequence

from clearway import _core
from clearway.model import Commitment, Trajectory, Wait, to_seconds, to_ticks
from clearway.plan.native_type import NativeType

SHARES = (
    1.0,
    0.75,
    0.5,
    0.25,
)  # of a wait by which the motion is moved forward to see whom it meets


def named_waits(
    core: _core.TailPlanner,
    ids: Sequence[str],
    kind: NativeType,
    trajectory: Trajectory,
    since: int,
) -> tuple[Wait, ...]:
    """Return the waits of a committed motion from tick ``since`` on.

    Changes of mode are none. A wait for nobody is one for a visit's time.
    """
    robot = list(ids).index(trajectory.robot)
    named = []
    for begin, end, following in _standings(trajectory, since):
        if end - begin <= to_ticks(kind.type.mode_switch):
            continue
        named.append(_named(core, robot, ids, kind, trajectory, (begin, end), following))
    return tuple(named)


def retimed_waits(old: Commitment, trajectory: Trajectory) -> tuple[Wait, ...]:
    """Return a commitment's waits at the times of a retimed trajectory.

    Each ends as the robot drives on.
    """
    begins = dict(zip((p.id for p in trajectory.pieces), trajectory.timing, strict=True))
    before = dict(zip((t[0] for t in old.trajectory.timing), old.trajectory.pieces, strict=True))
    waits = []
    for wait in old.waits:
        piece = before.get(-1 if wait.end is None else wait.end)
        if piece is None or piece.id not in begins or wait.end is None:
            continue
        shift = begins[piece.id][0] - wait.end
        waits.append(Wait(wait.begin + shift, wait.end + shift, wait.causes, wait.because))
    return tuple(waits)


def _standings(trajectory: Trajectory, since: int) -> list[tuple[int, int, int]]:
    """Return first and last tick of each standing that is no service, and the next piece."""
    found = []
    last, ahead = since, list(trajectory.stops)
    for i, (begin, end) in enumerate(trajectory.timing):
        if begin >= since:
            while ahead and ahead[0].arrive <= begin:
                stop = ahead.pop(0)
                if stop.arrive > last:
                    found.append((last, stop.arrive, i))
                last = stop.leave
            if begin > last:
                found.append((last, begin, i))
        last = max(last, end)
    return found


def _named(
    core: _core.TailPlanner,
    robot: int,
    ids: Sequence[str],
    kind: NativeType,
    trajectory: Trajectory,
    span: tuple[int, int],
    following: int,
) -> Wait:
    begin, end = span
    if trajectory.timing[following][0] != end:
        return Wait(begin, end, ("visit time",), "its service may not begin before")
    last = following + 1
    while (
        last < len(trajectory.timing)
        and trajectory.timing[last][0] == trajectory.timing[last - 1][1]
    ):
        last += 1
    motion = (trajectory.pieces[following:last], trajectory.timing[following:last])
    pieces = kind.timed(motion, end, motion[1][-1][1], 0)
    for share in SHARES:
        earlier = max(1, round(share * (end - begin)))
        met = core.meetings(robot, pieces, earlier)
        if met:
            names = tuple(ids[one.robot] for one in met)
            place = f"({met[0].at.x:.1f}, {met[0].at.y:.1f})"
            told = f"going on at {to_seconds(end - earlier):.1f} s it would meet "
            return Wait(begin, end, names, f"{told}{' and '.join(names)} near {place}")
    return Wait(begin, end, (), "the search found no way that begins sooner")
