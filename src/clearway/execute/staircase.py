"""What one robot waits for of another, step by step."""

from collections.abc import Iterable

from clearway.protocols import Precedence


def pruned(precedences: Iterable[Precedence]) -> tuple[Precedence, ...]:
    """Return those that are not implied by another, by rising ``at`` and ``passed``."""
    kept: list[Precedence] = []
    for each in sorted(precedences, key=lambda p: (p.at, -p.passed)):
        if not kept or each.passed > kept[-1].passed:
            kept.append(each)
    return tuple(kept)


class Staircase:
    """Steps of a robot against one other, met one after another as the other gets on."""

    def __init__(self, steps: tuple[Precedence, ...]) -> None:
        self._steps = steps
        self._next = 0

    def first(self, progress: int) -> Precedence | None:
        """Return the first step that the other has not passed; its progress never goes back."""
        while self._next < len(self._steps) and self._steps[self._next].passed <= progress:
            self._next += 1
        return self._steps[self._next] if self._next < len(self._steps) else None

    def unmet(self, progress: int) -> tuple[Precedence, ...]:
        """Return all steps that the other has not passed."""
        return self._steps[self._next :] if self.first(progress) else ()
