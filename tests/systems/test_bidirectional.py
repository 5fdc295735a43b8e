"""What system B takes and what it does not."""

from dataclasses import replace

import pytest

from clearway.coordinate import Unsupported
from clearway.model import (
    Draw,
    Order,
    OrderStream,
    Pose,
    Robot,
    Scenario,
    Simulation,
    Task,
    Visit,
)
from clearway.systems.choose import choose_lifelong
from clearway.systems.simulate import run_through_time
from clearway.world.channels import PAPER, agv_type, site_of

FETCH = Order(Task("o", (), None, "g9"))
WAREHOUSE = Scenario(
    "b",
    site_of(PAPER),
    {"agv": agv_type(PAPER)},
    (Robot("agv-1", "agv", Pose(3.5, 2.5, 0.0)), Robot("agv-2", "agv", Pose(9.5, 2.5, 0.0))),
    (FETCH,),
    system="bidirectional",
)
CARRY = OrderStream("s", rate=60.0, draws=(Draw("station"),))


@pytest.mark.parametrize("dispatch", ["nearest", "ahead"])
def test_orders_wait_for_others(dispatch: str) -> None:
    later = Order(Task("t", (), None, "g8"), after=("o",), priority=1.0)
    scenario = replace(WAREHOUSE, orders=(later, FETCH), settings={"dispatch": dispatch})
    run = run_through_time(scenario)
    assert run.status == "done"
    states = [(e["order"], e["state"]) for e in run.trace.of("order")]
    assert states.index(("o", "done")) < states.index(("t", "assigned"))


def with_task(task: Task) -> Scenario:
    return replace(WAREHOUSE, orders=(Order(task),))


@pytest.mark.parametrize(
    ("scenario", "part"),
    [
        (replace(WAREHOUSE, site=replace(WAREHOUSE.site, layout=None)), "site: .*give it a layout"),
        (with_task(Task("t", (Visit("t", Pose(3.5, 2.5, 0.0)),))), "task t: has visits"),
        (with_task(Task("t", (), "agv-2", "g9")), "task t: is kept for agv-2.*drop robot"),
        (
            replace(WAREHOUSE, simulation=Simulation(60.0, (CARRY,))),
            "stream s: has visits.*fetch = true",
        ),
    ],
)
def test_what_it_cannot_take_is_refused_before_it_runs(scenario: Scenario, part: str) -> None:
    """Nothing that a scenario asks for is passed over in silence."""
    with pytest.raises(Unsupported, match=part):
        run_through_time(scenario)


def test_what_it_can_take_is_not_refused() -> None:
    """An order that fetches a shelf, on a layout, by whoever is nearest."""
    assert choose_lifelong(WAREHOUSE).unsupported(WAREHOUSE) == ()
