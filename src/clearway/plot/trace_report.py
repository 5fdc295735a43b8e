"""The report of a run through time: the same page as a plan's, made from its trace."""

from pathlib import Path

from clearway.formats.atomic import write_text
from clearway.metrics import TraceMetrics
from clearway.model import Trace
from clearway.plot.chronicle import Chronicle, chronicle
from clearway.plot.key_figures import key_figures
from clearway.plot.report import banner, compose
from clearway.plot.sentences import NAMED, clock, count, extent, what_the_judge_says
from clearway.plot.trace_payload import trace_payload

_RUN = ("draw_run.js", "why.js", "timeline.js", "charts.js", "orders.js", "run_page.js")

_BADGES = {
    "done": "All orders done",
    "ended": "Time is up",
    "stuck": "Stuck",
    "stopped": "Budget spent",
    "interrupted": "Interrupted",
    "cut": "Cut short",
}
_HEADLINES = {
    "stuck": "The run is stuck: orders are open, but nothing happens any more",
    "stopped": "The run was stopped, as its budget was spent",
    "interrupted": "The run was interrupted",
}


def write_trace_report(
    trace: Trace, metrics: TraceMetrics, path: Path, violations: int | None = None
) -> None:
    """Write the report of a run as one HTML file that loads nothing from anywhere.

    Parameters
    ----------
    violations
        Number of those that the judge found; ``None`` if it was not asked.
    """
    write_text(path, render_trace(trace, metrics, violations))


def render_trace(trace: Trace, metrics: TraceMetrics, violations: int | None = None) -> str:
    """Return the report's HTML."""
    happened = chronicle(trace)
    end = trace.events[-1] if trace.is_whole else {}
    status = str(end.get("status", "cut"))
    return compose(
        "run",
        _RUN,
        trace_payload(happened, key_figures(metrics, violations)),
        title=trace.scenario,
        status=status,
        badge=_BADGES.get(status, status),
        summary=_what_it_is(happened, metrics),
        banners=(
            banner("stop", _what_ended_it(happened, status)),
            banner("fault", what_the_judge_says(violations or 0, "run")),
        ),
    )


def _what_it_is(happened: Chronicle, metrics: TraceMetrics) -> list[str]:
    """Return two sentences that tell a stranger what the run is."""
    trace = happened.trace
    who = count(len(trace.robots), "robot")
    first = (
        f"{who} at work for {clock(happened.duration)}"
        f" on a site of {extent(trace.site.bounds)}; the system is {trace.system}."
    )
    if not metrics.orders:
        return [first]
    work = f"{metrics.orders_done} of {count(metrics.orders, 'order')}"
    return [first, f"{work} are done, {metrics.throughput:.0f} an hour."]


def _what_ended_it(happened: Chronicle, status: str) -> tuple[str, list[str]] | None:
    if status == "cut":
        headline = "The trace ends in the middle of the run"
        return headline, [f"What is shown happened until {happened.duration:.1f} s."]
    if status == "interrupted":
        return "The run was interrupted", [f"It came to {happened.duration:.1f} s."]
    if status == "stuck":
        return "The run got stuck", [f"Nothing happens any more after {happened.duration:.1f} s."]
    if status == "stopped":
        return "The budget was spent", [f"The run came to {happened.duration:.1f} s."]
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
