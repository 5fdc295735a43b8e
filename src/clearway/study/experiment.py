"""An experiment as a value: its cells, what a row is made of, and what the rows say."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from clearway.protocols import Budget

if TYPE_CHECKING:  # workers need cells only, and statistics take a second to import
    from clearway.study.findings import Summary

Row = dict[str, Any]


@dataclass(frozen=True)
class Cell:
    """One run of an experiment: settings that are plain JSON, and a seed."""

    settings: Mapping[str, Any]
    seed: int

    @property
    def key(self) -> str:
        """Name of the cell, the same whenever settings and seed are."""
        told = {**self.settings, "seed": self.seed}
        return " ".join(f"{name}={json.dumps(told[name])}" for name in sorted(told))


@dataclass(frozen=True)
class Scale:
    """How large a study is run.

    Parameters
    ----------
    quick
        A small version for a first look: under two minutes on two cores.
    first_seed
        Instances have the seeds from here on.
    instances
        Per point of the study; absent: as many as the study has of itself.
    budget
        For each plan; what is not given is the study's own.
    """

    quick: bool = False
    first_seed: int = 0
    instances: int | None = None
    budget: Budget = field(default_factory=Budget)

    def __post_init__(self) -> None:
        if self.instances is not None and self.instances < 1:
            raise ValueError(f"instances: must be 1 or more, got {self.instances}")

    def seeds(self, whole: int, quick: int) -> range:
        """Return the seeds, where the study has ``whole`` and its quick version ``quick``."""
        count = self.instances or (quick if self.quick else whole)
        return range(self.first_seed, self.first_seed + count)


@dataclass(frozen=True)
class Study:
    """A paper's experiment.

    Parameters
    ----------
    name, title
        What the command calls it, and a line for people.
    version
        Raised with each change of what a row holds: rows of different versions never mix.
    setting
        Sentences that tell what is run, for readers of the report.
    parts
        What the labels in the cells stand for, so that rows made with other parts are told
        apart: label and description.
    cells
        All cells at a scale, in the order in which rows are told.
    row
        From a cell to its row, plain JSON. A function of a module, since other processes
        import it; the same cell gives the same row but for names that end in ``_s``.
    summarise
        From all rows, in the order of their cells, to tables, charts and findings.
    """

    name: str
    title: str
    version: int
    setting: tuple[str, ...]
    parts: Mapping[str, str]
    cells: Callable[[Scale], Sequence[Cell]]
    row: Callable[[Cell], Row]
    summarise: "Callable[[Sequence[Row]], Summary]"
