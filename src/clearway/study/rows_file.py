"""Rows of a study on disk: one JSON line each, there for good once it is written."""

import fcntl
import json
import os
from collections.abc import Collection, Mapping
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

from clearway.formats.atomic import FormatError
from clearway.study.experiment import Row

KEY = "cell"


def rows_on_disk(path: Path) -> int:
    """Return how many cells have a whole row in a file, which may lack its last line's end."""
    if not path.exists():
        return 0
    _, *lines = path.read_bytes().split(b"\n")[:-1] or [b""]
    return len({json.loads(line)[KEY] for line in lines})


class RowsFile:
    """Holds the rows that are done, and takes new ones; a context that keeps others out.

    The first line tells what the rows are of. A last line that was cut short is dropped, rows
    that tell of a failure are forgotten so that they are made again; ``notes`` say so.

    Parameters
    ----------
    origin
        What the rows are of, plain JSON; rows of anything else are refused.
    keys
        Of all cells that a row may be of.

    Raises
    ------
    FormatError
        If the file holds rows of something else, or lines that are none; names the mend.
    OSError
        If the file cannot be written.
    """

    def __init__(self, path: Path, origin: Mapping[str, Any], keys: Collection[str]) -> None:
        self.path = path
        self.notes: list[str] = []
        self.rows: dict[str, Row] = {}
        self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        try:
            self._lock()
            with path.open("rb") as file:
                self._read(file.read(), dict(origin), keys)
        except BaseException:
            os.close(self._file)
            raise

    def __enter__(self) -> "RowsFile":
        """Return the file."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        os.close(self._file)

    def add(self, row: Row) -> None:
        """Write a row down; once this returns, it survives.

        Raises
        ------
        OSError
            If the disk is full; the rows before stay as they are.
        """
        self.rows[row[KEY]] = self._write(row)

    def _write(self, content: Mapping[str, Any]) -> Row:
        """Append a line; return what will be read from it."""
        text = json.dumps(content, allow_nan=False)
        line = text.encode() + b"\n"
        whole = os.fstat(self._file).st_size
        try:
            while line:
                line = line[os.write(self._file, line) :]
            os.fsync(self._file)
        except OSError as error:
            with suppress(OSError):  # else the next reader drops the broken line
                os.ftruncate(self._file, whole)
            raise OSError(error.errno, error.strerror, str(self.path)) from error
        row: Row = json.loads(text)
        return row

    def _lock(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FormatError(
                "another study is writing here", file=self.path, mend="wait, or give another --out"
            ) from None

    def _read(self, content: bytes, origin: dict[str, Any], keys: Collection[str]) -> None:
        *lines, rest = content.split(b"\n")
        if rest:
            self.notes.append(f"the last line of {self.path} was cut short; its row is made again")
            os.ftruncate(self._file, len(content) - len(rest))
        if not lines:
            self._write(origin)
            return
        found = [self._parse(number, line) for number, line in enumerate(lines, start=1)]
        self._compare(found[0], origin)
        kept = {}
        for number, row in enumerate(found[1:], start=2):
            if row.get(KEY) not in keys:
                self._refuse(f"line {number} is a row of another cell, {row.get(KEY)}")
            kept[row[KEY]] = row
        self.rows = {key: row for key, row in kept.items() if "failed" not in row}
        if len(self.rows) < len(found) - 1:
            self.notes.append(f"{len(found) - 1 - len(self.rows)} rows that failed are made again")
            self._rewrite([found[0], *self.rows.values()])

    def _rewrite(self, lines: Collection[Mapping[str, Any]]) -> None:
        """Keep these lines only; in place, since others hold the lock on this very file."""
        os.ftruncate(self._file, 0)
        for line in lines:
            self._write(line)

    def _parse(self, number: int, line: bytes) -> Row:
        try:
            row = json.loads(line)
        except ValueError:
            row = None
        if not isinstance(row, dict):
            raise FormatError(
                f"line {number} is no JSON object",
                file=self.path,
                mend="delete the line, or the file to begin anew",
            )
        return row

    def _compare(self, found: Row, origin: dict[str, Any]) -> None:
        for name in dict.fromkeys([*origin, *found]):
            if found.get(name) != origin.get(name):
                self._refuse(
                    f"its rows are of another study: {name} is {json.dumps(found.get(name))}, "
                    f"not {json.dumps(origin.get(name))}"
                )

    def _refuse(self, problem: str) -> None:
        raise FormatError(
            problem, file=self.path, mend="give another --out, or delete the file to begin anew"
        )
