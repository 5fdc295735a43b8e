"""What a plan says in plain sentences."""

from clearway.metrics import Metrics
from clearway.model import PlanRecord, Point

# Beyond these many, a sentence counts robots instead of naming them.
NAMED = 8


def count(number: int, noun: str) -> str:
    """Return ``1 robot``, ``8 robots``."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def clock(seconds: float) -> str:
    """Return a duration as ``42.0 s``, ``2 min 11 s`` or ``1 h 02 min``."""
    if seconds < 60.0:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def extent(bounds: tuple[Point, ...]) -> str:
    """Return the site's extent as ``100 m by 60 m``."""
    width, depth = (max(values) - min(values) for values in zip(*bounds, strict=True))
    return f"{width:.4g} m by {depth:.4g} m"


def what_it_is(record: PlanRecord, metrics: Metrics) -> list[str]:
    """Return one or two sentences that tell a stranger what the plan is."""
    who = count(metrics.robots, "robot")
    work = f" carrying out {count(metrics.tasks, 'task')}" if metrics.tasks else ""
    first = f"The planned motion of {who}{work} on a site of {extent(record.site.bounds)}."
    if not record.status:
        done = f"{metrics.tasks_done} of {count(metrics.tasks, 'task')}"
        return [first, f"The plan is not complete: it does {done}."]
    arrival = (
        f"The last robot arrives after {clock(metrics.makespan)}"
        if metrics.makespan
        else "No robot needs to move"
    )
    least = metrics.least_separation
    if least is None or metrics.violations:
        return [first, f"{arrival}."]
    return [
        first,
        f"{arrival}; no two robots come closer to each other than {least.metres:.2f} m"
        f" ({least.first} and {least.second}).",
    ]


def what_went_wrong(record: PlanRecord, metrics: Metrics) -> tuple[str, list[str]] | None:
    """Return a headline and its sentences where the plan is not solved, otherwise ``None``."""
    if record.status:
        return None
    headline = {
        "stopped": "The search was stopped before the plan was complete",
        "infeasible": "There is no plan that does all of this",
    }[str(record.status)]
    reason = f"{(record.reason or 'No reason was recorded').rstrip('.')}."
    open_robots = [entry.robot for entry in metrics.per_robot if not entry.finished]
    if not open_robots:
        return headline, [reason]
    named = ", ".join(open_robots[:NAMED])
    more = len(open_robots) - NAMED
    rest = f" and {more} more" if more > 0 else ""
    return headline, [reason, f"Visits left open: {named}{rest}."]


def what_the_judge_says(violations: int, thing: str) -> tuple[str, list[str]] | None:
    """Return a headline and its sentences where the judge found faults, otherwise ``None``.

    ``thing`` is what it judged, ``plan`` or ``run``.
    """
    if not violations:
        return None
    what = "do not drive this plan" if thing == "plan" else "this run is not right"
    return (
        f"The judge found {count(violations, 'violation')}: {what}",
        [
            "A body overlaps, a limit is broken or a visit is missed. \u201cclearway validate\u201d"
            " on this run's folder lists each one with its time and place."
        ],
    )
