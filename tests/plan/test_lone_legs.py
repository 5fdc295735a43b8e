"""Single legs, driven with nobody else on the site."""

import math

import pytest
from tests.plan.rooms import CART, EAST, WEST, block, room

from clearway.model import Pose
from clearway.plan import TeamParams
from clearway.plan.lone_legs import Drive, lone_seconds


def test_each_drive_has_its_own_time():
    """8 m and 3 m at 1 m/s, in the order asked."""
    start = Pose(1.0, 2.0, EAST)
    drives = [Drive(start, Pose(9.0, 2.0, EAST)), Drive(start, Pose(4.0, 2.0, EAST))]
    seconds = lone_seconds(room(12.0, 4.0), CART, drives, TeamParams())
    assert seconds.tolist() == pytest.approx([8.0, 3.0], abs=0.01)


def test_where_no_way_is_found_none_is_told():
    """A wall across the room; the drive on this side of it is found all the same."""
    site = room(12.0, 4.0, block(6.0, 0.0, 7.0, 4.0))
    start = Pose(1.0, 2.0, EAST)
    drives = [Drive(start, Pose(9.0, 2.0, EAST)), Drive(start, Pose(4.0, 2.0, EAST))]
    through, beside = lone_seconds(site, CART, drives, TeamParams())
    assert math.isnan(through)
    assert beside == pytest.approx(3.0, abs=0.01)


def test_who_is_there_already_needs_no_time():
    """From a pose to itself; turning there takes pi at 0.8 rad/s."""
    here = Pose(5.0, 2.0, EAST)
    drives = [Drive(here, here), Drive(here, Pose(5.0, 2.0, WEST))]
    stay, turn = lone_seconds(room(12.0, 4.0), CART, drives, TeamParams())
    assert stay == 0.0
    assert turn == pytest.approx(math.pi / 0.8, abs=0.01)


def test_no_drives_no_times():
    """Nothing is searched for."""
    assert lone_seconds(room(12.0, 4.0), CART, [], TeamParams()).tolist() == []
