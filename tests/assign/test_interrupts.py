"""Ctrl-C while the core searches."""

import os
import signal
import threading
import time

import pytest

from clearway.assign import MemeticApsga, MemeticParams, RuinRecreate, RuinRecreateParams

ENDLESS = {
    "ruin and recreate": RuinRecreate(params=RuinRecreateParams(rounds=10**12)),
    "memetic": MemeticApsga(MemeticParams(iterations=10**9)),
}


@pytest.mark.parametrize("name", ENDLESS)
def test_a_search_without_end_can_be_left(make_problem, name):
    """The interrupt comes out as such, soon after it was asked for."""
    problem = make_problem(0, m=4, n=40)
    asked = []

    def interrupt():
        asked.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.2, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            ENDLESS[name](problem, 0)
    finally:
        timer.join()
    assert time.monotonic() - asked[0] < 2.0
