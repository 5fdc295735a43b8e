"""Ctrl-C that waits for a moment at which nothing is half done."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType, TracebackType
from typing import Any


class Interrupts:
    """Raises `KeyboardInterrupt` at once, but within `held` only at its end or at a `check`.

    It counts while its ``with`` block lasts, and in the main thread only.
    """

    def __init__(self) -> None:
        self._is_held = self._has_come = False
        self._before: Any = None

    def __enter__(self) -> "Interrupts":
        """Take over from whoever handled interrupts before."""
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, self._come)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give back to whoever handled interrupts before."""
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Let what is done within be done to its end."""
        self._is_held = True
        try:
            yield
        finally:
            self._is_held = False
        self.check()

    def check(self) -> None:
        """Raise what has been held back."""
        if self._has_come:
            self._has_come = False
            raise KeyboardInterrupt

    def _come(self, number: int, frame: FrameType | None) -> None:
        self._has_come = True
        if not self._is_held:
            self.check()
