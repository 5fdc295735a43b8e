"""A plan made into the record that plan files hold."""

from collections.abc import Mapping
from typing import Any

from clearway.formats.sampling import sample
from clearway.model import Plan, PlanRecord, Scenario, to_seconds


def record_plan(
    scenario: Scenario,
    plan: Plan,
    *,
    seed: int,
    version: str,
    cost: float | None = None,
    cost_name: str | None = None,
    parameters: Mapping[str, Any] | None = None,
    timings: Mapping[str, Any] | None = None,
) -> PlanRecord:
    """Sample a plan's trajectories and put everything beside them that a judge needs."""
    ends = [to_seconds(trajectory.end) for trajectory in plan.trajectories.values()]
    has_modes = {
        robot.id: scenario.type_of(robot).kinematics == "four_wheel" for robot in scenario.robots
    }
    return PlanRecord(
        scenario=scenario.name,
        system=scenario.system,
        seed=seed,
        status=plan.status,
        reason=plan.reason,
        site=scenario.site,
        robot_types=dict(scenario.robot_types),
        robots=scenario.robots,
        tours=dict(plan.tours),
        tracks={id_: sample(path, has_modes[id_]) for id_, path in plan.trajectories.items()},
        paths=dict(plan.trajectories),
        assignment=dict(plan.assignment),
        sum_of_costs=round(sum(ends), 6),
        makespan=max(ends, default=0.0),
        lower_bound=plan.lower_bound,
        cost=cost,
        cost_name=cost_name,
        cost_lower_bound=plan.cost_lower_bound if cost is not None else None,
        discrete_bound=plan.discrete_bound,
        conflict_free_until=plan.conflict_free_until,
        parameters={
            **(parameters or {}),
            **{k: v for k, v in plan.counters.items() if k != "interrupted"},
        },
        timings=dict(timings or {}),
        version=version,
    )
