"""Planners tried in turn, each with an effort of its own, until one has a complete plan."""

from collections.abc import Sequence
from dataclasses import replace

from clearway.model import Plan, Problem
from clearway.protocols import Budget, Planner, Progress


class InTurn:
    """Tries planners one after another; the last one has all the effort that is left.

    Parameters
    ----------
    planners
        Those that do not take a problem are passed over, but for the last one.
    expansions
        Effort of each planner before the last.
    """

    def __init__(self, planners: Sequence[Planner], expansions: int) -> None:
        if not planners:
            raise ValueError("there are no planners to try in turn")
        self.planners = tuple(planners)
        self.expansions = expansions

    def unsupported(self, problem: Problem) -> tuple[str, ...]:
        """Return what the last planner cannot take."""
        return self.planners[-1].unsupported(problem)

    def __call__(
        self,
        problem: Problem,
        budget: Budget,
        seed: int,
        progress: Progress | None = None,
    ) -> Plan:
        """Return the first complete plan, or what the last planner has; see `Planner`."""
        spent = 0
        for planner in self.planners[:-1]:
            if planner.unsupported(problem):
                continue
            left = self.expansions
            if budget.expansions is not None:
                left = min(left, budget.expansions - spent)
            plan = planner(problem, replace(budget, expansions=left), seed, progress)
            spent += plan.counters.get("expansions", 0)
            if plan or plan.counters.get("interrupted"):
                return _counted(plan, spent)
        rest = None if budget.expansions is None else budget.expansions - spent
        plan = self.planners[-1](problem, replace(budget, expansions=rest), seed, progress)
        return _counted(plan, spent + plan.counters.get("expansions", 0))


def _counted(plan: Plan, spent: int) -> Plan:
    return replace(plan, counters={**plan.counters, "expansions": spent})
