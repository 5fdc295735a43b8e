"""Let robots by a rule of your own: python 02_own_dispatcher.py SCENARIO.toml (of system B)."""

import sys
from collections.abc import Iterator
from dataclasses import replace

import clearway
from clearway.assign import LookAhead, NearestIdle
from clearway.metrics.trace_metrics import trace_metrics
from clearway.model import Scenario
from clearway.protocols import Board, Choice, Dispatcher
from clearway.systems.choose import choose_lifelong


class RestedFirst:
    """The paper's rules, but robots that have rested for less than 10 s take no new order."""

    def __init__(self, scenario: Scenario) -> None:
        self._paper = NearestIdle(scenario)

    def __call__(self, board: Board) -> Iterator[Choice]:
        """Yield what the paper would, but for orders to robots that must rest."""
        for choice in self._paper(board):
            rested = board.now - board.robots[choice.trip.robot].idle_since
            if choice.trip.purpose != "fetch" or board.now == 0 or rested >= 10_000:
                yield choice


scenario = clearway.read_scenario(sys.argv[1])
system = choose_lifelong(scenario)
print(f"{'dispatcher':14}{'orders done':>13}{'orders an hour':>16}{'empty %':>9}{'wrong':>7}")
dispatchers: tuple[type[Dispatcher], ...] = (NearestIdle, RestedFirst, LookAhead)
for dispatcher in dispatchers:
    run = clearway.simulate(scenario, system=replace(system, dispatch=dispatcher))
    figures, wrong = trace_metrics(run.trace), clearway.validate_trace(run.trace)
    print(
        f"{dispatcher.__name__:14}{figures.orders_done:13}{figures.throughput:16.0f}"
        f"{100.0 * figures.empty_share:9.1f}{len(wrong):7}"
    )
