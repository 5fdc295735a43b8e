"""Waits by rule, in words: where a robot stands, for whom, and why those go first."""

from collections.abc import Sequence
from dataclasses import replace

from clearway import _core
from clearway.model import Commitment, Wait
from clearway.plan.lane_motion import paused
from clearway.plan.waits_by_rule import Pause


def own_waits(
    stays: Sequence[_core.CellStay], pauses: Sequence[Pause], names: Sequence[str], ready: int
) -> tuple[Wait, ...]:
    """Return the waits of a new route, one for each node at which the robot pauses.

    Parameters
    ----------
    ready
        Tick from which it may set out.
    """
    return tuple(
        _wait(
            max(stays[index].arrive, ready),
            stays[index].turn_begin,
            [pause for pause in pauses if pause.index == index],
            names,
        )
        for index in sorted({pause.index for pause in pauses})
    )


def made_to_wait(commitment: Commitment, pause: Pause, names: Sequence[str]) -> Commitment:
    """Return a commitment with one more pause; a wait that ends where it begins is drawn out."""
    at, by = pause.at, pause.by
    new = _wait(at, at + by, [pause], names)
    waits = []
    for wait in commitment.waits:
        if wait.end == at:
            causes = (*wait.causes, *(c for c in new.causes if c not in wait.causes))
            new = Wait(wait.begin, at + by, causes, f"{wait.because}; {new.because}")
        elif wait.begin >= at and wait.end is not None:
            waits.append(replace(wait, begin=wait.begin + by, end=wait.end + by))
        else:
            waits.append(wait)
    waits = sorted([*waits, new], key=lambda wait: wait.begin)
    trajectory = paused(commitment.trajectory, at, by)
    return replace(commitment, trajectory=trajectory, waits=tuple(waits))


def _wait(begin: int, end: int, pauses: Sequence[Pause], names: Sequence[str]) -> Wait:
    told = dict.fromkeys(f"{names[pause.behind]} goes first: {pause.because}" for pause in pauses)
    causes = dict.fromkeys(names[pause.behind] for pause in pauses)
    return Wait(begin, end, tuple(causes), "; ".join(told))
