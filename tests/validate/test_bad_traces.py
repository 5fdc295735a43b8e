"""One wrong trace of each kind, and right traces that are nearly wrong."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from clearway.formats.trace_file import dump_trace, read_trace
from clearway.model import Obstacle, Pose
from clearway.validate import validate_trace
from clearway.validate.violation import KINDS, TRACE_KINDS

DATA = Path(__file__).parents[1] / "data" / "bad_traces"
WRONG = sorted(path.stem for path in DATA.glob("*.jsonl"))
# What a trace is judged for with the plan judge's own parts, which bad_plans tests.
AS_IN_PLANS = {"clock", "start", "speed", "obstacle", "bounds", "zone", "conflict"}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_trace_is_wrong_in_exactly_its_one_way(name: str) -> None:
    """A trace with one thing wrong has one violation, of the kind in the file's name."""
    found = validate_trace(read_trace(DATA / f"{name}.jsonl"))
    assert [violation.kind for violation in found] == [name.split("--")[0]]


def test_there_is_a_wrong_trace_of_every_kind() -> None:
    """Whatever only a trace can have wrong, a file shows."""
    kinds = {name.split("--")[0] for name in WRONG}
    assert kinds == {*TRACE_KINDS, *AS_IN_PLANS, "visit", "service"}
    assert kinds <= {*KINDS, *TRACE_KINDS}


def test_the_files_are_those_that_the_script_makes(traces) -> None:
    """The wrong traces can be made again, byte for byte."""
    made = {name: dump_trace(trace) for name, trace in traces.wrong_traces().items()}
    assert made == {path.stem: path.read_text() for path in DATA.glob("*.jsonl")}


def test_right_traces_are_right(traces) -> None:
    """Bodies may leave what is closed about them, pass while small, and stop anywhere."""
    for name, trace in traces.right_traces().items():
        assert validate_trace(trace) == [], name


def test_a_conflict_is_told_at_its_worst_moment(traces) -> None:
    """Two carts that meet head on, 1 m long and 2 m apart, overlap most when they stop."""
    (found,) = validate_trace(traces.wrong_traces()["conflict"])
    assert found.robots == ("a", "b")
    assert found.time == pytest.approx(2.5, abs=0.3)
    assert found.depth == pytest.approx(0.6, abs=0.01)


def test_a_closed_zone_is_entered_at_the_clock_of_the_trace(traces) -> None:
    """A cart at 1 m/s reaches a zone 0.5 m ahead of its bumper after half a second."""
    story = traces.spilt(0.25)
    (found,) = validate_trace(story.trace(status="ended"))
    assert found.kind == "zone"
    assert 0.5 < found.time <= 3.0
    assert "spill" in found.text


def test_a_zone_may_be_opened_and_closed_again(traces) -> None:
    """What is entered while it is open may be left, but not entered again, once it is closed."""
    story = traces.spilt(0.0, 0.4)
    spill = {"kind": "obstacle", "zone": "spill", "polygon": traces.SPILL}
    story.tell("fault", 3.0, **spill, state="closed")
    story.drive("a", 2.0)
    assert validate_trace(story.trace(status="ended")) == []
    story.drive("a", -2.0)
    (found,) = validate_trace(story.trace(status="ended"))
    assert found.kind == "zone"
    assert found.time > 5.0


def test_obstacles_may_stop_the_loaded_only(traces) -> None:
    """A shelf is passed under with nothing on board, and hit once something is."""
    shelf = Obstacle(polygon=((6.0, 4.0), (7.0, 4.0), (7.0, 6.0)), blocks=("cart:loaded",))
    story = traces.drives(3.0, site=replace(traces.FLOOR, obstacles=(shelf,)))
    assert validate_trace(story.trace(status="ended")) == []
    story.tell("load", 0.2, robot="a", objects=["S1"])
    assert {v.kind for v in validate_trace(story.trace(status="ended"))} == {"obstacle"}


def test_a_long_stand_is_checked_like_any_motion(traces) -> None:
    """A cart that stands for an hour in another's way is met there."""
    story = traces.Story({"a": Pose(8.0, 5.0, 0.0), "b": Pose(2.0, 5.0, 0.0)})
    story.stand("b", 3600.0)
    story.drive("b", 5.5)
    (found,) = validate_trace(story.trace(status="ended"))
    assert found.kind == "conflict"
    assert found.time > 3604.0


def test_a_heading_may_jump_where_nothing_limits_turning(traces) -> None:
    """A robot that turns at once may do so between two pieces, with or without a pause."""
    for pause in (0.0, 2.0):
        story = traces.drives(1.0)
        story.kind = replace(
            traces.CART, limits=replace(traces.CART.limits, yaw_rate=None), kinematics="holonomic"
        )
        story.stand("a", pause)
        story.at["a"] = story.at["a"]._replace(theta=np.pi / 2)
        story.drive("a", 1.0)
        assert validate_trace(story.trace(status="ended")) == []
        limits = replace(traces.CART.limits, yaw_rate=1.0)
        story.kind = replace(story.kind, limits=limits)
        assert [v.kind for v in validate_trace(story.trace(status="ended"))] == ["gap"]


def test_a_trip_cut_short_is_judged_up_to_there(traces) -> None:
    """However a trace of a right run is cut, nothing in it is wrong."""
    trace = traces.right()
    for count in range(len(trace.events)):
        cut = replace(trace, events=trace.events[:count], is_whole=False)
        assert validate_trace(cut) == [], count
