"""Thinned tracks stay close to the samples they stand for."""

import math

import numpy as np
import pytest

from clearway.model import PlanRecord, Track
from clearway.plot.thin import ThinTrack, thin


def unpacked(small: ThinTrack) -> np.ndarray:
    return np.cumsum([small.t, small.x, small.y, small.theta], axis=1) / 1000.0


def test_each_sample_is_within_5_mm_and_half_a_degree(warehouse_record: PlanRecord) -> None:
    """Linear interpolation of what is kept meets every sample that was dropped."""
    for track in warehouse_record.tracks.values():
        t, x, y, theta = unpacked(thin(track))
        apart = np.hypot(np.interp(track.t, t, x) - track.x, np.interp(track.t, t, y) - track.y)
        turned = np.interp(track.t, t, theta) - np.unwrap(track.theta)
        assert apart.max() <= 0.005
        assert np.abs(turned).max() <= math.radians(0.5)
        assert len(t) < 0.4 * len(track.t)


def test_a_straight_drive_needs_two_samples() -> None:
    """10 m at constant speed is its two ends, written as a value and a difference."""
    t = np.linspace(0.0, 10.0, 101)
    small = thin(Track(t, t, 0 * t, 0 * t, (None,) * 101))
    assert small == ThinTrack([0, 10000], [0, 10000], [0, 0], [0, 0])


def test_a_stop_of_one_sample_is_kept() -> None:
    """Drive 1 m, stand 0.1 s, drive on: both ends of the stand are corners."""
    t = np.array([0.0, 0.5, 1.0, 1.1, 1.6, 2.1])
    x = np.array([0.0, 0.5, 1.0, 1.0, 1.5, 2.0])
    small = thin(Track(t, x, 0 * t, 0 * t, (None,) * 6))
    assert unpacked(small)[0].tolist() == pytest.approx([0.0, 1.0, 1.1, 2.1])


def test_a_jump_of_heading_at_one_time_stays_a_jump() -> None:
    """Where turning takes no time, two samples share a moment, and both are kept."""
    t = np.array([0.0, 1.0, 1.0, 2.0])
    theta = np.array([0.0, 0.0, 1.5, 1.5])
    small = thin(Track(t, t, 0 * t, theta, (None,) * 4))
    kept = unpacked(small)
    assert kept[0].tolist() == [0.0, 1.0, 1.0, 2.0]
    assert kept[3].tolist() == [0.0, 0.0, 1.5, 1.5]


def test_one_sample_stays_one_sample() -> None:
    """A robot that stands for ever is one pose."""
    one = np.ones(1)
    small = thin(Track(0 * one, one, 2 * one, one, (None,)))
    assert small == ThinTrack([0], [1000], [2000], [1000])


def test_a_bend_too_slow_for_one_step_is_followed() -> None:
    """Speeds that change by 0.05 mm/s in a step, for a minute: 90 cm off the line, within 5 mm."""
    t = np.linspace(0.0, 60.0, 601)
    y = 0.5 * 5e-4 * t**2
    small = thin(Track(t, t, y, 1e-4 * t**2, (None,) * 601))
    kept, x, across, heading = unpacked(small)
    assert np.hypot(np.interp(t, kept, x) - t, np.interp(t, kept, across) - y).max() <= 0.005
    assert np.abs(np.interp(t, kept, heading) - 1e-4 * t**2).max() <= math.radians(0.5)
    assert len(kept) < 60
