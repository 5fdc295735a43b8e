"""How far a robot's lone plan would be at each place that it passes in the team's plan."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from clearway.metrics.motion import Floats, track_of
from clearway.metrics.visits import visit_times
from clearway.model import PlanRecord, Robot, Track

# Seconds between samples of the team's motion and of the lone one.
TEAM, LONE = 0.2, 0.05
# A radian of heading counts like so many metres when places are compared.
RADIAN = 1.0
# Pace is measured over this many seconds.
WINDOW = 2.0


class LoneClock(NamedTuple):
    """A robot's motion among others, with the time its lone plan would show at each place.

    Parameters
    ----------
    times, x, y, speed
        Shape ``(n,)``: s, m, m, m/s, of the team's plan, while the robot is on its way.
    alone
        The lone plan's time at the matching place (s); it never falls.
    away
        Distance from that place (m), a radian of heading counting as a metre.
    pace
        Seconds of the lone plan per second of the team's, over two seconds around.
    """

    times: Floats
    x: Floats
    y: Floats
    speed: Floats
    alone: Floats
    away: Floats
    pace: Floats


def lone_clock(record: PlanRecord, lone: PlanRecord, robot: Robot) -> LoneClock:
    """Match the team's plan of a robot with its lone plan, leg by leg.

    Within a leg, from the end of one service to the next arrival, places are matched in order
    for the least sum of distances. Services are left out: they take equally long in both.
    """
    team_track, lone_track = track_of(record, robot), track_of(lone, robot)
    parts = [
        _leg(team_track, lone_track, team, alone)
        for team, alone in zip(_legs(record, robot), _legs(lone, robot), strict=False)
        if team[1] - team[0] > TEAM
    ]
    if not parts:
        return LoneClock(*(np.zeros(0) for _ in LoneClock._fields))
    return LoneClock(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def _legs(record: PlanRecord, robot: Robot) -> list[tuple[float, float]]:
    """Return begin and end (s) of each leg: from the end of a service to the next arrival."""
    tour = record.tours.get(robot.id, ())
    ends, begins = [], [0.0]
    for made in visit_times(record, robot):
        ends.append(made.arrive)
        begins.append(made.arrive + tour[made.visit].service)
    return list(zip(begins, ends, strict=False))


def _leg(
    team: Track, lone: Track, span: tuple[float, float], alone: tuple[float, float]
) -> LoneClock:
    times, there = _grid(span, TEAM), _grid(alone, LONE)
    here, ways = _places(team, times), _places(lone, there)
    match, away = _in_order(here, ways)
    shown = there[match]
    speed = np.hypot(*np.diff(here[:, :2], axis=0).T) / np.diff(times)
    half = max(round(0.5 * WINDOW / TEAM), 1)
    index = np.arange(len(times))
    low, high = np.maximum(index - half, 0), np.minimum(index + half, len(times) - 1)
    pace = (shown[high] - shown[low]) / (times[high] - times[low])
    return LoneClock(times, here[:, 0], here[:, 1], np.append(speed, speed[-1]), shown, away, pace)


def _grid(span: tuple[float, float], step: float) -> Floats:
    begin, end = span
    return np.linspace(begin, end, max(round((end - begin) / step), 1) + 1)


def _places(track: Track, times: Floats) -> Floats:
    """Return positions and headings, shape ``(n, 3)``."""
    theta = np.unwrap(track.theta)
    return np.stack([np.interp(times, track.t, v) for v in (track.x, track.y, theta)], axis=1)


def _in_order(
    here: Floats, ways: Floats
) -> tuple["np.ndarray[tuple[int], np.dtype[np.intp]]", Floats]:
    """Return for each place the number of the matching one, never falling, and the distance."""
    best = np.zeros(len(ways))
    came = np.empty((len(here), len(ways)), dtype=np.intp)
    far = np.empty((len(here), len(ways)))
    for i, place in enumerate(here):
        turn = np.abs(np.remainder(ways[:, 2] - place[2] + np.pi, 2.0 * np.pi) - np.pi)
        far[i] = np.hypot(ways[:, 0] - place[0], ways[:, 1] - place[1]) + RADIAN * turn
        # The least so far at or before each match, and where that was.
        least = np.minimum.accumulate(best)
        is_new = np.r_[True, best[1:] < least[:-1]]
        came[i] = np.maximum.accumulate(np.where(is_new, np.arange(len(best)), 0))
        best = least + far[i]
    match = np.empty(len(here), dtype=np.intp)
    match[-1] = int(best.argmin())
    for i, before in pairwise(range(len(here) - 1, -1, -1)):
        match[before] = came[i, match[i]]
    return match, far[np.arange(len(here)), match]
