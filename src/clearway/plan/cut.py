"""Where a committed motion may be left: what is kept of it, and what comes after is replaced."""

from dataclasses import dataclass, replace

from clearway.model import Piece, Pose, Trajectory


@dataclass(frozen=True)
class Kept:
    """What a robot still does before it may be planned anew: where, in which mode, at which tick.

    ``pieces`` are those that end after the tick at which this was asked.
    """

    pieces: tuple[Piece, ...]
    timing: tuple[tuple[int, int], ...]
    pose: Pose
    mode: str | None
    ready: int


def cut(trajectory: Trajectory, now: int, at: int, anywhere: bool) -> Kept:
    """Return what is kept of a motion that is left at the first moment from tick ``at`` on.

    Parameters
    ----------
    anywhere
        Whether a robot can stop and start at any speed, so that a piece may be left half driven;
        else it is left where it stands.
    """
    pieces: list[Piece] = []
    timing: list[tuple[int, int]] = []
    pose, mode, ready = trajectory.start, None, at
    for i, (piece, (begin, end)) in enumerate(
        zip(trajectory.pieces, trajectory.timing, strict=True)
    ):
        if begin >= ready:
            break
        rests = i + 1 == len(trajectory.pieces) or trajectory.timing[i + 1][0] > end
        if end > ready and anywhere:
            share = (ready - begin) / (end - begin)
            a, b, c = (share * value for value in piece.twist)
            piece, end = replace(piece, twist=(a, b, c)), ready
        elif end > ready or not (anywhere or rests):
            ready = max(ready, end if rests else end + 1)
        pose, mode = piece.end, piece.mode
        if end > now:
            pieces.append(piece)
            timing.append((begin, end))
    return Kept(tuple(pieces), tuple(timing), pose, mode, ready)
