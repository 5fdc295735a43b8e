"""A scenario's parts fit together."""

import pytest

from clearway.model import Order, Pose, Scenario, Site, Task, Visit


def test_a_task_waits_for_tasks_that_there_are() -> None:
    """The one that waits is named, and what it waits for in vain."""
    site = Site(((0, 0), (10, 0), (10, 10), (0, 10)))
    visit = Visit("t", Pose(5.0, 5.0, 0.0))
    orders = (Order(Task("t", (visit,)), after=("u",)),)
    with pytest.raises(ValueError, match="task t waits for u, which is no task of yard"):
        Scenario("yard", site, {}, (), orders)
    both = (*orders, Order(Task("u", (visit,))))
    assert Scenario("yard", site, {}, (), both).orders == both
