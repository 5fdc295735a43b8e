"""A study from its name to its files."""

from collections.abc import Callable
from dataclasses import dataclass
from difflib import get_close_matches
from importlib.metadata import version
from pathlib import Path
from typing import Any

from clearway.formats.atomic import write_bytes, write_text
from clearway.study.experiment import Row, Scale, Study
from clearway.study.findings import Summary, Table
from clearway.study.rows_file import KEY, RowsFile
from clearway.study.runner import rows_of
from clearway.study.workers import Workers

FORMAT = "clearway.study/1"


@dataclass(frozen=True)
class Conducted:
    """A study that has ended: its rows, what they say, and the files that hold it."""

    rows: tuple[Row, ...]
    failed: tuple[Row, ...]
    summary: Summary
    files: tuple[Path, ...]


def find_study(name: str) -> Study:
    """Return a study by its name.

    Raises
    ------
    ValueError
        If there is none; names the closest.
    """
    from clearway.study.studies import STUDIES

    if name not in STUDIES:
        close = get_close_matches(name, STUDIES, 1, 0.3)
        hint = f"did you mean {close[0]}? " if close else ""
        raise ValueError(f"study: there is no {name!r}; {hint}known: {', '.join(STUDIES)}")
    return STUDIES[name]


def conduct(
    study: Study,
    scale: Scale,
    out: Path,
    workers: Workers,
    command: str,
    *,
    progress: Callable[[int, int], None] = lambda done, total: None,
    warn: Callable[[str], None] = lambda text: None,
) -> Conducted:
    """Make the rows of a study that ``out`` does not have yet, and write all its files.

    Rows are kept in ``rows.jsonl`` as they come; when interrupted, the same call goes on from
    there. The files that are made from all rows are written at the end.

    Parameters
    ----------
    command
        That runs this study, for readers of the report.
    progress
        Called with the rows done and their number in all, now and then.
    warn
        Called with what a person should know about the rows that were there.

    Raises
    ------
    FormatError
        If ``out`` holds rows of another study.
    OSError
        If something cannot be written.
    """
    cells = list(study.cells(scale))
    keys = {cell.key for cell in cells}
    out.mkdir(parents=True, exist_ok=True)
    with RowsFile(out / "rows.jsonl", _origin(study), keys) as kept:
        for note in kept.notes:
            warn(note)

        def tick() -> None:
            progress(len(kept.rows), len(cells))

        left = [cell for cell in cells if cell.key not in kept.rows]
        tick()
        for cell, row in rows_of(study.row, left, workers, tick):
            kept.add({KEY: cell.key, **cell.settings, "seed": cell.seed, **row})
            tick()
        rows = [kept.rows[cell.key] for cell in cells]
    failed = tuple(row for row in rows if "failed" in row)
    whole = tuple(row for row in rows if "failed" not in row)
    summary = study.summarise(whole)
    if failed:
        summary = _with_failures(summary, failed)
    files = _write(study, summary, rows, out, command)
    return Conducted(whole, failed, summary, (out / "rows.jsonl", *files))


def _origin(study: Study) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "study": study.name,
        "version": study.version,
        "clearway": version("clearway"),
        **{f"part {label}": text for label, text in study.parts.items()},
    }


def _with_failures(summary: Summary, failed: tuple[Row, ...]) -> Summary:
    table = Table(
        "Rows that failed",
        ("cell", "why"),
        tuple((row[KEY], row["failed"]) for row in failed),
        "They are left out of all figures, and made again when the study is run again.",
    )
    return Summary((table, *summary.tables), summary.charts, summary.findings)


def _write(
    study: Study, summary: Summary, rows: list[Row], out: Path, command: str
) -> tuple[Path, ...]:
    from clearway.study.charts import draw
    from clearway.study.page import render
    from clearway.study.tables import markdown, rows_csv

    pictures = {chart.name: draw(chart) for chart in summary.charts}
    texts = {
        "table.csv": rows_csv(rows),
        "table.md": markdown(study.title, study.setting, summary),
        "report.html": render(study, summary, pictures, len(rows), command),
    }
    for name, text in texts.items():
        write_text(out / name, text)
    for name, picture in pictures.items():
        write_bytes(out / f"{name}.png", picture)
    return tuple(out / name for name in [*texts, *(f"{name}.png" for name in pictures)])
