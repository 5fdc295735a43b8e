"""What the judge finds."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Violation:
    """One promise of a plan that is broken, at its worst moment.

    Parameters
    ----------
    kind
        One of ``KINDS``, or ``TRACE_KINDS`` where a trace is judged.
    robots
        Ids of the robots concerned; empty where it is about the whole plan.
    time
        Moment (s) at which it is worst.
    place
        Where (m) it is then.
    depth
        How deep bodies overlap (m); ``None`` where it is not about bodies.
    text
        A sentence with the figures.
    """

    kind: str
    robots: tuple[str, ...]
    time: float
    place: tuple[float, float]
    depth: float | None
    text: str

    def __str__(self) -> str:
        """Return kind, robots, time and place, then the sentence."""
        who = f" {' and '.join(self.robots)}" if self.robots else ""
        x, y = self.place
        return f"{self.kind}{who} at {self.time:.3f} s, ({x:.3f}, {y:.3f}): {self.text}"


KINDS = (
    "robot",  # a track whose robot is not in the plan
    "clock",  # time does not start at 0, falls, or is not a number
    "step",  # a step of more than 0.1 s while moving
    "turn",  # a step that turns by pi or more
    "jump",  # two poses at one time
    "start",
    "speed",
    "reverse_speed",
    "yaw_rate",
    "turning_radius",
    "acceleration",
    "deceleration",
    "slip",
    "mode",  # a mode that the type lacks, or a step that is not what its mode says
    "obstacle",
    "bounds",
    "zone",  # a closed zone entered
    "conflict",  # body against body
    "visit",
    "service",
    "together",
    "not_before",  # a visit made too early
    "after",  # a visit made before a task that it waits for is finished
    "status",
    "assignment",
    "sum_of_costs",
    "makespan",
    "lower_bound",
    "cost",
    "cost_lower_bound",
)

# What only a trace can have wrong.
TRACE_KINDS = (
    "gap",  # pieces of one robot's motion that do not join
    "order",  # states out of turn, visits of others, done before its visits are made
    "load",  # more on board than fits, or one object on two robots
    "energy",  # a level outside [0, 1]
    "wait",  # a wait that names nobody and nothing
    "end",  # closing figures that are not those of the trace
)
