"""Which motion model a robot type has."""

from dataclasses import replace

import pytest

from clearway.model import Footprint, Limits, RobotType
from clearway.model.robot import KINEMATICS
from clearway.motion import MODELS, car, forklift, model_of, models_for

TRUCK = RobotType(
    "truck", Footprint.rectangle(2.0, 1.0), "ackermann", Limits(speed=1.0, turning_radius=1.5)
)


@pytest.mark.parametrize(
    ("kinematics", "names"),
    [
        ("ackermann", ("car", "forklift")),
        ("four_wheel", ("four_wheel",)),
        ("differential", ("differential",)),
        ("holonomic", ("holonomic",)),
    ],
)
def test_what_fits_the_rules_of_a_kinematics(kinematics, names):
    """The first is that of a type which names none."""
    assert models_for(kinematics) == names


def test_every_model_fits_kinematics_that_files_may_name():
    """There is no model that no type could have."""
    assert {fits for fits, _ in MODELS.values()} == set(KINEMATICS)


def test_a_type_has_the_model_that_it_names():
    """Else it is a car, for what has one unsteered axle."""
    assert model_of(TRUCK, 16) == car(TRUCK, 16)
    lift = replace(TRUCK, motion="forklift")
    assert model_of(lift, 32) == forklift(lift, 32)
