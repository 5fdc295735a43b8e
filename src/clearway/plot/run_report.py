"""The report of a run through time: the same page as a plan's, made from its trace."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from clearway.formats.atomic import write_text
from clearway.model import Trace
from clearway.plot.chronicle import Chronicle, chronicle
from clearway.plot.report import banner, compose
from clearway.plot.run_payload import run_payload
from clearway.plot.sentences import NAMED, clock, count, extent, what_the_judge_says

_RUN = ("draw_run.js", "why.js", "timeline.js", "charts.js", "orders.js", "run_page.js")

_BADGES = {
    "done": "All orders done",
    "ended": "Time is up",
    "interrupted": "Interrupted",
    "cut": "Cut short",
}


def write_trace_report(trace: Trace, metrics: Mapping[str, Any], path: Path) -> None:
    """Write the report of a run as one HTML file that loads nothing from anywhere."""
    write_text(path, render_run(trace, metrics))


def render_run(trace: Trace, metrics: Mapping[str, Any]) -> str:
    """Return the report's HTML."""
    happened = chronicle(trace)
    end = trace.events[-1] if trace.is_whole else {}
    status = str(end.get("status", "cut"))
    return compose(
        "run",
        _RUN,
        run_payload(happened, _figures(metrics)),
        title=trace.scenario,
        status=status,
        badge=_BADGES.get(status, status),
        summary=_what_it_is(happened),
        banners=(
            banner("stop", _what_ended_it(happened, status)),
            banner("fault", what_the_judge_says(int(metrics.get("violations", 0)), "run")),
        ),
    )


def _figures(metrics: Mapping[str, Any]) -> list[list[str]]:
    return [[name, str(value), ""] for name, value in metrics.items()]


def _what_it_is(happened: Chronicle) -> list[str]:
    """Return two sentences that tell a stranger what the run is."""
    trace = happened.trace
    who = count(len(trace.robots), "robot")
    done = _orders_in(happened, ("done",))
    work = f"{len(done)} of {count(len(happened.orders), 'order')}"
    first = (
        f"{who} at work for {clock(happened.duration)}"
        f" on a site of {extent(trace.site.bounds)}, as {trace.system}."
    )
    hour = 3600.0 * len(done) / happened.duration if happened.duration else 0.0
    return [first, f"They did {work}, {hour:.0f} an hour."]


def _what_ended_it(happened: Chronicle, status: str) -> tuple[str, list[str]] | None:
    if status == "cut":
        headline = "The trace ends in the middle of the run"
        return headline, [f"What is shown happened until {happened.duration:.1f} s."]
    if status == "interrupted":
        return "The run was interrupted", [f"It came to {happened.duration:.1f} s."]
    failed = _orders_in(happened, ("failed",))
    if not failed:
        return None
    more = f" and {len(failed) - NAMED} more" if len(failed) > NAMED else ""
    return (
        f"{count(len(failed), 'order')} failed",
        [f"{', '.join(failed[:NAMED])}{more}: the table of orders says why."],
    )


def _orders_in(happened: Chronicle, states: tuple[str, ...]) -> list[str]:
    return [name for name, told in happened.orders.items() if told[-1]["state"] in states]
