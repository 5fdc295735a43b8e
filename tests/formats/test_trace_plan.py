"""A trace as the plan that it turned out to be."""

from typing import Any

import numpy as np
import pytest

from clearway.formats.trace_plan import plan_of
from clearway.model import Footprint, Limits, Pose, Robot, RobotType, Site, Status, Trace, Visit

END = {"event": "end", "t": 9.0, "status": "done", "makespan": 4.0}


def motion(robot: str, t: list[float], x: list[float], **more: Any) -> dict[str, Any]:
    still = np.zeros(len(t))
    arrays = {"t": np.array(t), "x": np.array(x), "y": still, "theta": still}
    return {"event": "motion", "robot": robot, **arrays, **more}


def visit(t: float, state: str, task: str | None = "t1", **more: Any) -> dict[str, Any]:
    event = {"event": "visit", "t": t, "robot": "a", "task": task, "order": task, "state": state}
    return event | ({"pose": [2.0, 0.0, 0.0], "service": 1.0} if state == "arrived" else {}) | more


def trace(*events: dict[str, Any], end: dict[str, Any] | None = END) -> Trace:
    kind = RobotType("cart", Footprint.rectangle(1.0, 1.0), "holonomic", Limits(speed=1.0))
    return Trace(
        scenario="lane",
        system="by hand",
        seed=4,
        site=Site(((-5.0, -5.0), (20.0, -5.0), (20.0, 5.0), (-5.0, 5.0))),
        robot_types={"cart": kind},
        robots=(Robot("a", "cart", Pose(0.0, 0.0, 0.0)), Robot("b", "cart", Pose(9.0, 0.0, 0.0))),
        events=(*events, *([] if end is None else [end])),
        is_whole=end is not None,
        parameters={},
        version="0",
    )


def test_pieces_are_joined_by_standing() -> None:
    """Two seconds of motion from 1 s on, a rest of three, and one more."""
    plan = plan_of(trace(motion("a", [1.0, 3.0], [0.0, 2.0]), motion("a", [6.0, 7.0], [2.0, 3.0])))
    track = plan.tracks["a"]
    assert track.t.tolist() == [0.0, 1.0, 3.0, 6.0, 7.0]
    assert track.x.tolist() == [0.0, 0.0, 2.0, 2.0, 3.0]
    assert "b" not in plan.tracks, "it has stood at its start all the time"


def test_modes_stand_between_pieces() -> None:
    plan = plan_of(
        trace(
            motion("a", [1.0, 2.0], [0.0, 1.0], mode=["forward", "forward"]),
            motion("a", [4.0, 5.0], [1.0, 0.0], mode=["reverse", "reverse"]),
        )
    )
    assert plan.tracks["a"].mode == ("stop", "forward", "stop", "reverse", "stop")


def test_costs_are_last_arrivals() -> None:
    """Robot a stands from 3 s on though its samples go on to 5 s; b comes to rest at 4 s."""
    plan = plan_of(
        trace(motion("a", [1.0, 3.0, 5.0], [0.0, 2.0, 2.0]), motion("b", [0.0, 4.0], [9.0, 5.0]))
    )
    assert (plan.sum_of_costs, plan.makespan) == (7.0, 4.0)


def test_nobody_moved() -> None:
    plan = plan_of(trace())
    assert (plan.tracks, plan.sum_of_costs, plan.makespan) == ({}, 0.0, 0.0)


def test_visits_are_those_arrived_at_in_order() -> None:
    """Charging has no task; the visit that is not over belongs to the plan, too."""
    plan = plan_of(
        trace(
            motion("a", [0.0, 2.0], [0.0, 2.0]),
            visit(2.0, "arrived", load="pick"),
            visit(3.0, "left"),
            visit(3.0, "arrived", task=None),
            visit(4.0, "left", task=None),
            visit(5.0, "arrived", "t2"),
        )
    )
    at = Pose(2.0, 0.0, 0.0)
    assert plan.tours["a"] == (
        Visit("t1", at, 1.0, "pick", not_before=2.0),
        Visit(None, at, 1.0, None, not_before=3.0),
        Visit("t2", at, 1.0, None, not_before=5.0),
    )
    assert plan.tours["b"] == ()
    assert plan.assignment == {"a": ("t1", "t2"), "b": ()}


@pytest.mark.parametrize(
    ("status", "reason"),
    [
        ("ended", "over"),
        ("stuck", "stuck"),
        ("stopped", "budget"),
        ("interrupted", "interrupted"),
        (None, "cut"),
    ],
)
def test_only_what_is_done_is_solved(status: str | None, reason: str) -> None:
    assert plan_of(trace()).status is Status.SOLVED
    plan = plan_of(trace(end=None if status is None else {**END, "status": status}))
    assert plan.status is Status.STOPPED
    assert plan.reason is not None and reason in plan.reason
