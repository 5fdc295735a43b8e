"""From a scenario to what happens in it: orders that arrive, until they are done."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from importlib.metadata import version

from clearway.coordinate import Coordinator, CoordinatorParams, Lifelong, Unsupported
from clearway.model import Scenario, Trace
from clearway.protocols import Budget, TripPlanner
from clearway.simulation.arrivals import Arrivals
from clearway.simulation.disturbed import PERIOD, Disturbed
from clearway.simulation.events import Event, Record
from clearway.simulation.fleet import SimulatedFleet, Tell
from clearway.simulation.motion import RobotMotion
from clearway.simulation.on_time import OnTime
from clearway.systems.choose import choose_lifelong
from clearway.systems.solve import IllegalScenario
from clearway.validate.finding import Finding
from clearway.validate.legality import check_scenario

Clock = Callable[[], float]
Recorder = Callable[[Trace], Record]
Hold = Callable[[], AbstractContextManager[None]]


def _nowhere(header: Trace) -> Record:
    return lambda event: None


@dataclass(frozen=True)
class Simulated:
    """What has happened, and how it ended.

    ``status`` is ``done``, ``ended`` (its time was up with orders open or to come), ``stuck``
    (orders are open, but nothing happens any more), ``stopped`` (the budget was spent), or
    ``interrupted``.
    """

    trace: Trace
    status: str
    counters: Mapping[str, int] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return self.status in ("done", "ended")


def simulate(
    scenario: Scenario,
    *,
    system: Lifelong | None = None,
    seed: int | None = None,
    budget: Budget | None = None,
    record: Recorder = _nowhere,
    tell: Tell = lambda second, done, left: None,
    warn: Callable[[Finding], None] = lambda finding: None,
    clock: Clock | None = None,
    hold: Hold = nullcontext,
) -> Simulated:
    """Run a scenario through time.

    Parameters
    ----------
    system
        Parts to use; absent: those that the scenario names.
    seed
        Absent: the scenario's own.
    budget
        Seconds of ``clock``, or expansions of the planner, after which it stops.
    record
        Called with the trace's header, events empty, once all parts are made; returns what takes
        each event as it happens.
    tell
        Called with the second, orders done and orders open; it may raise `KeyboardInterrupt`.
    warn
        Called before anything happens with each finding that lets the scenario run, but makes its
        result doubtful.
    clock
        Source of CPU seconds for decisions and the budget; absent: none are told.
    hold
        Makes the context within which events are written and `KeyboardInterrupt` should wait.

    Raises
    ------
    IllegalScenario
        If a start or visit pose cannot be, or no robot can reach a task.
    ValueError
        If the system or a setting is unknown, or a part cannot take a feature.
    """
    legality = check_scenario(scenario)
    if not legality:
        raise IllegalScenario(legality.errors)

    def begin(header: Trace) -> Record:
        for finding in legality.findings:
            warn(finding)
        return record(header)

    return run_through_time(
        scenario,
        system,
        seed=seed,
        budget=budget,
        record=begin,
        tell=tell,
        clock=clock,
        hold=hold,
    )


def unsupported(scenario: Scenario, system: Lifelong) -> tuple[str, ...]:
    """Return what in a scenario cannot be run through time with a system, for people to mend."""
    reasons = system.unsupported(scenario)
    if scenario.simulation.disturbances:
        reasons += tuple(
            f"robot type {name}: has limits on acceleration, which robots that stop at random do "
            "not keep; remove them, or disturbances"
            for name in sorted({robot.type for robot in scenario.robots})
            if scenario.robot_types[name].limits.has_ramps
        )
    return reasons


def run_through_time(
    scenario: Scenario,
    system: Lifelong | None = None,
    *,
    seed: int | None = None,
    budget: Budget | None = None,
    record: Recorder = _nowhere,
    tell: Tell = lambda second, done, left: None,
    clock: Clock | None = None,
    hold: Hold = nullcontext,
) -> Simulated:
    """Run a scenario that is known to be legal; see `simulate`."""
    chosen = system or choose_lifelong(scenario)
    reasons = unsupported(scenario, chosen)
    if reasons:
        raise Unsupported("; ".join(reasons))
    seed = scenario.seed if seed is None else seed
    motion, arrivals = _motion(scenario, chosen, seed), Arrivals(scenario, seed)
    trips = chosen.trips(scenario)
    # Robots that may be late have been granted what they do within a period.
    lead = PERIOD if scenario.simulation.disturbances else 0
    coordinator = Coordinator(
        scenario.robots, chosen.dispatch(scenario), trips, CoordinatorParams(lead=lead), clock
    )
    is_spent = _is_spent(budget or Budget(), clock, trips)
    header = _header(scenario, chosen, seed)
    told: list[Event] = []
    # Only now, as any part may refuse the scenario, and what an earlier run wrote is to stay then.
    write = record(header)

    def keep(event: Event) -> None:
        told.append(event)
        write(event)

    fleet = SimulatedFleet(scenario, motion, arrivals, keep, tell)
    status = None
    try:
        while True:
            with hold():
                seen = fleet.observe()
            if seen is None:
                break
            decision = coordinator.decide(seen)
            with hold():
                fleet.execute(decision)
            if is_spent():
                status = "stopped"
                break
    except KeyboardInterrupt:
        status = "interrupted"
    with hold():
        status = fleet.close(status)
    trace = replace(header, events=tuple(told), is_whole=True)
    return Simulated(trace, status, dict(trips.counters))


def _motion(scenario: Scenario, system: Lifelong, seed: int) -> RobotMotion:
    disturbances = scenario.simulation.disturbances
    if not disturbances:
        return OnTime(scenario.robots)
    return Disturbed(scenario.robots, disturbances, system.execute(scenario), seed)


def _is_spent(budget: Budget, clock: Clock | None, trips: TripPlanner) -> Callable[[], bool]:
    end = None if budget.seconds is None or clock is None else clock() + budget.seconds
    most = budget.expansions

    def is_spent() -> bool:
        if most is not None and trips.counters["expansions"] >= most:
            return True
        return end is not None and clock is not None and clock() > end

    return is_spent


def _header(scenario: Scenario, system: Lifelong, seed: int) -> Trace:
    return Trace(
        scenario=scenario.name,
        system=system.name,
        seed=seed,
        site=scenario.site,
        robot_types=dict(scenario.robot_types),
        robots=scenario.robots,
        events=(),
        is_whole=False,
        parameters=dict(system.parameters),
        version=version("clearway"),
    )
