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
from clearway.validate.finding import Finding
from clearway.validate.legality import check_scenario

Clock = Callable[[], float]

# Up to so many robots the closest encounter of every pair is told.
FEW_ROBOTS = 16


class IllegalScenario(ValueError):
    """A scenario whose own poses cannot be; ``findings`` hold all that is wrong."""

    def __init__(self, findings: tuple[Finding, ...]) -> None:
        # First what makes all else pointless.
        ordered = sorted(findings, key=lambda finding: finding.kind != "no_room")
        self.findings = tuple(ordered)
        first, more = ordered[0], len(ordered) - 1
        self.key = first.key
        tail = f" (and {more} more)" if more else ""
        super().__init__(f"{first.key}: {first.text}{tail}")


@dataclass(frozen=True)
class Planned:
    """A plan with its record, not judged yet."""

    plan: Plan
    record: PlanRecord

    @property
    def interrupted(self) -> bool:
        """Whether a person stopped the search."""
        return bool(self.plan.counters.get("interrupted"))


@dataclass(frozen=True)
class Run(Planned):
    """A plan with its record, figures and the judge's findings.

    Where a person stopped the search, separations are not measured.
    """

    metrics: Metrics
    violations: tuple[Violation, ...]


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
    planned = make_plan(
        scenario, system=system, budget=budget, seed=seed, progress=progress, clock=clock
    )
    return judge_plan(planned, clock=clock)


def make_plan(
    scenario: Scenario,
    *,
    system: System | None = None,
    budget: Budget | None = None,
    seed: int | None = None,
    progress: Progress | None = None,
    clock: Clock | None = None,
) -> Planned:
    """Check, assign and plan a scenario; see `solve`."""
    lap = _Laps(clock)
    legality = check_scenario(scenario)
    if not legality:
        raise IllegalScenario(legality.errors)
    chosen = system or choose_system(scenario)
    seed = scenario.seed if seed is None else seed
    lap("check_s")

    def told(
        planned: int,
        total: int,
        expansions: int,
        sum_of_costs: float | None = None,
        lower_bound: float | None = None,
    ) -> None:
        if sum_of_costs is not None:
            lap.once("first_plan_s")
        if progress:
            progress(planned, total, expansions, sum_of_costs, lower_bound)

    plan = plan_once(
        scenario,
        chosen,
        budget or Budget(),
        seed,
        told,
        before_planning=lambda: lap("assign_s"),
    )
    lap("plan_s")
    cost = sum(
        paper_cost(plan.trajectories[robot.id], scenario.type_of(robot), robot.start_mode)
        for robot in scenario.robots
        if robot.id in plan.trajectories
    )
    record = record_plan(
        scenario,
        plan,
        seed=seed,
        version=version("clearway"),
        cost=cost,
        cost_name="paper",
        parameters=chosen.parameters,
    )
    lap("sample_s")
    return Planned(plan, replace(record, timings=lap.seconds))


def judge_plan(planned: Planned, *, clock: Clock | None = None) -> Run:
    """Judge a plan and measure it."""
    lap = _Laps(clock)
    record = planned.record
    violations = tuple(validate_plan(record))
    # Who presses Ctrl-C wants the end, not the closest encounters.
    apart = [] if planned.interrupted else _closest(record)
    metrics = plan_metrics(record, apart, len(violations))
    lap("judge_s")
    record = replace(record, timings={**record.timings, **lap.seconds})
    return Run(planned.plan, record, metrics, violations)


def _closest(record: PlanRecord) -> list[tuple[str, str, float, float]]:
    """Return how near the robots of each pair come; of many robots, of those that come near."""
    if len(record.robots) > FEW_ROBOTS:
        for within in (0.5, 2.0, 8.0):
            if apart := separations(record, within):
                return apart
    return separations(record)


class _Laps:
    """Seconds between calls, by name; empty without a clock."""

    def __init__(self, clock: Clock | None) -> None:
        self._clock = clock
        self._last = clock() if clock else 0.0
        self.seconds: dict[str, float] = {}

    def __call__(self, name: str) -> None:
        if self._clock:
            now = self._clock()
            self.seconds[name] = round(now - self._last, 4)
            self._last = now

    def once(self, name: str) -> None:
        """Note how far the lap is, the first time only."""
        if self._clock and name not in self.seconds:
            self.seconds[name] = round(self._clock() - self._last, 4)
