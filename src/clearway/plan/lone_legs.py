"""How long single legs last with nobody else on the site, by the planner's own search."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clearway import _core
from clearway.model import TICKS_PER_SECOND, Pose, RobotType, Site
from clearway.plan.native_team import native_model


class Drive(NamedTuple):
    """From a pose to another, with or without a load."""

    start: Pose
    goal: Pose
    loaded: bool = False


def lone_seconds(
    site: Site, robot_type: RobotType, drives: Sequence[Drive], params: _core.TeamParams
) -> NDArray[np.float64]:
    """Return how long each drive lasts (s); NaN where a search finds no way.

    All are searched for in one native call, which an interrupt ends.
    """
    reach = max(robot_type.shape(loaded).circumradius for loaded in (False, True))
    model = native_model(site, robot_type, reach)
    bodies = (0, model.num_bodies - 1)
    legs = [
        _core.LoneLeg(_core.Pose(*drive.start), _core.Pose(*drive.goal), bodies[drive.loaded])
        for drive in drives
    ]
    ticks = np.array(_core.lone_durations(model, params, legs), dtype=np.float64)
    return np.where(ticks < 0.0, np.nan, ticks / TICKS_PER_SECOND)
