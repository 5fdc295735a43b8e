"""The key figures of a run for its page: name, value, and a note."""

from clearway.metrics import TraceMetrics
from clearway.plot.sentences import clock


def key_figures(metrics: TraceMetrics, violations: int | None) -> list[tuple[str, str, str]]:
    """Return the figures in the order of the page; those that are not known are left out.

    None of them is a CPU time, so that equal runs have equal pages. ``violations`` is the number
    of those that the judge found, if it was asked.
    """
    failed = f", {metrics.orders_failed} failed" if metrics.orders_failed else ""
    found = [
        (
            "Orders done",
            f"{metrics.orders_done} of {metrics.orders}",
            f"{metrics.orders_open} open{failed}",
        ),
        ("Throughput", f"{metrics.throughput:.0f}", "orders done an hour"),
        ("Makespan", clock(metrics.makespan), "when the last order was done"),
    ]
    if metrics.service_time_mean is not None and metrics.service_time_p95 is not None:
        found.append(
            (
                "Service time",
                clock(metrics.service_time_mean),
                f"from release to done; 95 % within {clock(metrics.service_time_p95)}",
            )
        )
    if metrics.tardiness is not None:
        found.append(
            ("Tardiness", clock(metrics.tardiness), f"in all; orders late: {metrics.orders_late}")
        )
    found += [
        ("Utilisation", _percent(metrics.utilisation), "of robot time on trips"),
        (
            "Waiting",
            _percent(metrics.wait_share),
            f"of robot time; {metrics.waits_for_robots} of {metrics.waits} waits for other robots",
        ),
        (
            "Distance",
            f"{metrics.distance:,.0f} m".replace(",", "\u2009"),
            f"{_percent(metrics.empty_share)} of it empty" if metrics.pickups else "",
        ),
        (
            "Energy",
            f"{metrics.energy_used:.2f}",
            f"full charges used; the lowest level was {_percent(metrics.lowest_energy)}",
        ),
        (
            "Decisions",
            str(metrics.decisions.count),
            f"{metrics.decisions.refused} refused",
        ),
    ]
    if violations is not None:
        note = "found by the judge" if violations else "the judge found nothing wrong"
        found.append(("Violations", str(violations), note))
    return found


def _percent(share: float) -> str:
    return f"{100.0 * share:.{0 if share == 0.0 or share >= 0.1 else 1}f}\u202f%"
