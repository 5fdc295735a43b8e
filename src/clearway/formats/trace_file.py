"""Trace files: ``trace.jsonl`` in the format ``clearway.trace/1``."""

import os
from collections.abc import Mapping
from types import TracebackType
from typing import Any

from clearway.formats.trace_dump import dump_trace, event_line, header_line, without_timings
from clearway.formats.trace_parse import is_trace, parse_trace, read_trace
from clearway.model import Trace

__all__ = [
    "TraceWriter",
    "dump_trace",
    "event_line",
    "is_trace",
    "parse_trace",
    "read_trace",
    "without_timings",
]


class TraceWriter:
    """Writes what happens, a line for each event, flushed at once.

    Call it with events; leave its ``with`` block to close the file. Whatever ends the run,
    the file is readable to its last full line.

    Parameters
    ----------
    path
        Where to write; a file that is there is replaced.
    header
        What is known before anything happens: a trace without events.

    Raises
    ------
    FormatError
        If the header cannot be written.
    OSError
        If the file cannot be.

    Examples
    --------
    >>> with TraceWriter("run/trace.jsonl", header) as record:  # doctest: +SKIP
    ...     record({"event": "energy", "t": 1.5, "robot": "r1", "level": 0.8})
    """

    def __init__(self, path: str | os.PathLike[str], header: Trace) -> None:
        first = header_line(header)
        # Without a buffer nothing is left in it that closing would fail to write.
        self._file = open(path, "wb", buffering=0)  # noqa: SIM115 (closed by __exit__)
        try:
            self._write(first)
        except OSError:
            self._file.close()
            raise

    def __call__(self, event: Mapping[str, Any]) -> None:
        """Append an event.

        Raises
        ------
        FormatError
            If it holds what a trace cannot; nothing is written then.
        OSError
            If the disk is full; the file then ends within this event.
        """
        self._write(event_line(event))

    def __enter__(self) -> "TraceWriter":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Close the file, whether or not something went wrong."""
        self._file.close()

    def _write(self, line: str) -> None:
        left = line.encode() + b"\n"
        try:
            while left:
                left = left[self._file.write(left) :]
        except OSError as error:
            # Unlike opening, writing does not name the file.
            raise OSError(error.errno, error.strerror, str(self._file.name)) from error
