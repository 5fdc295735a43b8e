"""Tasks that wait for others, in motion: visits get times until a plan keeps their order."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from clearway.model import Plan, Problem, Status, Visit, to_seconds
from clearway.plan.bounds import Leg, tour_bounds
from clearway.protocols import Budget, Planner, Progress

# Plans made until one keeps the order. Of a limited budget, first plans that look for times have
# this share, doubled where it was not enough for one; the last plan has the rest.
MOST_TRIALS = 12
SHARE = 1.0 / 16.0

Tours = Mapping[str, tuple[Visit, ...]]


def plan_in_order(
    plan: Planner,
    problem: Problem,
    budget: Budget,
    seed: int,
    progress: Progress | None = None,
) -> Plan:
    """Return a plan in which no visit is served before the tasks it waits for are finished.

    Planners know times but not each other's tasks, so that a visit that waits gets a time
    before which it is not served: first the earliest at which what it waits for could be
    finished, then, where a plan shows that this is later, that. Once these times do, the rest
    of a limited budget goes into one more plan. The lower bound is that of the first times.

    Tasks that are in no tour are finished already. Where the order is not kept in the end, the
    plan is ``stopped`` and its reason names the tasks that begin too early.
    """
    if not any(visit.after for tour in problem.tours.values() for visit in tour):
        return plan(problem, budget, seed, progress)
    legs = tour_bounds(problem)
    tours, entangled = _with_times(problem.tours, legs, {})
    if entangled:
        reason = f"the tours wait for each other at {', '.join(entangled)}"
        return _nothing(problem, reason, entangled)
    kept, bound, expansions = None, None, 0
    share, parts = SHARE, 0.0
    for trial in range(MOST_TRIALS):
        left = 1.0 - budget.spent(parts, expansions)
        final = kept is not None or left < 2.0 * share or trial == MOST_TRIALS - 1
        part = budget.share(left) if final else budget.share(share).first_plan
        answer = plan(replace(problem, tours=tours), part, seed, progress)
        expansions += answer.counters.get("expansions", 0)
        bound = answer.lower_bound if trial == 0 else bound
        found = bool(answer)
        finished = _finished(problem.tours, answer)
        if found and not _early(problem.tours, answer, finished):
            kept = answer
            final = final or budget.is_unlimited or not budget.improve
        if final or answer.counters.get("interrupted") or (not found and budget.is_unlimited):
            break
        parts += share
        if not found:
            share *= 2.0
        elif kept is None:
            tours, _ = _with_times(tours, legs, finished)
    chosen = kept if kept is not None else answer
    early = _early(problem.tours, chosen, finished) if kept is None and found else ()
    counters = {
        **chosen.counters,
        "expansions": expansions,
        "interrupted": answer.counters.get("interrupted", 0),
        "trials": trial + 1,
    }
    chosen = replace(chosen, tours=problem.tours, lower_bound=bound, counters=counters)
    if not early:
        return chosen
    reason = f"in {trial + 1} plans, too early for the tasks they wait for: {', '.join(early)}"
    return replace(
        chosen, status=Status.STOPPED, reason=reason, concerned=_doing(problem.tours, early)
    )


def _with_times(
    tours: Tours, legs: Mapping[str, Sequence[Leg]], finished: Mapping[str, float]
) -> tuple[dict[str, tuple[Visit, ...]], tuple[str, ...]]:
    """Return the tours with times for the visits that wait, and tasks that wait for each other.

    Each leg takes its bound; tasks are finished when they could be, or as told, if later (s).
    """
    done = dict(finished)
    for _ in range(1 + sum(len(tour) for tour in tours.values())):
        timed = {}
        raised: dict[str, float] = {}
        for robot, tour in tours.items():
            clock, visits = 0.0, []
            for visit, leg in zip(tour, legs[robot], strict=True):
                ready = max((done.get(task, 0.0) for task in visit.after), default=0.0)
                visit = replace(visit, not_before=max(visit.not_before, ready))
                clock = max(clock + leg.seconds, visit.not_before) + visit.service
                if visit.task is not None and clock > done.get(visit.task, 0.0) + 1e-9:
                    raised[visit.task] = clock
                visits.append(visit)
            timed[robot] = tuple(visits)
        if not raised:
            return timed, ()
        done |= raised
    return timed, tuple(sorted(raised))


def _finished(tours: Tours, plan: Plan) -> dict[str, float]:
    """Return when the tasks are finished (s), as far as they are."""
    done: dict[str, float] = {}
    for robot, path in plan.trajectories.items():
        for stop in path.stops:
            task = tours[robot][stop.visit].task
            if task is not None:
                done[task] = max(done.get(task, 0.0), to_seconds(stop.leave))
    return done


def _early(tours: Tours, plan: Plan, finished: Mapping[str, float]) -> tuple[str, ...]:
    """Return the tasks that begin before one that they wait for is finished."""
    return tuple(
        str(tours[robot][stop.visit].task)
        for robot, path in plan.trajectories.items()
        for stop in path.stops
        if any(
            to_seconds(stop.arrive) < finished.get(task, 0.0)
            for task in tours[robot][stop.visit].after
        )
    )


def _doing(tours: Tours, tasks: Sequence[str]) -> tuple[str, ...]:
    return tuple(robot for robot, tour in tours.items() if any(v.task in tasks for v in tour))


def _nothing(problem: Problem, reason: str, tasks: Sequence[str]) -> Plan:
    """Return a plan without motion."""
    assignment = {
        robot: tuple(dict.fromkeys(visit.task for visit in tour if visit.task is not None))
        for robot, tour in problem.tours.items()
    }
    return Plan(
        Status.STOPPED,
        {},
        problem.tours,
        assignment,
        reason=reason,
        concerned=_doing(problem.tours, tasks),
        counters={"expansions": 0},
    )
