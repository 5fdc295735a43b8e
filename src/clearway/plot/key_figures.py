"""The key figures of a run for its page: name, value, and a note."""

from clearway.metrics import TraceMetrics
from clearway.plot.sentences import clock


def key_figures(metrics: TraceMetrics, violations: int) -> list[tuple[str, str, str]]:
    """Return the figures in the order of the page; those that are not known are left out."""
    cpu = metrics.decisions
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
    return [
        *found,
        ("Utilisation", _percent(metrics.utilisation), "of robot time on trips"),
        (
            "Waiting",
            _percent(metrics.wait_share),
            f"of robot time; {metrics.waits_for_robots} of {metrics.waits} waits for other robots",
        ),
        (
            "Distance",
            f"{metrics.distance:,.0f} m".replace(",", "\u2009"),
            f"{_percent(metrics.empty_share)} of it empty",
        ),
        (
            "Energy",
            f"{metrics.energy_used:.2f}",
            f"full charges used; the lowest level was {_percent(metrics.lowest_energy)}",
        ),
        (
            "Decisions",
            str(cpu.count),
            f"{cpu.refused} refused; {1e3 * cpu.cpu_median:.1f} ms CPU each (median)",
        ),
        (
            "Violations",
            str(violations),
            "found by the judge" if violations else "the judge found nothing wrong",
        ),
    ]


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f}\u202f%"
