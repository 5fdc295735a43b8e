"""Tasks shared out anew for what their ways have proved to take among others."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from clearway.coordinate.value import Value, lateness
from clearway.model import Plan, Scenario, Trajectory, Visit, to_seconds
from clearway.protocols import AssignmentProblem, Budget, Routes

# Share of a limited budget that all first plans have together.
TRIALS = 0.25


@dataclass(frozen=True)
class Reassignment:
    """Plans, learns how long the legs last, shares out the tasks anew, and plans again.

    A leg that lasts longer in a plan than was believed, for waits and detours, or less long, is
    believed to last as long from then on, for that robot. The best plan is kept: the one least
    late where tasks are due, then of the least value. These are first plans; the rest of a
    limited budget goes into one more of the best routes.

    Parameters
    ----------
    assign
        Shares out the tasks of a problem.
    plan
        Plans the tours of some routes.
    value
        What is to be less.
    rounds
        How often tasks are shared out anew, at most; none follows one that changes nothing.
    """

    scenario: Scenario
    assign: Callable[[AssignmentProblem], Routes]
    plan: Callable[[Routes, Budget], Plan]
    value: Value
    rounds: int

    def __call__(self, work: AssignmentProblem, routes: Routes, budget: Budget) -> Plan:
        """Return the best plan that comes of the first routes; its counters tell the gain."""
        part = TRIALS / (self.rounds + 1)
        tried = [routes]
        plans = [self.plan(routes, budget.share(part).first_plan)]
        for _ in range(self.rounds):
            if not plans[-1] or plans[-1].counters.get("interrupted"):
                break
            work = learned(self.scenario, work, tried[-1], plans[-1])
            routes = self.assign(work)
            if routes in tried:
                break
            tried.append(routes)
            plans.append(self.plan(routes, budget.share(part).first_plan))
        number = min(
            (i for i, plan in enumerate(plans) if plan),
            key=lambda i: self._worth(plans[i]),
            default=0,
        )
        best, gain = plans[number], 0.0
        if number:
            gain = 1.0 - self._worth(best)[1] / self._worth(plans[0])[1]
        if not (budget.is_unlimited or plans[-1].counters.get("interrupted")):
            spent = budget.spent(part * len(plans), _expansions(plans))
            plans.append(self.plan(tried[number], budget.share(1.0 - spent)))
            if not best or (plans[-1] and self._worth(plans[-1]) <= self._worth(best)):
                best = plans[-1]
        counters = {
            **best.counters,
            "expansions": _expansions(plans),
            "interrupted": plans[-1].counters.get("interrupted", 0),
            "reassigned": number,
            "reassignment_gain_permille": round(1000.0 * gain),
        }
        return replace(best, counters=counters)

    def _worth(self, plan: Plan) -> tuple[float, ...]:
        return lateness(plan), *self.value(self.scenario, plan)


def learned(
    scenario: Scenario, work: AssignmentProblem, routes: Routes, plan: Plan
) -> AssignmentProblem:
    """Return the problem with the ways that a plan's legs have, at the problem's speed.

    Nothing is learnt of legs to visits that must wait for their time or for other tasks.
    """
    start, between, inner = (
        np.array(ways) for ways in (work.start_to_task, work.task_to_task, work.inner)
    )
    for k, (robot, route) in enumerate(zip(scenario.robots, routes, strict=True)):
        if robot.id not in plan.trajectories:
            continue
        seconds = _leg_seconds(plan.trajectories[robot.id], plan.tours[robot.id])
        before: int | None = None
        for j in route:
            first, *later = [next(seconds) for _ in scenario.orders[j].task.visits]
            if first is not None and before is None:
                start[k, j] = first * work.speed
            elif first is not None:
                between[k, before, j] = first * work.speed
            if later and None not in later:
                inner[k, j] = work.speed * sum(part or 0.0 for part in later)
            before = j
    return replace(work, start_to_task=start, task_to_task=between, inner=inner)


def _expansions(plans: Sequence[Plan]) -> int:
    return sum(plan.counters.get("expansions", 0) for plan in plans)


def _leg_seconds(path: Trajectory, tour: Sequence[Visit]) -> Iterator[float | None]:
    """Yield how long each leg takes (s); ``None`` where the visit had to wait for something."""
    left = 0
    for stop in path.stops:
        visit = tour[stop.visit]
        yield None if visit.not_before or visit.after else to_seconds(stop.arrive - left)
        left = stop.leave
