"""Conflict-based search on bodies: optimal, bounded or adaptive, on a named finite graph."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from clearway import _core
from clearway.model import Plan, Problem, RobotType, Status, Trajectory, to_seconds
from clearway.motion import LATTICE_HEADINGS, MotionModel, lattice_model, model_of
from clearway.motion.lattice import STEP
from clearway.plan.bounds import lower_bounds
from clearway.plan.native_team import NativeTeam
from clearway.plan.prioritised import tasks_in_order, unplannable, walled_in, walled_in_reason
from clearway.protocols import Budget, Progress

HEURISTICS = {
    "look_back": _core.Heuristic.LOOK_BACK,
    "bound": _core.Heuristic.BOUND,
    "paper": _core.Heuristic.PAPER,
}
MODES = {
    "optimal": _core.ConflictMode.OPTIMAL,
    "bounded": _core.ConflictMode.BOUNDED,
    "adaptive": _core.ConflictMode.GREEDY,
}


# A robot without any way is tried once more with steps of this share.
FINER = 0.25


@dataclass(frozen=True)
class ConflictParams:
    """Choices of conflict-based search.

    Parameters
    ----------
    mode
        ``optimal`` and ``bounded`` prove their factor on the graph; ``adaptive`` is greedy.
    factor
        Of ``bounded``: no plan on the graph costs less than the answer over this.
    heuristic
        What is left from a state: ``look_back`` searches back from each goal over the lattice
        (``auto`` in the modes that prove); ``bound`` (``auto`` in the adaptive one) is the way
        round obstacles of the disc in the body, with the turn that is left;
        ``paper`` is eq. 22, which may say too much and therefore proves nothing.
    xi
        Of ``adaptive``: factor on the heuristic (eq. 23).
    fixed
        Keep ``xi`` all the way, instead of letting it fall to 1 towards the goal.
    slot
        Ticks (ms) of which every motion lasts a whole number.
    paper_cost
        Minimise the paper's cost (eq. 21); otherwise the sum of arrivals.
    """

    mode: Literal["optimal", "bounded", "adaptive"] = "adaptive"
    factor: float = 1.05
    heuristic: Literal["auto", "look_back", "bound", "paper"] = "auto"
    xi: float = 1.2
    fixed: bool = False
    slot: int = 100
    paper_cost: bool = True

    def __post_init__(self) -> None:
        for name, least in (("factor", 1.0), ("xi", 1.0), ("slot", 1)):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= least):
                raise ValueError(f"{name} must be {least:g} or above and finite, got {value}")
        if self.mode not in MODES:
            raise ValueError(f"mode must be one of {', '.join(MODES)}, got {self.mode!r}")
        if self.heuristic not in ("auto", *HEURISTICS):
            known = ", ".join(("auto", *HEURISTICS))
            raise ValueError(f"heuristic must be one of {known}, got {self.heuristic!r}")
        if self.heuristic == "paper" and self.mode != "adaptive":
            raise ValueError("heuristic paper may say too much: use mode adaptive with it")

    def native(self) -> _core.ConflictParams:
        """Return the core's parameters."""
        params = _core.ConflictParams()
        params.mode = MODES[self.mode]
        chosen = self.heuristic
        if chosen == "auto":
            chosen = "bound" if self.mode == "adaptive" else "look_back"
        params.heuristic = HEURISTICS[chosen]
        params.factor, params.xi, params.adaptive = self.factor, self.xi, not self.fixed
        lattice, objective = params.lattice, params.objective
        lattice.slot = self.slot
        objective.time = not self.paper_cost
        params.lattice, params.objective = lattice, objective
        return params


def _tables(share: float) -> Callable[[RobotType], tuple[MotionModel, MotionModel]]:
    """Return how a type's lattice model is made, its step cut to a share; for both resolutions."""

    def tables(robot_type: RobotType) -> tuple[MotionModel, MotionModel]:
        model = lattice_model(robot_type, model_of(robot_type, LATTICE_HEADINGS), share)
        return model, model

    return tables


class ConflictBasedSearch:
    """Plans each robot alone, then resolves the first conflict by one rule or its counterpart.

    The graph of a robot: poses that quarter arcs, quarter turns and steps of about a metre
    reach from its start (or last visit), told apart exactly, and from each of them the two
    best analytic ways to the next visit once it is near; motions and waits last whole slots.

    References
    ----------
    Zhang et al., system A, Algorithm 2; the constraint and the modes are our reading.
    Sharon, G. et al. (2015). Conflict-based search for optimal multi-agent pathfinding. AIJ 219.
    Andreychuk, A. et al. (2022). Multi-agent pathfinding with continuous time. AIJ 305.
    """

    def __init__(self, params: ConflictParams | None = None) -> None:
        self.params = params or ConflictParams()

    def unsupported(self, problem: Problem) -> tuple[str, ...]:
        """Return what in the problem this planner cannot take."""
        reasons = list(unplannable(problem))
        for name in sorted({robot.type for robot in problem.robots}):
            if problem.robot_types[name].limits.has_ramps:
                reasons.append(
                    f"robot type {name}: conflict-based search knows no limits on acceleration; "
                    "remove them or plan by priorities"
                )
        for robot in problem.robots:
            state = problem.state_of(robot)
            if robot.start_speed or state.committed or state.tick or robot.id in problem.fixed:
                reasons.append(
                    f"robot {robot.id}: conflict-based search begins at rest, with all robots"
                )
        return tuple(reasons)

    def graph(self, share: float = 1.0) -> str:
        """Return the name of the finite graph that optima and factors refer to."""
        lattice = _core.LatticeParams()
        return (
            f"lattice of {LATTICE_HEADINGS} headings and steps of about {STEP * share:g} m, "
            f"slots of {self.params.slot / 1000:g} s, "
            f"{lattice.shot_words} shots from every pose within {lattice.shot_reach:g} m"
        )

    def __call__(
        self,
        problem: Problem,
        budget: Budget,
        seed: int,
        progress: Progress | None = None,
    ) -> Plan:
        """Return a plan; see `clearway.protocols.Planner`. There is no chance in it."""
        if not problem.robots:
            return Plan(Status.SOLVED, {}, {}, {}, lower_bound=0.0, cost_lower_bound=0.0)
        reasons = self.unsupported(problem)
        if reasons:
            raise ValueError("; ".join(reasons))
        bounds = lower_bounds(problem)
        left, spent, shares = budget.expansions, 0, (1.0, FINER)
        for share in shares:
            team = NativeTeam(problem, bounds, _tables(share))
            answer = _core.search_conflicts(
                team.models,
                team.agents,
                self.params.native(),
                -1 if left is None else left - spent,
                budget.seconds,
                _told(progress, len(problem.robots), not self.params.paper_cost, bounds.seconds),
            )
            spent += answer.expansions
            stuck = answer.status == _core.ConflictStatus.NONE and answer.concerned
            if not stuck or answer.too_large:
                break
        solved = answer.status == _core.ConflictStatus.SOLVED
        concerned = team.ids(answer.concerned)
        status = Status.SOLVED if solved else Status.STOPPED
        reason = None if solved else self._reason(answer, concerned)
        if stuck and any(walled_in(problem, robot) for robot in concerned):
            status, reason = Status.INFEASIBLE, walled_in_reason(concerned)
        if not solved and not concerned:
            concerned = tuple(r.id for r in problem.robots if problem.tours.get(r.id))
        trajectories = {}
        for i, robot in enumerate(problem.robots):
            if solved and team.agents[i].legs:
                trajectories[robot.id] = team.trajectory(i, answer.tours[i])
        return Plan(
            status=status,
            reason=reason,
            concerned=concerned,
            trajectories=trajectories,
            tours=problem.tours,
            assignment={robot.id: tasks_in_order(problem, robot.id) for robot in problem.robots},
            lower_bound=bounds.seconds,
            cost_lower_bound=bounds.metres,
            discrete_bound=self._proven(answer, share, trajectories),
            counters={
                "expansions": spent,
                "searches": answer.searches,
                "nodes": answer.nodes,
                "largest_group": answer.largest_group,
                "proven": int(answer.proven),
                "interrupted": int(answer.interrupted),
            },
        )

    def _proven(
        self,
        answer: _core.ConflictAnswer,
        share: float,
        trajectories: Mapping[str, Trajectory],
    ) -> dict[str, str | float]:
        """Return the graph, and what is known of all plans on it, rounded so that it stays true.

        Waiting for its time where a robot rests anyway is a cost on the graph and none in the sum
        of arrivals: where that shows, nothing is told.
        """
        proven: dict[str, str | float] = {
            "of": "cost" if self.params.paper_cost else "sum_of_costs",
            "graph": self.graph(share),
        }
        if self.params.mode != "adaptive":
            unit = 1.0 if self.params.paper_cost else 1000.0
            value = math.floor(1e6 * answer.bound / unit) / 1e6
            solved = answer.status == _core.ConflictStatus.SOLVED
            arrivals = math.fsum(to_seconds(way.end) for way in trajectories.values())
            if solved and not self.params.paper_cost and value > arrivals + 1e-6:
                return proven
            proven["value"] = value
            if solved and (value > 0.0 or answer.cost == 0.0):
                factor = answer.cost / unit / value if value > 0.0 else 1.0
                proven["factor"] = math.ceil(1e6 * max(factor, 1.0)) / 1e6
        return proven

    def _reason(self, answer: _core.ConflictAnswer, concerned: tuple[str, ...]) -> str:
        names = ", ".join(concerned)
        if answer.interrupted:
            return "interrupted before the conflicts were resolved"
        if answer.too_large:
            return f"the lattice of {names} is too large to look back over; use heuristic bound"
        if answer.status == _core.ConflictStatus.NONE:
            return f"no plan on this lattice{' for ' + names if names else ''}"
        return "the budget ended before the conflicts were resolved"


def _told(
    progress: Progress | None, robots: int, seconds: bool, bound: float
) -> Callable[[int, int, float, float], None] | None:
    if progress is None:
        return None

    def tell(conflicts: int, expansions: int, cost: float, proven: float) -> None:
        if cost > 0.0 and seconds:
            progress(robots, robots, expansions, cost / 1000.0, max(bound, proven / 1000.0))
        else:
            progress(max(0, robots - conflicts), robots, expansions)

    return tell
