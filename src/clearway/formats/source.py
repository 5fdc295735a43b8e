"""Bytes of a file that someone else wrote."""

import stat
from pathlib import Path

from clearway.formats.atomic import ABSENT
from clearway.formats.scenario_error import Problem, ProblemsError

LARGEST_FILE = 64 * 2**20


def read_source(path: Path, what: str, error: type[ProblemsError]) -> bytes:
    """Return the bytes of a regular file of at most 64 MiB.

    Parameters
    ----------
    what
        What the file should be, for messages, as ``a scenario file (.toml)``.
    error
        What is raised, naming the file, what is wrong and the mend.
    """
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            kind = "is a directory" if stat.S_ISDIR(status.st_mode) else "is not a regular file"
            raise unreadable(str(path), kind, f"name {what}", error)
        if status.st_size > LARGEST_FILE:
            size = f"has {status.st_size} bytes, more than {LARGEST_FILE // 2**20} MiB"
            raise unreadable(str(path), size, "split it or shorten it", error)
        return path.read_bytes()
    except OSError as failure:
        told = f"cannot be read ({failure.strerror})"
        raise unreadable(str(path), told, "check the name and the permissions", error) from failure
    except ValueError as failure:
        if isinstance(failure, ProblemsError):
            raise
        raise unreadable(
            str(path), f"cannot be read ({failure})", "check the name", error
        ) from failure


def unreadable(file: str, what: str, mend: str, error: type[ProblemsError]) -> ProblemsError:
    """Return the error of a file that is wrong as a whole."""
    return error(file, [Problem("(file)", ABSENT, what, mend)])
