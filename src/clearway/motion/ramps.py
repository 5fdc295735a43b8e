"""Motions that keep limits on acceleration: a speed is part of the mode, a ramp is a motion.

The judge looks at mean speeds of neighbouring 0.2 s, so that a ramp may be a staircase of even
speeds of 0.1 s each.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from clearway import _core
from clearway.model import Limits, to_seconds, to_ticks
from clearway.motion.model import Mode, Motion, MotionModel

# Of the limits: durations in whole ticks may make a change of speed a little sharper.
SHARE = 0.95
# Speeding up and slowing down follow each other where a robot turns round. A mean over both
# shows up to a tenth more than the lower limit if the other one is twice as high.
LARGEST_RATIO = 2.0
SLOW = 1.0 / 3.0  # the slowest speed level, of the top speed
LIKE = 0.05  # levels that differ by this share are one
NO_MORE = 1.0 + 1e-9  # what rounding may add to a speed
LARGEST_TURN = math.pi / 2.0  # of a ramp on an arc


def ramped(model: MotionModel, limits: Limits) -> MotionModel:
    """Return the model with speed levels as modes and ramps as motions.

    Modes keep their names and are those at rest; ``forward@0.8`` is ``forward`` at 0.8 m/s. At
    speed a mode may follow another of the same direction of travel, unless a change of mode
    takes time. From rest to rest every motion of the model is kept, so that whatever can be
    reached at all is reached.
    """
    if any(mode.direction == "any" for mode in model.modes):
        raise ValueError("ramps need modes of one direction of travel each, not of any")
    up, down = limits.acceleration or math.inf, limits.deceleration or math.inf
    up, down = min(up, LARGEST_RATIO * down), min(down, LARGEST_RATIO * up)
    model = replace(model, acceleration=SHARE * up, deceleration=SHARE * down)
    modes: list[Mode] = list(model.modes)
    motions: list[Motion] = []
    for course in _courses(model):
        levels = _levels(model, course)
        modes += [
            Mode(f"{mode.name}@{level:.3g}", mode.direction, mode.turn, level, False, of=mode.name)
            for mode in course
            for level in levels
            if level <= mode.speed * NO_MORE
        ]
        names = {mode.name for mode in course}
        for motion in model.motions:
            if motion.mode in names:
                motions += _ramps(model, modes, motion, levels)
    spins = [
        replace(motion, enters=tuple(mode.name for mode in modes if mode.rest))
        for motion in model.motions
        if not motion.length
    ]
    return replace(model, modes=tuple(modes), motions=(*motions, *spins))


def _courses(model: MotionModel) -> list[list[Mode]]:
    """Return the modes that travel, those of one direction together."""
    courses: dict[float, list[Mode]] = {}
    for mode in model.modes:
        if isinstance(mode.direction, float):
            courses.setdefault(mode.direction, []).append(mode)
    return list(courses.values())


def _levels(model: MotionModel, course: list[Mode]) -> list[float]:
    """Return speeds (m/s), upwards: a slow one, and those of the motions of a course.

    At a level the shortest motion takes whole ticks, so that driving on is even.
    """
    names = {mode.name for mode in course}
    motions = [motion for motion in model.motions if motion.mode in names]
    if not motions:
        return []
    step = min(motion.length for motion in motions)
    tops = sorted({motion.length / motion.duration for motion in motions})
    slower = min(model.acceleration, model.deceleration)
    levels = [min(SLOW * tops[-1], math.sqrt(2.0 * slower * step))]
    for top in tops:
        if top * (1.0 - LIKE) > levels[-1]:
            levels.append(top)
    return [min(level, step / to_seconds(to_ticks(step / level))) for level in levels]


def _ramps(
    model: MotionModel, modes: list[Mode], motion: Motion, levels: list[float]
) -> Iterator[Motion]:
    """Yield a motion from each speed to each, as many steps long as it takes."""
    (mode,) = (mode for mode in modes if mode.name == motion.mode)
    top = motion.length / motion.duration
    speeds = [0.0, *(level for level in levels if level <= top * NO_MORE)]
    for enter in speeds:
        enters = tuple(other.name for other in modes if _may_follow(model, mode, other, enter))
        for leave in speeds:
            fastest = max(enter, leave) or top
            change = abs(enter**2 - leave**2) / 2.0
            rate = model.acceleration if leave > enter else model.deceleration
            steps = max(1, math.ceil(change / rate / motion.length - 1e-12))
            if steps * abs(motion.twist[2]) > LARGEST_TURN and steps > 1:
                continue
            length = steps * motion.length
            ramp = _core.ramp(length, enter, leave, fastest, model.acceleration, model.deceleration)
            pieces = tuple((way / length, to_seconds(ticks)) for way, ticks in ramp)
            twist = (motion.twist[0] * steps, motion.twist[1] * steps, motion.twist[2] * steps)
            yield Motion(
                next(m.name for m in modes if m.moving == mode.name and m.pace == leave),
                twist,
                motion.turn_steps * steps,
                math.fsum(seconds for _, seconds in pieces),
                enters,
                pieces,
            )


def _may_follow(model: MotionModel, mode: Mode, before: Mode, speed: float) -> bool:
    """Whether ``mode`` may begin at a speed in a robot that is in the mode ``before``."""
    if before.pace != speed:
        return False
    if not speed:
        return before.rest
    same = before.moving == mode.name
    return same or (before.direction == mode.direction and not model.mode_switch)
