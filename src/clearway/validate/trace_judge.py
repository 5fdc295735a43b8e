"""The judge of traces: all that the trace format promises, checked in continuous time."""

from clearway.model import Trace, Track, tracks_of
from clearway.validate.acceleration import judge_acceleration
from clearway.validate.clocks import judge_samples
from clearway.validate.displacement import displacement_of
from clearway.validate.judge import BORDER, OVERLAP
from clearway.validate.kinematics import judge_kinematics
from clearway.validate.modes import judge_modes
from clearway.validate.pairs import Mover, judge_pairs
from clearway.validate.statics import Surroundings, margin_around
from clearway.validate.steps import Steps
from clearway.validate.trace_figures import judge_end
from clearway.validate.trace_motion import judge_pieces
from clearway.validate.trace_orders import judge_orders, judge_tellings
from clearway.validate.trace_visits import judge_stays
from clearway.validate.trace_zones import judge_closures
from clearway.validate.violation import Violation


def validate_trace(
    trace: Trace, *, overlap: float = OVERLAP, border: float = BORDER
) -> list[Violation]:
    """Return everything that is wrong with a trace, by time; an empty list if it is right.

    What was driven is judged as `validate_plan` judges a plan, over the whole trace. A trace
    that was cut short is judged up to where it breaks off; robots stand from their last
    sample on. Where pieces of motion do not join nothing else is judged.

    Parameters
    ----------
    overlap
        Depth (m) up to which bodies may be in each other or in obstacles.
    border
        How far (m) a body may leave the bounds.
    """
    found = _clock(trace) + judge_pieces(trace)
    if found:
        return sorted(found, key=lambda violation: violation.time)
    tracks = tracks_of(trace)
    end = _end(trace, tracks)
    steps = {
        name: Steps.from_track(track, end + 1.0, loads)
        for (name, track), loads in zip(tracks.items(), _loads(trace), strict=True)
    }
    for robot in trace.robots:
        kind, track = trace.robot_types[robot.type], tracks[robot.id]
        motion = displacement_of(track)
        found += judge_samples(robot, kind, track)
        found += judge_kinematics(robot, kind, track, motion)
        found += judge_modes(robot, kind, track, motion)
        found += judge_acceleration(robot, kind, track, motion)
    margin = margin_around(trace.site, trace.robot_types.values(), steps.values())
    surroundings = Surroundings(trace.site, overlap, border, margin)
    for robot in trace.robots:
        found += surroundings.judge(robot, trace.robot_types[robot.type], steps[robot.id])
    movers = [Mover.of(r, trace.robot_types[r.type], steps[r.id]) for r in trace.robots]
    found += judge_pairs(movers, end + 1.0, overlap)
    found += judge_closures(trace, steps, end + 1.0, overlap)
    found += judge_stays(trace, tracks, end)
    found += judge_orders(trace) + judge_tellings(trace) + judge_end(trace, tracks)
    return sorted(found, key=lambda violation: violation.time)


def _clock(trace: Trace) -> list[Violation]:
    found, last = [], 0.0
    for event in trace.events:
        if event["event"] == "motion":
            continue
        t = float(event["t"])
        if t < last:
            text = f"time falls from {last:.6f} s to {t:.6f} s at an event {event['event']}"
            found.append(Violation("clock", (), t, (0.0, 0.0), None, text))
        last = max(last, t)
    return found


def _end(trace: Trace, tracks: dict[str, Track]) -> float:
    told = [float(event["t"]) for event in trace.events if event["event"] != "motion"]
    return max([0.0, *told, *(float(track.t[-1]) for track in tracks.values())])


def _loads(trace: Trace) -> list[tuple[tuple[float, bool], ...]]:
    """Return for each robot when (s) it becomes loaded or empty."""
    changes: dict[str, list[tuple[float, bool]]] = {robot.id: [] for robot in trace.robots}
    for event in trace.of("load"):
        changes[event["robot"]].append((float(event["t"]), bool(event["objects"])))
    return [tuple(each) for each in changes.values()]
