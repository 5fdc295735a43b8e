"""Row functions that other processes can import."""

import os
import signal
import time
from pathlib import Path

from clearway.formats.atomic import FormatError


def plain(cell):
    """A square, and seconds that differ from run to run."""
    return {"square": cell.settings["x"] ** 2 + cell.seed, "spent_s": time.perf_counter()}


def dies_once(cell):
    """The worker of x = 2 is killed the first time."""
    marker = Path(cell.settings["marker"])
    if cell.settings["x"] == 2 and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return plain(cell)


def deadly(cell):
    """The worker of x = 2 never survives; the others are at work when it dies."""
    if cell.settings["x"] == 2:
        os._exit(1)
    time.sleep(0.4)
    return plain(cell)


def slow(cell):
    """All but x = 0 take longer than anybody waits."""
    if cell.settings["x"]:
        time.sleep(600.0)
    return plain(cell)


def wrong(cell):
    """A row function with an error of its own."""
    raise LookupError(f"no row for {cell.key}")


def refusing(cell):
    """A row function that finds its scenario broken."""
    raise FormatError("a number is expected", file="site.toml", key="seed", mend="write one")
