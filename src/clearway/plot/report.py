"""The report of a run: one page that opens anywhere and needs nothing else."""

import re
from collections.abc import Sequence
from html import escape
from importlib import resources
from pathlib import Path
from typing import Any

from clearway.formats.atomic import write_text
from clearway.metrics import Metrics
from clearway.model import PlanRecord
from clearway.plot.payload import as_script, payload
from clearway.plot.sentences import what_it_is, what_the_judge_says, what_went_wrong

# In this order they make one script; between the two halves stands what the page is of.
_FIRST = (
    "dom.js",
    "data.js",
    "shape.js",
    "camera.js",
    "draw_site.js",
    "draw_robots.js",
    "player.js",
    "inspector.js",
    "tables.js",
)
_LAST = ("controls.js", "main.js")
_PLAN = ("gantt.js", "plan_page.js")

_BADGES = {"solved": "Solved", "stopped": "Stopped early", "infeasible": "Infeasible"}


def write_report(record: PlanRecord, metrics: Metrics, path: Path) -> None:
    """Write the report of a plan as one HTML file that loads nothing from anywhere."""
    write_text(path, render(record, metrics))


def render(record: PlanRecord, metrics: Metrics) -> str:
    """Return the report's HTML."""
    return compose(
        "plan",
        _PLAN,
        payload(record, metrics),
        title=record.scenario,
        status=str(record.status),
        badge=_BADGES[str(record.status)],
        summary=what_it_is(record, metrics),
        banners=(
            banner("stop", what_went_wrong(record, metrics)),
            banner("fault", what_the_judge_says(metrics.violations, "plan")),
        ),
    )


def compose(
    thing: str,
    scripts: Sequence[str],
    content: dict[str, Any],
    *,
    title: str,
    status: str,
    badge: str,
    summary: Sequence[str],
    banners: Sequence[str],
) -> str:
    """Return a page with a replay.

    Parameters
    ----------
    thing
        ``plan`` or ``run``: whose sections the page has.
    scripts
        Files that only such a page needs.
    content
        The data of the page's scripts.
    """
    page = resources.files("clearway.plot") / "page"

    def text(name: str) -> str:
        return page.joinpath(name).read_text("utf-8")

    script = "\n".join(text(name) for name in (*_FIRST, *scripts, *_LAST))
    parts = {
        "thing": thing,
        "title": escape(title),
        "css": text("report.css"),
        "key": text(f"{thing}_key.html"),
        "sections": text(f"{thing}_sections.html"),
        "status": escape(status),
        "badge": escape(badge),
        "summary": escape(" ".join(summary)),
        "banners": "".join(banners),
        "data": as_script(content),
        "script": f'(() => {{\n"use strict";\n{script}\n}})();',
    }
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], text("report.html"))


def banner(kind: str, words: tuple[str, list[str]] | None) -> str:
    """Return a notice of kind ``stop`` or ``fault``; empty where there is nothing to say."""
    if words is None:
        return ""
    headline, sentences = words
    body = "".join(f"<p>{escape(sentence)}</p>" for sentence in sentences)
    return f'<div class="banner {kind}" role="alert"><h2>{escape(headline)}</h2>{body}</div>'
