"""One line on the terminal that tells how far a long command is."""

import sys
import time
from collections.abc import Callable
from types import TracebackType


class ProgressLine:
    """Rewrites one line of stderr, from one second on; silent where stderr is no terminal."""

    def __init__(self, quiet: bool) -> None:
        self._begin = time.monotonic()
        self._on = not quiet and sys.stderr.isatty()
        self._width = 0
        self._quiet = quiet
        self._at_first: int | None = None

    def __enter__(self) -> "ProgressLine":
        """Start the clock."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Clear the line."""
        self._clear()

    def planning(
        self,
        planned: int,
        total: int,
        expansions: int,
        sum_of_costs: float | None = None,
        lower_bound: float | None = None,
    ) -> None:
        """Show how many robots are planned; once all are, how good the plan is."""
        if sum_of_costs is not None:
            told = f"improving: sum of costs {sum_of_costs:,.1f} s"
            if lower_bound:
                gap = 100.0 * (sum_of_costs / lower_bound - 1.0)
                told += f", lower bound {lower_bound:,.1f} s, gap {gap:.1f} %"
            self.say(f"{told}, {expansions:,} expansions")
            return
        filled = round(24 * planned / max(total, 1))
        bar = "#" * filled + "." * (24 - filled)
        self.say(f"planning [{bar}] {planned}/{total} robots, {expansions:,} expansions")

    def rows(self, done: int, total: int) -> None:
        """Show how many rows are done, and the time that the others take at this pace.

        The first call tells what was there before.
        """
        if self._at_first is None:
            self._at_first = done
        filled = round(24 * done / max(total, 1))
        told = f"[{'#' * filled}{'.' * (24 - filled)}] {done}/{total} rows"
        fresh = done - self._at_first
        if fresh:
            seconds = time.monotonic() - self._begin
            told += f", {_clock(seconds * (total - done) / fresh)} left"
        self.say(told)

    def running(self, until: float | None) -> Callable[[float, int, int], None]:
        """Return what shows how far a simulation is, and the time that the rest takes at this pace.

        Parameters
        ----------
        until
            Second at which it ends; ``None``: when all orders are done.
        """
        told_at = time.monotonic()

        def tell(second: float, done: int, left: int) -> None:
            nonlocal told_at
            now = time.monotonic()
            if now - told_at < 0.2:
                return
            told_at = now
            part = done / (done + left) if until is None and done + left else 0.0
            if until is not None:
                part = second / until
            text = f"{second:,.0f} s simulated, {done} orders done, {left} open"
            if part > 0.0:
                spent = now - self._begin
                text += f", {_clock(spent * (1.0 - part) / part)} left"
            self.say(text)

        return tell

    def note(self, text: str) -> None:
        """Leave a line above, whatever stderr is."""
        if self._quiet:
            return
        self._clear()
        print(f"clearway: {text}", file=sys.stderr, flush=True)

    def say(self, text: str) -> None:
        """Show any text with the seconds so far."""
        seconds = time.monotonic() - self._begin
        if not self._on or seconds < 1.0:
            return
        line = f"{text}, {seconds:.0f} s"
        print("\r" + line.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = max(self._width, len(line))

    def _clear(self) -> None:
        if self._width:
            print("\r" + " " * self._width + "\r", end="", file=sys.stderr, flush=True)
            self._width = 0


def _clock(seconds: float) -> str:
    """Return a time as hours, minutes and seconds, without those that are none."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return (
        f"{hours} h {minutes} min"
        if hours
        else f"{minutes} min {rest} s"
        if minutes
        else f"{rest} s"
    )
