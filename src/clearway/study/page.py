"""The report of a study: one page that opens anywhere and needs nothing else."""

import base64
import re
from html import escape
from importlib import resources

from clearway.study.charts import DARK, draw
from clearway.study.experiment import Study
from clearway.study.findings import Chart, Summary, Table
from clearway.study.tables import VERDICTS, findings_table


def render(
    study: Study, summary: Summary, pictures: dict[str, bytes], count: int, command: str
) -> str:
    """Return the report's HTML.

    Parameters
    ----------
    pictures
        Each chart's PNG on light ground, by the chart's name.
    count
        Of all rows.
    """
    page = resources.files("clearway.study") / "page"
    findings, *tables = (findings_table(summary.findings), *summary.tables)
    body = [
        _table(findings),
        *(_figure(chart, pictures[chart.name]) for chart in summary.charts),
        *(_table(table) for table in tables),
    ]
    parts = {
        "title": escape(study.title),
        "name": escape(study.name),
        "css": page.joinpath("study.css").read_text("utf-8"),
        "setting": escape(" ".join(study.setting)),
        "body": "\n".join(body),
        "count": f"{count:,}",
        "command": escape(command),
    }
    template = page.joinpath("study.html").read_text("utf-8")
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], template)


def _table(table: Table) -> str:
    if not table.lines:
        return ""
    note = f'<p class="note">{escape(table.note)}</p>' if table.note else ""
    heads = "".join(f'<th scope="col">{escape(head)}</th>' for head in table.heads)
    lines = "".join(f"<tr>{''.join(map(_cell, line))}</tr>" for line in table.lines)
    return (
        f"<section><h2>{escape(table.title)}</h2>{note}"
        f'<div class="scroll"><table><thead><tr>{heads}</tr></thead>'
        f"<tbody>{lines}</tbody></table></div></section>"
    )


def _cell(text: str) -> str:
    if text in VERDICTS.values():
        return f'<td><span class="badge {escape(text)}">{escape(text)}</span></td>'
    short = ' class="number"' if len(text) <= 24 else ""
    return f"<td{short}>{escape(text)}</td>"


def _figure(chart: Chart, light: bytes) -> str:
    note = f"<figcaption>{escape(chart.note)}</figcaption>" if chart.note else ""
    wide = "" if len(chart.panels) > 1 else ' class="single"'
    return (
        f'<figure{wide}><picture><source media="(prefers-color-scheme: dark)" '
        f'srcset="{_embedded(draw(chart, DARK))}"><img src="{_embedded(light)}" '
        f'alt="{escape(chart.title, quote=True)}"></picture>{note}</figure>'
    )


def _embedded(picture: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(picture).decode('ascii')}"
