"""The figures of a plan small enough to work out by hand."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from clearway.metrics import Activity, activities, plan_metrics, to_json, visit_times
from clearway.model import (
    Footprint,
    Limits,
    PlanRecord,
    Pose,
    Robot,
    RobotType,
    Site,
    Status,
    Stop,
    Track,
    Trajectory,
    Visit,
)

PI = math.pi


def small_record(**changes) -> PlanRecord:
    """Return a plan of two robots in a hall of 20 m by 10 m.

    ``a`` drives 4 m along x in 4 s, serves task ``one`` for 3 s, waits 1 s, turns on the spot
    by 90 degrees in 2 s, drives 2 m along y in 2 s (arriving at 12 s) and serves ``two``
    for 5 s there. ``b`` has no track and stands at its start.
    """
    t = np.array([0.0, 2.0, 4.0, 8.0, 9.0, 10.0, 12.0, 20.0])
    x = np.array([1.0, 3.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0])
    y = np.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 3.0, 3.0])
    theta = np.array([0, 0, 0, 0, PI / 4, PI / 2, PI / 2, PI / 2])
    mode = ("forward",) * 2 + ("stop",) + ("rotate-left",) * 2 + ("forward",) + ("stop",) * 2
    fields = {
        "scenario": "small",
        "system": "by hand",
        "seed": 0,
        "status": Status.SOLVED,
        "site": Site(((0, 0), (20, 0), (20, 10), (0, 10))),
        "robot_types": {
            "cart": RobotType("cart", Footprint(radius=0.4), "differential", Limits(1.0))
        },
        "robots": (Robot("a", "cart", Pose(1, 1, 0)), Robot("b", "cart", Pose(15, 5, 0))),
        "tours": {
            "a": (Visit("one", Pose(5, 1, 0), 3.0), Visit("two", Pose(5, 3, PI / 2), 5.0)),
        },
        "tracks": {"a": Track(t, x, y, theta, mode)},
        "assignment": {"a": ("one", "two")},
        "sum_of_costs": 12.0,
        "makespan": 12.0,
        "lower_bound": 10.0,
    }
    return PlanRecord(**{**fields, **changes})


def test_a_robot_drives_serves_waits_and_turns():
    """4 s drive, 3 s service, 1 s wait, 2 s turn, 2 s drive, then 5 s service at the end."""
    assert activities(small_record()) == {
        "a": [
            Activity("drive", 0.0, 4.0, "one"),
            Activity("service", 4.0, 7.0, "one"),
            Activity("wait", 7.0, 8.0, "two"),
            Activity("turn", 8.0, 10.0, "two"),
            Activity("drive", 10.0, 12.0, "two"),
            Activity("service", 12.0, 17.0, "two"),
        ],
        "b": [],
    }


def test_exact_paths_say_when_the_visit_is_made():
    """With the stop at 5 s to 8 s, the second at rest before it is waiting."""
    path = Trajectory("a", Pose(1, 1, 0), stops=(Stop(0, 5000, 8000),))
    done = activities(small_record(paths={"a": path}))["a"]
    assert done[:3] == [
        Activity("drive", 0.0, 4.0, "one"),
        Activity("wait", 4.0, 5.0, "one"),
        Activity("service", 5.0, 8.0, "one"),
    ]
    assert done[-1] == Activity("drive", 10.0, 12.0, "two")


def test_the_figures_of_the_small_plan():
    """6 m in 12 s; of 17 s, 6 s driving + 2 s turning + 8 s service = 16 s are used."""
    metrics = plan_metrics(small_record(), [("a", "b", 9.2, 12.0)], 0)
    a, b = metrics.per_robot
    assert (a.distance, a.arrival) == pytest.approx((6.0, 12.0))
    assert (a.driving, a.turning, a.waiting, a.service) == pytest.approx((6.0, 2.0, 1.0, 8.0))
    assert a.utilisation == pytest.approx(16 / 17)
    assert (b.distance, b.arrival, b.utilisation, b.finished) == (0.0, 0.0, 0.0, True)
    assert metrics.duration == pytest.approx(17.0)
    assert metrics.distance == pytest.approx(6.0)
    assert metrics.gap == pytest.approx(0.2)
    assert (metrics.tasks, metrics.tasks_done) == (2, 2)


def test_without_a_bound_there_is_no_gap():
    """A gap compares with a bound; a bound of none, or of nothing, compares with nothing."""
    assert plan_metrics(small_record(lower_bound=None), [], 0).gap is None
    assert plan_metrics(small_record(lower_bound=0.0), [], 0).gap is None


def test_tasks_finished_after_they_are_due_are_late():
    """``one`` is finished at 7 s, 2 s late; ``two`` at 17 s, in time; nothing due, nothing told."""
    visits = (Visit("one", Pose(5, 1, 0), 3.0, due=5.0), Visit("two", Pose(5, 3, PI / 2), 5.0))
    for later, late in ((None, 2.0), (18.0, 2.0), (16.5, 2.5)):
        record = small_record(tours={"a": (visits[0], replace(visits[1], due=later))})
        assert plan_metrics(record, [], 0).tardiness == pytest.approx(late)
    assert plan_metrics(small_record(), [], 0).tardiness is None


def test_a_visit_begins_no_sooner_than_it_may():
    """Standing there from 4 s to 8 s, ``one`` takes from 4.5 s to 7.5 s if it must wait so long."""
    visit = Visit("one", Pose(5, 1, 0), 3.0, not_before=4.5)
    record = small_record(tours={"a": (visit,)})
    assert [(m.arrive, m.leave) for m in visit_times(record, record.robots[0])] == [(4.5, 7.5)]


def test_the_closest_pair_comes_first():
    """The least separation of all is the smallest of the pairs'."""
    pairs = [("a", "b", 2.0, 1.0), ("a", "c", 0.5, 7.0), ("b", "c", 1.0, 3.0)]
    content = to_json(plan_metrics(small_record(), pairs, 3))
    assert content["least_separation"] == {"robots": ["a", "c"], "metres": 0.5, "time": 7.0}
    assert [entry["metres"] for entry in content["separations"]] == [0.5, 1.0, 2.0]
    assert content["violations"] == 3
    assert content["per_robot"]["a"]["tasks"] == ["one", "two"]
    assert json.loads(json.dumps(content)) == content


def test_a_visit_cut_short_is_not_made():
    """A service of 5 s does not fit in a rest of 4 s, so the robot has made no visit."""
    tours = {"a": (Visit("one", Pose(5, 1, 0), 5.0), Visit("two", Pose(5, 3, PI / 2), 5.0))}
    record = small_record(tours=tours)
    assert visit_times(record, record.robots[0]) == ()
    metrics = plan_metrics(record, [], 0)
    assert not metrics.per_robot[0].finished
    assert (metrics.tasks, metrics.tasks_done) == (2, 0)


def test_a_robot_too_far_or_askew_makes_no_visit():
    """2 cm beside the pose, or 2 degrees askew, is not at it."""
    for pose in (Pose(5, 1.02, 0), Pose(5, 1, math.radians(2))):
        record = small_record(tours={"a": (Visit("one", pose, 1.0),)})
        assert visit_times(record, record.robots[0]) == ()


def test_creeping_below_five_micrometres_a_step_is_rest():
    """Rounding noise neither moves a robot nor delays its arrival."""
    noise = 4e-6
    track = Track(
        np.array([0.0, 1.0, 1.1, 1.2]),
        np.array([0.0, 1.0, 1.0 + noise, 1.0]),
        np.zeros(4),
        np.array([0.0, 0.0, noise, 0.0]),
        (None,) * 4,
    )
    metrics = plan_metrics(small_record(tracks={"a": track}, tours={}), [], 0)
    assert metrics.per_robot[0].arrival == 1.0
    assert metrics.per_robot[0].distance == 1.0


def test_heading_wraps_the_short_way():
    """From 179 to -179 degrees is a turn of two degrees on the spot, not a drive."""
    theta = np.radians([179.0, -179.0])
    track = Track(np.array([0.0, 1.0]), np.zeros(2), np.zeros(2), theta, (None,) * 2)
    done = activities(small_record(tracks={"a": track}, tours={}))["a"]
    assert done == [Activity("turn", 0.0, 1.0, "")]
