"""Neighbouring steps that break one rule, told once."""

from collections.abc import Callable

import numpy as np

from clearway.model import Track
from clearway.validate.steps import Bools, Floats
from clearway.validate.violation import Violation


def episodes(broken: Bools, excess: Floats) -> list[int]:
    """Return the worst index of each unbroken run of ``broken``."""
    index = np.flatnonzero(broken)
    runs = np.split(index, np.flatnonzero(np.diff(index) > 1) + 1)
    return [int(run[np.argmax(excess[run])]) for run in runs if len(run)]


def tell(
    kind: str,
    robot: str,
    track: Track,
    broken: Bools,
    excess: Floats,
    sentence: Callable[[int], str],
) -> list[Violation]:
    """Return one violation per run of steps in which ``broken`` holds.

    ``excess`` says how badly, ``sentence`` what is wrong in a step of that index.
    """
    return [
        Violation(
            kind,
            (robot,),
            float(track.t[i]),
            (float(track.x[i]), float(track.y[i])),
            None,
            sentence(i),
        )
        for i in episodes(broken, excess)
    ]
