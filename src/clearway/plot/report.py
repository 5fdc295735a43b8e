"""The report of a run: one page that opens anywhere and needs nothing else."""

import re
from html import escape
from importlib import resources
from pathlib import Path

from clearway.formats.atomic import write_text
from clearway.metrics import Metrics
from clearway.model import PlanRecord
from clearway.plot.payload import as_script, payload
from clearway.plot.sentences import what_it_is, what_the_judge_says, what_went_wrong

# In this order they make one script.
SCRIPTS = (
    "dom.js",
    "data.js",
    "shape.js",
    "camera.js",
    "draw_site.js",
    "draw_robots.js",
    "player.js",
    "gantt.js",
    "inspector.js",
    "tables.js",
    "controls.js",
    "main.js",
)

_BADGES = {"solved": "Solved", "stopped": "Stopped early", "infeasible": "Infeasible"}


def write_report(record: PlanRecord, metrics: Metrics, path: Path) -> None:
    """Write the report of a plan as one HTML file that loads nothing from anywhere."""
    write_text(path, render(record, metrics))


def render(record: PlanRecord, metrics: Metrics) -> str:
    """Return the report's HTML."""
    page = resources.files("clearway.plot") / "page"
    script = "\n".join(page.joinpath(name).read_text("utf-8") for name in SCRIPTS)
    banners = (
        _banner("stop", what_went_wrong(record, metrics)),
        _banner("fault", what_the_judge_says(metrics.violations)),
    )
    parts = {
        "title": escape(record.scenario),
        "css": page.joinpath("report.css").read_text("utf-8"),
        "status": escape(str(record.status)),
        "badge": _BADGES[str(record.status)],
        "summary": escape(" ".join(what_it_is(record, metrics))),
        "banners": "".join(banners),
        "data": as_script(payload(record, metrics)),
        "script": f'(() => {{\n"use strict";\n{script}\n}})();',
    }
    template = page.joinpath("report.html").read_text("utf-8")
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], template)


def _banner(kind: str, words: tuple[str, list[str]] | None) -> str:
    if words is None:
        return ""
    headline, sentences = words
    body = "".join(f"<p>{escape(sentence)}</p>" for sentence in sentences)
    return f'<div class="banner {kind}" role="alert"><h2>{escape(headline)}</h2>{body}</div>'
