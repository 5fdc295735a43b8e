"""No batch ends before the bound."""

import itertools
import random
from dataclasses import replace

import pytest
from tests.assign.lone_fleet import run

from clearway.assign import LookAhead, NearestIdle, ShelfParams, makespan_bound
from clearway.model import Layout, Order, Scenario, Task
from clearway.world.lane_times import LaneTimes
from clearway.world.shelf_batch import shelf_batch

TINY = Layout("bidirectional", (3,), 1)  # 6 shelves, 6 stations


def least_makespan(scenario: Scenario, times: LaneTimes, service: float) -> float:
    """Try all sequences of all robots, the best station and place for each order apart.

    A shelf may be stored anywhere but where the next one is, whether the place is vacant or not:
    so no true dispatching does better.
    """
    zones = {kind: [z.name for z in scenario.site.zones_of(kind)] for kind in ("station", "shelf")}
    shelves = [order.task.fetches or "" for order in scenario.orders]
    starts = [
        next(z.name for z in scenario.site.zones_of("shelf") if z.pose == robot.start)
        for robot in scenario.robots
    ]

    def chain(start: str, sequence: tuple[str, ...]) -> float:
        total = times(start, sequence[0])
        for shelf, after in itertools.zip_longest(sequence, sequence[1:]):
            total += service + min(
                times(shelf, station)
                + times(station, place)
                + (0.0 if after is None else times(place, after))
                for station in zones["station"]
                for place in zones["shelf"]
                if place != after
            )
        return total

    best = float("inf")
    for order in itertools.permutations(shelves):
        for cuts in itertools.combinations_with_replacement(range(len(order) + 1), len(starts) - 1):
            ends = (0, *cuts, len(order))
            parts = [order[a:b] for a, b in itertools.pairwise(ends)]
            chains = [chain(s, part) for s, part in zip(starts, parts, strict=True) if part]
            best = min(best, max(chains))
    return best


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("turn", [0.0, 1.0])
@pytest.mark.parametrize("robots", [1, 2, 3])
def test_no_dispatching_ends_sooner(seed: int, turn: float, robots: int) -> None:
    """Four orders on a tiny site, all ways to do them."""
    scenario = shelf_batch(TINY, robots, 4, seed, turn_seconds=turn)
    times = LaneTimes.of(scenario)
    params = ShelfParams(lift=1.0, lower=2.0)
    bound = makespan_bound(scenario, params)
    least = least_makespan(scenario, times, 13.0)
    assert 0.5 * least < bound <= least + 1e-9


def test_a_lone_order_takes_what_the_bound_says() -> None:
    """From g2 to g1, beside it, 3 s by the lane; 3 s to p3, 10 s there, 3 s back."""
    scenario = shelf_batch(TINY, 1, 1, 0)
    scenario = replace(scenario, orders=(Order(Task("o1", (), fetches="g1")),))
    for dispatcher in (NearestIdle(scenario), LookAhead(scenario)):
        assert run(scenario, dispatcher, LaneTimes.of(scenario)).makespan == 19.0
    assert makespan_bound(scenario) == 19.0


@pytest.mark.parametrize("repeat", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_no_run_ends_sooner(seed: int, repeat: bool) -> None:
    """Also where shelves are ordered again, and with robots that look ahead."""
    layout = Layout("bidirectional", (4, 3), 2)
    scenario = shelf_batch(layout, 4, 25, seed, repeat=repeat)
    times = LaneTimes.of(scenario)
    bound = makespan_bound(scenario)
    for dispatcher in (NearestIdle(scenario), LookAhead(scenario)):
        log = run(scenario, dispatcher, times)
        assert not log.open
        assert bound <= log.makespan


def test_a_late_order_ends_late() -> None:
    """An order released at 1000 s cannot be stored before 1000 s and its own way."""
    scenario = shelf_batch(TINY, 2, 2, 0)
    first, second = scenario.orders
    late = replace(scenario, orders=(first, replace(second, release=1000.0)))
    assert makespan_bound(late) > 1010.0
    log = run(late, NearestIdle(late), LaneTimes.of(late))
    assert makespan_bound(late) <= log.makespan


def test_no_orders_take_no_time() -> None:
    assert makespan_bound(shelf_batch(TINY, 1, 0, 0)) == 0.0


def test_fewer_robots_need_longer() -> None:
    draw = random.Random(0)
    for _ in range(5):
        seed = draw.randrange(1000)
        many = makespan_bound(shelf_batch(Layout("bidirectional"), 10, 40, seed))
        assert makespan_bound(shelf_batch(Layout("bidirectional"), 5, 40, seed)) > many
