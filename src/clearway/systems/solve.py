"""From a scenario to a judged plan in one call."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.metadata import version

from clearway.coordinate import System, plan_once
from clearway.formats.recording import record_plan
from clearway.metrics import Metrics, plan_metrics
from clearway.metrics.paper_cost import paper_cost
from clearway.model import Plan, PlanRecord, Scenario
from clearway.protocols import Budget, Progress
from clearway.systems.choose import choose_system
from clearway.validate import Violation, separations, validate_plan
from clearway.validate.legality import Finding, check_scenario

Clock = Callable[[], float]


class IllegalScenario(ValueError):
    """A scenario whose own poses cannot be; ``findings`` hold all that is wrong."""

    def __init__(self, findings: tuple[Finding, ...]) -> None:
        self.findings = findings
        first, more = findings[0], len(findings) - 1
        tail = f" (and {more} more)" if more else ""
        super().__init__(f"{first.key}: {first.text}{tail}")


@dataclass(frozen=True)
class Run:
    """A plan with its record, figures and the judge's findings.

    ``interrupted`` tells that a person stopped the search; then separations are not measured.
    """

    plan: Plan
    record: PlanRecord
    metrics: Metrics
    violations: tuple[Violation, ...]

    @property
    def interrupted(self) -> bool:
        """Whether a person stopped the search."""
        return bool(self.plan.counters.get("interrupted"))


def solve(
    scenario: Scenario,
    *,
    system: System | None = None,
    budget: Budget | None = None,
    seed: int | None = None,
    progress: Progress | None = None,
    clock: Clock | None = None,
) -> Run:
    """Check, assign, plan and judge a scenario.

    Parameters
    ----------
    system
        Parts to use; absent: those that the scenario names.
    seed
        Absent: the scenario's own.
    clock
        Source of the seconds reported in ``timings``; absent: no timings.

    Raises
    ------
    IllegalScenario
        If a start or visit pose cannot be, or no robot can reach a task.
    ValueError
        If the system or a setting is unknown, or a part cannot take a feature.
    """
    now = clock or (lambda: 0.0)
    begin = now()
    legality = check_scenario(scenario)
    if not legality:
        raise IllegalScenario(legality.errors)
    chosen = system or choose_system(scenario)
    seed = scenario.seed if seed is None else seed
    checked = now()
    assigned: list[float] = []
    plan = plan_once(
        scenario,
        chosen,
        budget or Budget(),
        seed,
        progress,
        before_planning=lambda: assigned.append(now()),
    )
    planned = now()
    types = {robot.id: scenario.type_of(robot) for robot in scenario.robots}
    cost = sum(paper_cost(path, types[id_]) for id_, path in plan.trajectories.items())
    record = record_plan(
        scenario,
        plan,
        seed=seed,
        version=version("clearway"),
        cost=cost,
        cost_name="paper",
        parameters=chosen.parameters,
    )
    sampled = now()
    violations = tuple(validate_plan(record))
    # Who presses Ctrl-C wants the end, not the closest encounters.
    interrupted = plan.counters.get("interrupted")
    metrics = plan_metrics(record, [] if interrupted else separations(record), len(violations))
    judged = now()
    if clock:
        timings = {
            "check_s": checked - begin,
            "assign_s": assigned[0] - checked,
            "plan_s": planned - assigned[0],
            "sample_s": sampled - planned,
            "judge_s": judged - sampled,
        }
        record = replace(record, timings={k: round(v, 4) for k, v in timings.items()})
    return Run(plan, record, metrics, violations)
