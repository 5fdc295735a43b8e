"""Files that appear whole or not at all."""

import os
import tempfile
from pathlib import Path

ABSENT = object()


class FormatError(ValueError):
    """A file that cannot be understood; prints as one line naming all that is known.

    Parameters
    ----------
    problem
        What is wrong, as a short clause.
    file, key, value
        Where it is and what stands there; ``ABSENT`` where there is no value to show.
    mend
        What to do about it.
    """

    def __init__(
        self,
        problem: str,
        *,
        file: str | os.PathLike[str] | None = None,
        key: str | None = None,
        value: object = ABSENT,
        mend: str | None = None,
    ) -> None:
        self.problem = problem
        self.file = None if file is None else os.fspath(file)
        self.key = key
        self.value = value
        self.mend = mend
        super().__init__(str(self))

    def __str__(self) -> str:
        """Return the whole message on one line."""
        where = "".join(f"{part}: " for part in (self.file, self.key) if part)
        shown = "" if self.value is ABSENT else f", got {_short(self.value)}"
        advice = f"; {self.mend}" if self.mend else ""
        return f"{where}{self.problem}{shown}{advice}".replace("\n", " ")


def write_bytes(path: str | os.PathLike[str], content: bytes) -> None:
    """Write a file so that readers see the old content or the new, never a part.

    Raises
    ------
    OSError
        If the folder is missing or full; no temporary file is left behind.
    """
    target = Path(path)
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=".part", dir=target.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        temporary.chmod(_permissions(target))
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write UTF-8 text like `write_bytes`, line ends as they are."""
    write_bytes(path, text.encode("utf-8"))


def _permissions(target: Path) -> int:
    # mkstemp makes private files; a result is as readable as any other new file.
    if target.exists():
        return target.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def _short(value: object) -> str:
    shown = repr(value)
    return shown if len(shown) <= 80 else f"{shown[:60]}... ({len(shown)} characters)"
