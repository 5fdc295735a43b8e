"""A place in a JSON file that knows its key, so that errors can name it."""

import json
import math
from collections.abc import Iterator
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from clearway.formats.atomic import ABSENT, FormatError

# What a text that was cut short may end with the beginning of.
WORDS = ("true", "false", "null", "-", ".", "e-", "e+")

# Beyond this (m, rad, s) the digits of a float no longer tell micrometres apart.
LARGEST_FIGURE = 1e8


class Node:
    """A value with the file and the key path it came from.

    A missing key is a node too (``value`` is ``ABSENT``): asking it for a value says what
    is missing, asking ``given`` tells whether there is one. JSON's null counts as absent.
    """

    def __init__(self, value: Any, key: str, file: str) -> None:
        self.value = value
        self.key = key
        self.file = file

    @property
    def given(self) -> bool:
        """Whether there is a value other than null."""
        return self.value is not ABSENT and self.value is not None

    def fail(self, problem: str, mend: str) -> NoReturn:
        """Raise a ``FormatError`` about this place."""
        if self.value is ABSENT:
            problem = f"missing: {problem}"
        raise FormatError(problem, file=self.file, key=self.key, value=self.value, mend=mend)

    def fail_key(self, problem: str, mend: str) -> NoReturn:
        """Raise a ``FormatError`` about the key itself, without showing its value."""
        raise FormatError(problem, file=self.file, key=self.key, mend=mend)

    def __getitem__(self, name: str) -> "Node":
        """Return the node of a key; it may be absent."""
        content = self._of(dict, "an object")
        key = f"{self.key}.{name}" if self.key else name
        return Node(content.get(name, ABSENT), key, self.file)

    def items(self) -> Iterator[tuple[str, "Node"]]:
        """Return names and nodes of an object, in the file's order."""
        return ((name, self[name]) for name in self._of(dict, "an object"))

    def elements(self, count: int | None = None) -> list["Node"]:
        """Return the nodes of a list, of ``count`` elements if that is given."""
        content = self._of(list, "a list")
        if count is not None and len(content) != count:
            self.fail(f"{count} elements expected, {len(content)} found", f"give {count}")
        return [Node(v, f"{self.key}[{i}]", self.file) for i, v in enumerate(content)]

    def text(self) -> str:
        """Return a string."""
        return str(self._of(str, "a string"))

    def texts_or_none(self) -> tuple[str | None, ...]:
        """Return a list of strings and nulls."""
        content = self._of(list, "a list of strings")
        if not all(v is None or type(v) is str for v in content):
            return tuple(node.text() if node.given else None for node in self.elements())
        return tuple(content)

    def integer(self) -> int:
        """Return a whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            self.fail("a whole number is expected", "write digits without a point")
        return self.value

    def number(self) -> float:
        """Return a finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            self.fail("a number is expected", "write a finite number")
        # A whole number may be too large for a float, and 1e999 reads as infinity.
        if isinstance(self.value, int) and abs(self.value) > 10**300:
            self.fail("the number is too large", "write a finite number")
        if not math.isfinite(self.value):
            self.fail("a finite number is expected", "write a finite number")
        return float(self.value)

    def number_or_none(self) -> float | None:
        """Return a finite number, ``None`` where there is none."""
        return self.number() if self.given else None

    def figure(self) -> float:
        """Return a number of m, rad or s that a site can hold."""
        value = self.number()
        if abs(value) > LARGEST_FIGURE:
            self.fail("no plausible length, angle or time", f"stay below {LARGEST_FIGURE:.0e}")
        return value

    def figures(self, count: int) -> tuple[float, ...]:
        """Return ``count`` such numbers."""
        return tuple(node.figure() for node in self.elements(count))

    def array(self) -> NDArray[np.float64]:
        """Return a list of such numbers as an array of shape ``(length,)``."""
        content = self._of(list, "a list of numbers")
        kinds = set(map(type, content))
        if kinds <= {float} or (kinds <= {float, int} and max(map(abs, content)) < 2**53):
            array = np.array(content, dtype=np.float64)
            if (np.abs(array) <= LARGEST_FIGURE).all():
                return array
        return np.array([node.figure() for node in self.elements()], dtype=np.float64)

    def free(self) -> Any:
        """Return any JSON value that holds finite numbers only."""
        if isinstance(self.value, dict):
            return {name: node.free() for name, node in self.items()}
        if isinstance(self.value, list):
            return [node.free() for node in self.elements()]
        if isinstance(self.value, float):
            return self.number()
        return self.value

    def _of(self, kind: type, name: str) -> Any:
        if not isinstance(self.value, kind):
            self.fail(f"{name} is expected", f"write {name}")
        return self.value


def parse_json(text: str, file: str) -> Node:
    """Return the root of a JSON text.

    Raises
    ------
    FormatError
        If the text is not JSON, is cut short, or gives one key twice.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        content = dict(pairs)
        if len(content) != len(pairs):
            names = [name for name, _ in pairs]
            twice = next(name for name in names if names.count(name) > 1)
            raise FormatError("the key is given twice", file=file, key=twice, mend="keep one")
        return content

    try:
        return Node(json.loads(text, object_pairs_hook=once), "", file)
    except json.JSONDecodeError as error:
        rest = text[error.pos :].strip()
        cut = error.msg.startswith("Unterminated") or any(w.startswith(rest) for w in WORDS)
        raise FormatError(
            f"{'the text ends too early' if cut else 'not JSON'} "
            f"(line {error.lineno}, column {error.colno}: {error.msg})",
            file=file,
            mend="write the file again, or restore it from a copy",
        ) from None
    except RecursionError:
        raise FormatError("nested too deeply", file=file, mend="write the file again") from None
    except ValueError as error:
        if isinstance(error, FormatError):
            raise
        # Python refuses to read whole numbers of thousands of digits.
        raise FormatError(f"a number is too long ({error})", file=file, mend="shorten it") from None
