"""Prioritised planning with soft search, rip-up and restarts, in the native core."""

from collections.abc import Callable

from clearway import _core
from clearway.model import LOAD_CHANGE, Limits, Plan, Problem, RobotState, Status, to_seconds
from clearway.motion import can_ramp, models_for
from clearway.plan.bounds import lower_bounds
from clearway.plan.native_team import NativeTeam
from clearway.protocols import Budget, Progress

Aim = _core.Aim
TeamParams = _core.TeamParams
# The last step (s) of a ramp to rest, at the most.
LAST_STEP = 0.12


class PrioritisedPlanner:
    """Plans robots one after another, shortest tour first; each avoids those before it.

    A robot that finds no way runs a soft search that may run into others at a price; those
    it hits are planned anew. Too many of these end a round, and the next begins with another
    order. Every motion is checked continuously against true footprints.

    References
    ----------
    Erdmann, M., Lozano-Perez, T. (1987). On multiple moving objects. Algorithmica 2.
    Phillips, M., Likhachev, M. (2011). SIPP: safe interval path planning for dynamic
    environments. ICRA.
    """

    def __init__(self, params: TeamParams | None = None) -> None:
        self.params = params or TeamParams()

    def unsupported(self, problem: Problem) -> tuple[str, ...]:
        """Return what in the problem this planner cannot take."""
        return unplannable(problem)

    def __call__(
        self,
        problem: Problem,
        budget: Budget,
        seed: int,
        progress: Progress | None = None,
    ) -> Plan:
        """Return a plan; see `clearway.protocols.Planner`."""
        if not problem.robots:
            return Plan(Status.SOLVED, {}, {}, {}, lower_bound=0.0, cost_lower_bound=0.0)
        bounds = lower_bounds(problem)
        team = NativeTeam(problem, bounds)
        answer = _core.plan_team(
            team.models,
            team.agents,
            self.params,
            seed,
            -1 if budget.expansions is None else budget.expansions,
            budget.seconds,
            _with_bound(progress, bounds.seconds),
            budget.improve,
        )
        trajectories = {}
        tours, planned = answer.tours, answer.planned
        for i, robot in enumerate(problem.robots):
            committed = problem.state_of(robot).committed
            if planned[i] and team.agents[i].legs:
                trajectories[robot.id] = team.trajectory(i, tours[i])
            elif committed:
                trajectories[robot.id] = committed
        trajectories.update(problem.fixed)
        concerned = team.ids(answer.concerned)
        status, reason = _verdict(problem, answer, concerned, self.params)
        return Plan(
            status=status,
            reason=reason,
            concerned=concerned,
            trajectories=trajectories,
            tours=problem.tours,
            conflict_free_until=None
            if answer.conflict_free_until >= _core.NEVER
            else to_seconds(answer.conflict_free_until),
            assignment={robot.id: tasks_in_order(problem, robot.id) for robot in problem.robots},
            lower_bound=bounds.seconds,
            cost_lower_bound=bounds.metres,
            counters={
                "expansions": answer.expansions,
                "searches": answer.searches,
                "rip_ups": answer.rip_ups,
                "restarts": answer.restarts,
                "repairs": answer.repairs,
                "repaired": answer.repaired,
                "first_expansions": answer.first_expansions,
                "first_sum_of_costs_ms": round(1000.0 * answer.first_cost),
                "interrupted": int(answer.interrupted),
            },
        )


def unplannable(problem: Problem) -> tuple[str, ...]:
    """Return what in a problem no planner here can take."""
    reasons = []
    for name in {robot.type for robot in problem.robots}:
        robot_type = problem.robot_types[name]
        known = models_for(robot_type.kinematics)
        if robot_type.motion not in (None, *known):
            reasons.append(
                f"robot type {name}: {robot_type.motion} is no motion model of "
                f"{robot_type.kinematics} robots; known: {', '.join(known)}"
            )
        elif robot_type.limits.has_ramps and not can_ramp(robot_type):
            reasons.append(
                f"robot type {name}: acceleration limits of robots that drive in any "
                "direction at once are not planned for; remove them"
            )
    for robot in problem.robots:
        limits = problem.robot_types[robot.type].limits
        if robot.start_speed and limits.has_ramps:
            reasons.append(
                f"robot {robot.id}: a start in motion is not planned for where acceleration "
                "is limited"
            )
        if limits.has_ramps and _ends_at_speed(problem.state_of(robot), limits):
            reasons.append(
                f"robot {robot.id}: a committed motion that ends at speed is not planned on "
                "from where acceleration is limited; commit it until it rests"
            )
        for visit in problem.tours.get(robot.id, ()):
            if visit.together:
                reasons.append(
                    f"robot {robot.id}, task {visit.task}: visits together are not planned for"
                )
    return tuple(sorted(reasons))


def _with_bound(
    progress: Progress | None, bound: float
) -> Callable[[int, int, int, float | None], None] | None:
    if progress is None:
        return None
    return lambda planned, total, expansions, cost: progress(
        planned, total, expansions, cost, bound
    )


def _ends_at_speed(state: RobotState, limits: Limits) -> bool:
    """Whether a robot is faster at the end of its prefix than at the end of a ramp to rest."""
    prefix = state.committed
    if prefix is None or not prefix.pieces or prefix.timing[-1][1] < state.tick:
        return False
    begin, end = prefix.timing[-1]
    rates = (limits.acceleration, limits.deceleration)
    slower = min(rate for rate in rates if rate is not None)
    return prefix.pieces[-1].length / to_seconds(end - begin) > LAST_STEP * slower


def tasks_in_order(problem: Problem, robot: str) -> tuple[str, ...]:
    """Return the tasks of a robot in the order of their first visits."""
    tasks = (visit.task for visit in problem.tours.get(robot, ()))
    return tuple(dict.fromkeys(task for task in tasks if task is not None))


def walled_in(problem: Problem, robot_id: str) -> bool:
    """Whether even the inscribed circle of the body has no way through the robot's tour."""
    from clearway.world.reach import BodyReach

    robot = next(robot for robot in problem.robots if robot.id == robot_id)
    robot_type = problem.robot_types[robot.type]
    state = problem.state_of(robot)
    at, loads = state.pose, int(state.loaded)
    reaches: dict[bool, BodyReach] = {}
    for visit in problem.tours[robot_id]:
        loaded = loads > 0
        if loaded not in reaches:
            shape = robot_type.shape(loaded)
            reaches[loaded] = BodyReach(problem.site, robot.type, loaded, shape)
        here, there = (reaches[loaded].component(pose) for pose in (at, visit.pose))
        if here != there or here == 0:
            return True
        at = visit.pose
        loads += LOAD_CHANGE[visit.load]
    return False


def walled_in_reason(robots: tuple[str, ...]) -> str:
    """Return the sentence for robots that are walled in."""
    return (
        f"{', '.join(robots)} is walled in: with nobody else on the site there is no way even for "
        "the largest disc inside its body"
    )


def _verdict(
    problem: Problem, answer: _core.TeamAnswer, concerned: tuple[str, ...], params: TeamParams
) -> tuple[Status, str | None]:
    names = ", ".join(concerned)
    if answer.status == _core.TeamStatus.SOLVED:
        return Status.SOLVED, None
    if answer.interrupted:
        return Status.STOPPED, f"interrupted; not planned: {names}"
    if answer.status == _core.TeamStatus.STUCK:
        if any(walled_in(problem, robot) for robot in concerned):
            return Status.INFEASIBLE, walled_in_reason(concerned)
        return Status.STOPPED, (
            f"no plan on this lattice for {names}, alone on the site and with 64 headings; "
            "widen the passage or move the goal"
        )
    if answer.restarts > params.restarts:
        memory = (
            f" ({answer.full} searches stopped at their limit of "
            f"{params.search.most_nodes:,} states in memory)"
            if answer.full
            else ""
        )
        return (
            Status.STOPPED,
            f"no plan in {params.restarts} restarts{memory}; not planned: {names}",
        )
    return Status.STOPPED, f"the budget ended; not planned: {names}"
