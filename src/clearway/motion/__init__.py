"""How robots move: one page of data per kind, made into tables before search begins."""

from collections.abc import Callable

from clearway.model import RobotType
from clearway.motion.car import car
from clearway.motion.four_wheel import four_wheel
from clearway.motion.model import Curve, Mode, Motion, MotionModel

MODELS: dict[str, Callable[[RobotType, int], MotionModel]] = {
    "ackermann": car,
    "four_wheel": four_wheel,
}

__all__ = ["MODELS", "Curve", "Mode", "Motion", "MotionModel", "car", "four_wheel"]
