"""Orders and the visits that come of them."""

import pytest

from clearway.model import Order, Pose, Task, Visit

HERE, THERE = Pose(1.0, 0.0, 0.0), Pose(5.0, 0.0, 0.0)


def test_the_first_visit_waits_and_the_last_one_is_due() -> None:
    """Released at 10 s, after ``a``, due at 60 s: the pick waits, the drop is due."""
    task = Task("b", (Visit("b", HERE, 2.0, "pick"), Visit("b", THERE, 3.0, "drop")))
    pick, drop = Order(task, release=10.0, due=60.0, after=("a",)).visits
    assert pick == Visit("b", HERE, 2.0, "pick", not_before=10.0, after=("a",))
    assert drop == Visit("b", THERE, 3.0, "drop", due=60.0)


def test_what_a_visit_says_itself_is_kept() -> None:
    """The later of two times counts, and all tasks that either names."""
    visit = Visit("b", HERE, not_before=20.0, after=("x",), due=30.0)
    assert Order(Task("b", (visit,)), release=10.0, after=("a",)).visits == (
        Visit("b", HERE, not_before=20.0, after=("x", "a"), due=30.0),
    )


def test_an_order_without_times_leaves_its_visits_as_they_are() -> None:
    """Nothing is waited for."""
    task = Task("b", (Visit("b", HERE), Visit("b", THERE)))
    assert Order(task).visits == task.visits


@pytest.mark.parametrize("name", ["service", "not_before", "due"])
@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_times_are_finite_and_not_negative(name: str, value: float) -> None:
    """A visit cannot wait for ever."""
    with pytest.raises(ValueError, match=f"{name} must be 0 or above and finite"):
        Visit("b", HERE, **{name: value})
