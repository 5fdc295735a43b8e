"""Tables as Markdown, rows as CSV."""

import csv
import io
from collections.abc import Sequence

from clearway.study.experiment import Row
from clearway.study.findings import Finding, Summary, Table

VERDICTS = {True: "yes", False: "no", None: "not told by these rows"}


def findings_table(findings: Sequence[Finding]) -> Table:
    """Return claims, our figures and whether the claims hold, as a table."""
    return Table(
        "What reproduces",
        ("claim", "ours", "holds"),
        tuple((each.claim, each.ours, VERDICTS[each.holds]) for each in findings),
    )


def markdown(title: str, setting: Sequence[str], summary: Summary) -> str:
    """Return all tables of a summary as Markdown."""
    parts = [f"# {title}", " ".join(setting)]
    for table in (findings_table(summary.findings), *summary.tables):
        if table.lines:
            parts += [f"## {table.title}", *([table.note] if table.note else []), _grid(table)]
    return "\n\n".join(parts) + "\n"


def _grid(table: Table) -> str:
    lines = [table.heads, ("---",) * len(table.heads), *table.lines]
    return "\n".join("| " + " | ".join(_cell(text) for text in line) + " |" for line in lines)


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def rows_csv(rows: Sequence[Row]) -> str:
    """Return rows as CSV, a column for each name that holds plain values somewhere."""
    plain = [{k: v for k, v in row.items() if not isinstance(v, dict | list)} for row in rows]
    names = list(dict.fromkeys(name for row in plain for name in row))
    content = io.StringIO()
    writer = csv.DictWriter(content, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(plain)
    return content.getvalue()
