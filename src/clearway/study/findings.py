"""What a study has to say: tables, charts, and the paper's claims beside ours."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from clearway.study.statistics import Estimate

Style = Literal["line", "points", "paper"]


@dataclass(frozen=True)
class Table:
    """A table of ready texts; ``note`` says how to read it."""

    title: str
    heads: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]
    note: str = ""

    def __post_init__(self) -> None:
        wrong = [line for line in self.lines if len(line) != len(self.heads)]
        if wrong:
            raise ValueError(f"table {self.title}: {len(self.heads)} heads, but a line {wrong[0]}")


@dataclass(frozen=True)
class Series:
    """Points with, where known, the interval of each.

    Parameters
    ----------
    low, high
        Ends of the intervals; empty: none. As long as ``y`` otherwise.
    style
        ``line`` or ``points`` (both with bars), or ``paper``: the paper's own points.
    colour
        Number of the colour; equal numbers look alike in all panels.
    """

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    low: tuple[float, ...] = ()
    high: tuple[float, ...] = ()
    style: Style = "line"
    colour: int = 0

    @classmethod
    def of(
        cls,
        label: str,
        points: Sequence[tuple[float, Estimate]],
        style: Style = "line",
        colour: int = 0,
    ) -> "Series":
        """Return estimates with their intervals."""
        return cls(
            label,
            tuple(x for x, _ in points),
            tuple(each.value for _, each in points),
            tuple(each.low for _, each in points),
            tuple(each.high for _, each in points),
            style,
            colour,
        )


@dataclass(frozen=True)
class Span:
    """A stretch of the x axis to shade, with a word on it."""

    begin: float
    end: float
    label: str = ""


@dataclass(frozen=True)
class Panel:
    """One pair of axes.

    Parameters
    ----------
    ticks
        Names of places on the x axis; empty: numbers.
    from_zero
        Whether the y axis begins at 0.
    """

    x_label: str
    y_label: str
    series: tuple[Series, ...]
    title: str = ""
    ticks: tuple[tuple[float, str], ...] = ()
    spans: tuple[Span, ...] = ()
    log: bool = False
    from_zero: bool = False


@dataclass(frozen=True)
class Chart:
    """A picture of panels, written as ``<name>.png``; ``note`` says what one sees."""

    name: str
    title: str
    panels: tuple[Panel, ...]
    note: str = ""
    columns: int = 1


@dataclass(frozen=True)
class Finding:
    """A claim of the paper (or a target of ours), what came out, and whether it holds.

    ``holds`` is computed from rows: ``None`` where they cannot tell.
    """

    claim: str
    ours: str
    holds: bool | None


@dataclass(frozen=True)
class Summary:
    """All that a study says of its rows."""

    tables: tuple[Table, ...]
    charts: tuple[Chart, ...]
    findings: tuple[Finding, ...]
