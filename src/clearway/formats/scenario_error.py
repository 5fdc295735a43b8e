"""What is wrong with a scenario file, told so that it can be mended."""

import difflib
import json
import reprlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from clearway.formats.atomic import ABSENT, FormatError

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = 60


def key_path(steps: Iterable[str | int]) -> str:
    """Return a key path such as ``robots[3].start[2]``."""
    path = ""
    for step in steps:
        if isinstance(step, int):
            path += f"[{step}]"
            continue
        bare = step and all(c.isascii() and (c.isalnum() or c in "_-") for c in step)
        word = step if bare else json.dumps(step, ensure_ascii=False)
        path += f".{word}" if path else word
    return path


def closest(word: object, known: Iterable[str]) -> str:
    """Return a mend for an unknown word: the nearest known one, then all of them."""
    words = sorted(known)
    near = difflib.get_close_matches(str(word), words, n=1)
    listed = ", ".join(words[:20]) + (", ..." if len(words) > 20 else "")
    hint = f"did you mean {near[0]!r}? " if near else ""
    return f"{hint}known: {listed or 'none'}"


@dataclass(frozen=True)
class Problem:
    """One thing wrong: the key path, its value (``ABSENT`` if none), what, and the mend."""

    key: str
    value: Any
    what: str
    mend: str

    def __str__(self) -> str:
        """Return the problem on one line."""
        got = "" if self.value is ABSENT else f", got {_SHORT.repr(self.value)}"
        return f"{self.key}: {self.what}{got}; {self.mend}"


class Misfit(ValueError):
    """A value that does not fit its field; ``path`` leads from the field to the culprit."""

    def __init__(self, what: str, mend: str, value: Any, path: tuple[str | int, ...] = ()) -> None:
        super().__init__(f"{what}; {mend}")
        self.what, self.mend, self.value, self.path = what, mend, value, path


class ProblemsError(FormatError):
    """A file that cannot be used, and all that is wrong with it.

    ``file``, ``key``, ``value`` and ``mend`` are those of the first problem; ``problems``
    holds all that were found.
    """

    def __init__(self, file: str, problems: Sequence[Problem]) -> None:
        self.problems = tuple(problems)
        first = problems[0]
        super().__init__(first.what, file=file, key=first.key, value=first.value, mend=first.mend)

    def __str__(self) -> str:
        """Return the first problem and how many more there are."""
        more = len(self.problems) - 1
        tail = f" (and {more} more problem{'s' if more > 1 else ''})" if more else ""
        return f"{self.file}: {self.problems[0]}{tail}".replace("\n", " ")


class ScenarioError(ProblemsError):
    """A scenario file that cannot be used."""


class OrderFileError(ProblemsError):
    """An order file that cannot be used; keys name the line, and the column or the key."""
