"""Whether the figures that a plan states are those of its trajectories."""

from clearway.model import PlanRecord, Status
from clearway.validate.steps import last_arrival, track_of
from clearway.validate.violation import Violation

TIME = 1e-3
SHARE = 1e-9


def judge_figures(record: PlanRecord) -> list[Violation]:
    """Return figures, bounds, assignment and status that are not right."""
    arrivals = [last_arrival(track_of(record, robot)) for robot in record.robots]
    total, latest = sum(arrivals), max(arrivals, default=0.0)
    found: list[Violation] = []
    for kind, stated, true in (
        ("sum_of_costs", record.sum_of_costs, total),
        ("makespan", record.makespan, latest),
    ):
        if abs(stated - true) > TIME + SHARE * abs(true):
            found.append(whole(kind, f"stated {stated:.6f} s, by the trajectories {true:.6f} s"))
    # A plan that is not finished may cost less than any finished one.
    if record.status:
        if record.lower_bound is not None and record.lower_bound > total + TIME:
            text = f"{record.lower_bound:.6f} s is above the sum of costs, {total:.6f} s"
            found.append(whole("lower_bound", text))
        bound, cost = record.cost_lower_bound, record.cost
        if bound is not None and cost is not None and bound > cost + 1e-6 * abs(cost) + 1e-6:
            found.append(whole("cost_lower_bound", f"{bound:.6f} is above the cost, {cost:.6f}"))
    if record.status is not Status.SOLVED and not record.reason:
        found.append(whole("status", f"a plan that is {record.status.value} gives no reason"))
    return found + _assignment(record)


def whole(kind: str, text: str) -> Violation:
    """Return a violation that is about the whole plan."""
    return Violation(kind, (), 0.0, (0.0, 0.0), None, text)


def _assignment(record: PlanRecord) -> list[Violation]:
    found = []
    for robot in record.robots:
        visits = record.tours.get(robot.id, ())
        tasks = tuple(dict.fromkeys(v.task for v in visits if v.task is not None))
        stated = tuple(record.assignment.get(robot.id, ()))
        if stated != tasks:
            text = f"{_listed(stated)} assigned, but the visits are of {_listed(tasks)}"
            place = (robot.start.x, robot.start.y)
            found.append(Violation("assignment", (robot.id,), 0.0, place, None, text))
    return found


def _listed(tasks: tuple[str, ...]) -> str:
    return ", ".join(tasks) or "nothing"
