"""Motion models handed to the native core as its tables."""

import math

from clearway import _core
from clearway.model import to_ticks
from clearway.motion.model import Curve, Mode, Motion, MotionModel

NO_MODE = 63  # bit of a robot at rest that has not moved yet

FAMILIES = {
    "reeds_shepp": _core.Family.REEDS_SHEPP,
    "turn_drive_turn": _core.Family.TURN_DRIVE_TURN,
    "slide": _core.Family.SLIDE,
    "translate": _core.Family.TRANSLATE,
}


def native_table(model: MotionModel) -> _core.MotionTable:
    """Return the core's table of a motion model; modes are numbered in the model's order."""
    number = {mode.name: i for i, mode in enumerate(model.modes)}
    table = _core.MotionTable()
    table.headings = model.headings
    table.top_speed = model.top_speed
    table.rest = [mode.rest for mode in model.modes]
    table.switch_duration = to_ticks(model.mode_switch)
    table.has_modes = model.has_modes
    table.turn_arm = model.turn_arm
    table.primitives = [_primitive(model, motion, number) for motion in model.motions]
    table.connections = [_connection(model, curve, number) for curve in model.curves]
    if math.isfinite(model.acceleration):
        table.acceleration, table.deceleration = model.acceleration, model.deceleration
        table.paces = [_pace(model, mode, number) for mode in model.modes]
    return table


def _primitive(model: MotionModel, motion: Motion, number: dict[str, int]) -> _core.Primitive:
    native = _core.Primitive(
        number[motion.mode],
        _core.Twist(*motion.twist),
        motion.turn_steps,
        to_ticks(motion.duration),
    )
    if motion.enters:
        at_rest = any(model.mode(name).rest for name in motion.enters)
        native.allowed_from = sum(1 << number[name] for name in motion.enters) | at_rest << NO_MODE
    moving = number[model.mode(motion.mode).moving]
    a, b, c = motion.twist
    native.steps = [
        _core.Step(moving, _core.Twist(share * a, share * b, share * c), to_ticks(seconds))
        for share, seconds in motion.pieces
    ]
    return native


def _pace(model: MotionModel, mode: Mode, number: dict[str, int]) -> _core.Pace:
    """Return what a mode is at its speed; its course is the first mode it may change with."""
    first = mode.moving
    if mode.direction is not None and not model.mode_switch:
        first = next(other.name for other in model.modes if other.direction == mode.direction)
    return _core.Pace(number[mode.moving], number[first], mode.pace)


def _connection(model: MotionModel, curve: Curve, number: dict[str, int]) -> _core.Connection:
    top = {mode.name: mode.speed for mode in model.modes}
    # Curved travel never turns faster than the yaw rate allows.
    arc = model.yaw_rate * curve.radius

    def index(name: str | None) -> int:
        return -1 if name is None else number[name]

    def straight_speed(name: str | None) -> float:
        return 0.0 if name is None else top[name]

    def arc_speed(left: str | None, right: str | None) -> float:
        if left is None or right is None:
            return 0.0
        return min(top[left], top[right], arc)

    native = _core.Connection()
    native.family = FAMILIES[curve.family]
    native.direction = curve.direction
    native.radius = curve.radius
    native.yaw_rate = model.yaw_rate
    native.forward, native.forward_left, native.forward_right = map(index, curve.ahead)
    native.reverse, native.reverse_left, native.reverse_right = map(index, curve.back)
    native.rotate_left, native.rotate_right = map(index, curve.spin)
    if curve.sideways:
        native.left, native.right = map(index, curve.sideways)
        native.sideways_speed = min(top[name] for name in curve.sideways)
    native.forward_speed = straight_speed(curve.ahead[0])
    native.reverse_speed = straight_speed(curve.back[0])
    if curve.family == "translate" and curve.ahead[0]:
        native.reverse_speed = model.mode(curve.ahead[0]).part_backwards
    native.forward_arc_speed = arc_speed(curve.ahead[1], curve.ahead[2])
    native.reverse_arc_speed = arc_speed(curve.back[1], curve.back[2])
    return native
