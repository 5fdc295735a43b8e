"""Whether robots are where their visits say, and when."""

from dataclasses import dataclass, field

import numpy as np

from clearway.model import PlanRecord, Pose, Robot, Visit
from clearway.validate.steps import REST_STEP, Floats, Steps, wrapped
from clearway.validate.violation import Violation

POSITION = 0.01
HEADING = float(np.radians(1.0))
# Times are whole milliseconds in our files, and may be stored to 1e-6 s elsewhere.
TIME = 1e-3

Window = tuple[float, float]


@dataclass
class Service:
    """A visit in time: from ``begin`` to ``end`` (s), ``None`` where it is not made.

    ``windows`` are the times throughout which the robot is at the pose.
    """

    visit: Visit
    windows: list[Window]
    not_before: float = 0.0
    begin: float | None = None
    end: float | None = None
    window: Window = field(default=(0.0, 0.0))


Schedule = dict[str, list[Service]]


def schedule_of(record: PlanRecord, steps: dict[str, Steps]) -> Schedule:
    """Return when each visit is made, each as early as its order and those it waits for allow.

    A visit begins when the robot comes to rest at its pose, or passes it where its service
    is 0, and lasts for its service.
    """
    schedule: Schedule = {}
    for robot in record.robots:
        motion = steps[robot.id]
        schedule[robot.id] = [
            Service(visit, windows_at(motion, visit.pose), visit.not_before)
            for visit in record.tours.get(robot.id, ())
        ]
    rests = {name: _rests(motion) for name, motion in steps.items()}
    # Each round settles at least the earliest of the groups that are not settled yet, unless
    # two groups wait for each other.
    for _ in range(1 + sum(len(services) for services in schedule.values())):
        for name, services in schedule.items():
            _place(services, rests[name])
        waiting = _wait_for_partners(schedule)
        if record.status:  # else what is waited for may not be planned
            waiting += _wait_for_tasks(schedule)
        if not waiting:
            break
    for service in waiting:
        service.begin = service.end = None
    return schedule


def windows_at(steps: Steps, pose: Pose) -> list[Window]:
    """Return the times (s) throughout which the robot is within 1 cm and 1 degree of ``pose``.

    The last one is without end where the robot rests there.
    """
    offset = steps.pose[:, :2] - np.array([pose.x, pose.y])
    change = steps.change[:, :2]
    # |offset + s change| <= POSITION, an interval of s between the roots of a parabola.
    a = (change**2).sum(axis=1)
    b = (offset * change).sum(axis=1)
    c = (offset**2).sum(axis=1) - (POSITION + 1e-9) ** 2
    still = a < 1e-24
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    safe = np.where(still, 1.0, a)
    low = np.where(still, 0.0, (-b - root) / safe)
    high = np.where(still, 1.0, (-b + root) / safe)
    missed = np.where(still, c > 0.0, b * b < a * c)
    error, turn = wrapped(steps.pose[:, 2] - pose.theta), steps.change[:, 2]
    fixed = np.abs(turn) < 1e-12
    divisor = np.where(fixed, 1.0, turn)
    ends = np.stack([(-HEADING - 1e-9 - error) / divisor, (HEADING + 1e-9 - error) / divisor])
    missed |= fixed & (np.abs(error) > HEADING + 1e-9)
    low = np.maximum.reduce([low, np.where(fixed, 0.0, ends.min(axis=0)), np.zeros(len(low))])
    high = np.minimum.reduce([high, np.where(fixed, 1.0, ends.max(axis=0)), np.ones(len(high))])
    there = ~missed & (low <= high)
    windows: list[Window] = []
    duration = steps.t1 - steps.t0
    for i in np.flatnonzero(there):
        begin = float(steps.t0[i] + low[i] * duration[i])
        end = float(steps.t0[i] + high[i] * duration[i])
        if i == len(there) - 1:
            end = np.inf
        if windows and begin <= windows[-1][1] + 1e-9:
            windows[-1] = (windows[-1][0], end)
        else:
            windows.append((begin, end))
    return windows


def _rests(steps: Steps) -> Floats:
    """Return begin and end (s) of each rest, shape ``(num_rests, 2)``."""
    rest = np.abs(steps.change).max(axis=1) < REST_STEP
    edges = np.flatnonzero(np.diff(rest.astype(np.int8), prepend=0, append=0)).reshape(-1, 2)
    return np.column_stack([steps.t0[edges[:, 0]], steps.t1[edges[:, 1] - 1]])


def _place(services: list[Service], rests: Floats) -> None:
    done = 0.0
    for service in services:
        service.begin = service.end = None
        duration = service.visit.service
        for window in service.windows:
            begin = max(window[0], done, service.not_before)
            if begin == np.inf or window[1] - begin < duration - TIME or window[1] < begin - 1e-9:
                continue
            service.window = window
            service.begin = _at_rest(begin, window, duration, rests)
            service.end = service.begin + duration
            done = service.end
            break


def _at_rest(begin: float, window: Window, duration: float, rests: Floats) -> float:
    """Return when the robot stands still in the window from ``begin`` on; else ``begin``."""
    if duration > 0.0:
        for start in rests[rests[:, 1] > begin, 0]:
            moment = max(begin, float(start))
            if moment > window[1]:
                break
            if window[1] - moment >= duration - TIME:
                return moment
    return begin


def _wait_for_partners(schedule: Schedule) -> list[Service]:
    """Set visits that are made together to begin together; return those that have to wait."""
    waiting = []
    for name, services in schedule.items():
        for k, service in enumerate(services):
            group = [service, *_partners(schedule, name, k)]
            begins = [member.begin for member in group if member.begin is not None]
            if not service.visit.together or len(begins) < len(group):
                continue
            for member, begin in zip(group, begins, strict=True):
                if begin < max(begins) - 1e-9:
                    member.not_before = max(begins)
                    waiting.append(member)
    return waiting


def _wait_for_tasks(schedule: Schedule) -> list[Service]:
    """Set visits to begin after the tasks they wait for; return those that have to wait."""
    done = _finished(schedule)
    waiting = []
    for services in schedule.values():
        for service in services:
            if service.begin is None:
                continue
            ready = max((done.get(task, np.inf) for task in service.visit.after), default=0.0)
            if service.begin < ready - TIME:
                service.not_before = ready
                waiting.append(service)
    return waiting


def _finished(schedule: Schedule) -> dict[str, float]:
    """Return when (s) each task is finished; infinite where a visit of it is not made."""
    done: dict[str, float] = {}
    for services in schedule.values():
        for service in services:
            if service.visit.task is not None:
                end = np.inf if service.end is None else service.end
                done[service.visit.task] = max(done.get(service.visit.task, 0.0), end)
    return done


def _partners(schedule: Schedule, name: str, k: int) -> list[Service]:
    """Return the partners' services that belong to the k-th visit of ``name``.

    The n-th visit that names a partner belongs to the partner's n-th visit that names this
    robot; where the partner names nobody, to its n-th visit of the same task.
    """
    visits = [service.visit for service in schedule[name]]
    found = []
    for other in visits[k].together:
        count = sum(other in visit.together for visit in visits[:k])
        theirs = [s for s in schedule[other] if name in s.visit.together]
        if not theirs:
            theirs = [s for s in schedule[other] if s.visit.task == visits[k].task]
            count = sum(
                other in visit.together and visit.task == visits[k].task for visit in visits[:k]
            )
        found += theirs[count : count + 1]
    return found


def loads_of(services: list[Service]) -> tuple[tuple[float, bool], ...]:
    """Return when (s) a robot becomes loaded (``True``) or empty, in order."""
    aboard, changes = 0, []
    for service in services:
        if service.end is None or service.visit.load is None:
            continue
        aboard = aboard + 1 if service.visit.load == "pick" else max(aboard - 1, 0)
        changes.append((service.end, aboard > 0))
    return tuple(changes)


def judge_visits(record: PlanRecord, schedule: Schedule) -> list[Violation]:
    """Return visits that are not made, too short, too early, or not made together."""
    return [
        violation
        for robot in record.robots
        for k in range(len(schedule[robot.id]))
        for violation in _visit(robot, schedule, k)
    ]


def _visit(robot: Robot, schedule: Schedule, k: int) -> list[Violation]:
    service = schedule[robot.id][k]
    visit = service.visit
    place = (visit.pose.x, visit.pose.y)
    what = f"visit {k} (task {visit.task})"
    partners = _partners(schedule, robot.id, k)
    if len(partners) < len(visit.together):
        text = f"{what} is to be made with {', '.join(visit.together)}, who have no such visit"
        return [Violation("together", (robot.id, *visit.together), 0.0, place, None, text)]
    if service.begin is not None:
        return []
    ends = [s.end for s in schedule[robot.id][:k] if s.end is not None]
    done = max(ends, default=0.0)
    later = [(max(w[0], done), w[1]) for w in service.windows if w[1] > done]
    if not later:
        early = ", only before the visits that precede it" if service.windows else ""
        text = f"{what} is not made: never within 1 cm and 1 degree of its pose{early}"
        return [Violation("visit", (robot.id,), done, place, None, text)]
    longest = max(later, key=lambda w: w[1] - w[0])
    if longest[1] - longest[0] < visit.service - TIME:
        text = f"{what} lasts {longest[1] - longest[0]:.3f} s instead of {visit.service:.3f} s"
        return [Violation("service", (robot.id,), longest[0], place, None, text)]
    if not _fits(service, visit.not_before):
        text = f"{what} is not made from {visit.not_before:.3f} s on, only before"
        return [Violation("not_before", (robot.id,), longest[0], place, None, text)]
    done_at = _finished(schedule)
    for task in visit.after:
        ready = done_at.get(task, np.inf)
        if not _fits(service, ready):
            when = f"is finished at {ready:.3f} s" if ready < np.inf else "is never finished"
            text = f"{what} is not made after task {task}, which {when}"
            return [Violation("after", (robot.id,), longest[0], place, None, text)]
    if not visit.together:
        text = f"{what} waits for tasks that wait for it"
        return [Violation("after", (robot.id,), longest[0], place, None, text)]
    names = (robot.id, *visit.together)
    text = f"{what}: {', '.join(names)} do not stand at their poses at one time"
    return [Violation("together", names, longest[0], place, None, text)]


def _fits(service: Service, ready: float) -> bool:
    """Whether the robot is at the pose for the whole service at some time from ``ready`` on."""
    return ready < np.inf and any(
        end - max(begin, ready) >= service.visit.service - TIME for begin, end in service.windows
    )
