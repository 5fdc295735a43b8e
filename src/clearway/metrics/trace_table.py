"""The figures of a run through time, as a table to read."""

from clearway.metrics.trace_metrics import TraceMetrics


def told(metrics: TraceMetrics) -> str:
    """Return a table of the run's figures, one to a line, without a line end."""
    width = max(len(name) for name, _ in _rows(metrics))
    return "\n".join(f"  {name:<{width}}  {text}" for name, text in _rows(metrics))


def _rows(metrics: TraceMetrics) -> list[tuple[str, str]]:
    rows = [
        ("orders", _orders(metrics)),
        ("throughput", f"{metrics.throughput:.1f} orders an hour over {metrics.duration:.0f} s"),
        ("makespan", f"{metrics.makespan:.1f} s"),
    ]
    if metrics.service_time_mean is not None and metrics.service_time_p95 is not None:
        text = f"{metrics.service_time_mean:.1f} s from release to done, 95 % of orders within "
        rows.append(("service time", f"{text}{metrics.service_time_p95:.1f} s"))
    if metrics.tardiness is not None:
        text = (
            f"{metrics.tardiness:.1f} s after due times in all, orders late: {metrics.orders_late}"
        )
        rows.append(("tardiness", text))
    cpu = metrics.decisions
    return [
        *rows,
        ("utilisation", f"{_percent(metrics.utilisation)} of robot time on trips"),
        ("waiting", _waiting(metrics)),
        ("distance", _distance(metrics)),
        ("energy", _energy(metrics)),
        (
            "decisions",
            f"{cpu.count}, {cpu.refused} refused; CPU {cpu.cpu_total:.2f} s, median "
            f"{1e3 * cpu.cpu_median:.1f} ms, 99 % within {1e3 * cpu.cpu_p99:.1f} ms",
        ),
    ]


def _orders(metrics: TraceMetrics) -> str:
    failed = f", {metrics.orders_failed} failed" if metrics.orders_failed else ""
    return (
        f"{metrics.orders_done} of {metrics.orders} done, {metrics.orders_open} open{failed} "
        f"({metrics.robots} robots, {metrics.status})"
    )


def _waiting(metrics: TraceMetrics) -> str:
    return (
        f"{_percent(metrics.wait_share)} of robot time, {metrics.waiting:.0f} s; {metrics.waits} "
        f"waits, {metrics.waits_for_robots} for other robots"
    )


def _distance(metrics: TraceMetrics) -> str:
    empty = f", {_percent(metrics.empty_share)} of it empty" if metrics.pickups else ""
    return f"{metrics.distance:.0f} m{empty}"


def _energy(metrics: TraceMetrics) -> str:
    return (
        f"{metrics.energy_used:.2f} full charges used, the lowest level "
        f"{_percent(metrics.lowest_energy)}"
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
