"""How robots move: one page of data per kind, made into tables before search begins."""

from collections.abc import Callable

from clearway.model import RobotType
from clearway.model.robot import Kinematics
from clearway.motion.car import car
from clearway.motion.differential import differential
from clearway.motion.forklift import forklift
from clearway.motion.four_wheel import four_wheel
from clearway.motion.holonomic import holonomic
from clearway.motion.lattice import LATTICE_HEADINGS, lattice_model
from clearway.motion.model import Curve, Mode, Motion, MotionModel
from clearway.motion.ramps import ramped

# By name: the kinematics it fits, and how it is built for a type and a number of headings.
MODELS: dict[str, tuple[Kinematics, Callable[[RobotType, int], MotionModel]]] = {
    "car": ("ackermann", car),
    "forklift": ("ackermann", forklift),
    "four_wheel": ("four_wheel", four_wheel),
    "differential": ("differential", differential),
    "holonomic": ("holonomic", holonomic),
}


def models_for(kinematics: Kinematics) -> tuple[str, ...]:
    """Return the names of the models that fit, that of types which name none first."""
    return tuple(name for name, (fits, _) in MODELS.items() if fits == kinematics)


def model_of(robot_type: RobotType, headings: int) -> MotionModel:
    """Return the model that the type names, or the one for its kinematics.

    Where the type limits acceleration, its motions are ramps.
    """
    model = _unlimited(robot_type, headings)
    return ramped(model, robot_type.limits) if robot_type.limits.has_ramps else model


def can_ramp(robot_type: RobotType) -> bool:
    """Return whether limits on acceleration can be kept: by modes of one direction of travel."""
    return all(mode.direction != "any" for mode in _unlimited(robot_type, 16).modes)


def _unlimited(robot_type: RobotType, headings: int) -> MotionModel:
    _, build = MODELS[robot_type.motion or models_for(robot_type.kinematics)[0]]
    return build(robot_type, headings)


__all__ = [
    "LATTICE_HEADINGS",
    "MODELS",
    "Curve",
    "Mode",
    "Motion",
    "MotionModel",
    "can_ramp",
    "car",
    "differential",
    "forklift",
    "four_wheel",
    "holonomic",
    "lattice_model",
    "model_of",
    "models_for",
    "ramped",
]
