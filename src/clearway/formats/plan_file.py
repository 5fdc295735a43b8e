"""Plan files: ``plan.json`` in the format ``clearway.plan/1``."""

import os
from pathlib import Path

from clearway.formats.atomic import FormatError, write_text
from clearway.formats.plan_dump import dump_plan
from clearway.formats.plan_parse import parse_plan
from clearway.model import PlanRecord

LARGEST_FILE = 2**30

__all__ = ["dump_plan", "parse_plan", "read_plan", "write_plan"]


def write_plan(record: PlanRecord, path: str | os.PathLike[str]) -> None:
    """Write a plan file, whole or not at all; equal records give equal bytes.

    Raises
    ------
    FormatError
        If the record holds numbers that are not finite.
    OSError
        If the file cannot be written.
    """
    write_text(path, dump_plan(record))


def read_plan(path: str | os.PathLike[str]) -> PlanRecord:
    """Read a plan file.

    Raises
    ------
    FormatError
        If the file cannot be read, is over 1 GiB or is malformed; names file, key, value
        and the mend.
    """
    name = os.fspath(path)
    try:
        size = Path(path).stat().st_size
        if size > LARGEST_FILE:
            raise FormatError(
                f"the file has {size} bytes, at most {LARGEST_FILE} are read",
                file=name,
                mend="split the plan",
            )
        text = Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise FormatError(
            f"cannot be read ({error.strerror})", file=name, mend="check the path"
        ) from None
    except UnicodeDecodeError as error:
        raise FormatError(
            f"not UTF-8 text (byte {error.start})", file=name, mend="give a plan.json"
        ) from None
    return parse_plan(text, name)
