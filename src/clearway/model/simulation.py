"""What happens while a scenario runs: orders that arrive, disturbances, surprises."""

import math
from dataclasses import dataclass, field

from clearway.model.site import Obstacle
from clearway.model.task import Load


@dataclass(frozen=True)
class Draw:
    """A visit of an order that arrives: at the pose of a zone of kind ``kind``, drawn evenly."""

    kind: str
    service: float = 0.0
    load: Load | None = None


@dataclass(frozen=True)
class OrderStream:
    """Orders that arrive at random.

    Parameters
    ----------
    rate
        Orders per hour of a Poisson process; ``None`` where ``open`` is given.
    open
        Orders that are open at all times: one that is taken up is followed by a new one at once.
    draws
        Visits of each order, in order; empty where ``fetch`` is set.
    fetch
        Each order fetches a shelf, drawn evenly from all that no open order fetches.
    first, last
        Seconds between which orders arrive; ``last`` ``None``: to the end.
    due_after
        Seconds after its release by which an order is due; ``None``: never.
    """

    name: str
    rate: float | None = None
    open: int | None = None
    draws: tuple[Draw, ...] = ()
    fetch: bool = False
    first: float = 0.0
    last: float | None = None
    due_after: float | None = None
    priority: float = 0.0

    def __post_init__(self) -> None:
        if (self.rate is None) == (self.open is None):
            raise ValueError(f"stream {self.name}: give either rate (per hour) or open")
        if self.rate is not None and not (math.isfinite(self.rate) and self.rate > 0.0):
            raise ValueError(f"stream {self.name}: rate must be above 0, got {self.rate}")
        if self.open is not None and self.open < 1:
            raise ValueError(f"stream {self.name}: open must be 1 or more, got {self.open}")
        if bool(self.draws) == self.fetch:
            raise ValueError(f"stream {self.name}: give either visits or fetch")


@dataclass(frozen=True)
class Disturbances:
    """Seeded disturbances of the robots' motion.

    Parameters
    ----------
    stops_per_hour
        Random stops of each moving robot, a Poisson process in its moving time.
    stop_seconds
        Shortest and longest stop (s), drawn evenly.
    slow
        Share of robots, in [0, 1], that drive slower than planned.
    slowness
        Their speed as a part of the planned one, in (0, 1].
    """

    stops_per_hour: float = 0.0
    stop_seconds: tuple[float, float] = (2.0, 30.0)
    slow: float = 0.0
    slowness: float = 0.7

    def __post_init__(self) -> None:
        if not (math.isfinite(self.stops_per_hour) and self.stops_per_hour >= 0.0):
            raise ValueError(f"stops_per_hour must be 0 or above, got {self.stops_per_hour}")
        low, high = self.stop_seconds
        if not 0.0 <= low <= high < math.inf:
            raise ValueError(f"stop_seconds must be a shortest and a longest, got {low}, {high}")
        if not 0.0 <= self.slow <= 1.0:
            raise ValueError(f"slow must be in [0, 1], got {self.slow}")
        if not 0.0 < self.slowness <= 1.0:
            raise ValueError(f"slowness must be in (0, 1], got {self.slowness}")

    def __bool__(self) -> bool:
        """Whether anything is disturbed."""
        return self.stops_per_hour > 0.0 or (self.slow > 0.0 and self.slowness < 1.0)


@dataclass(frozen=True)
class Surprise:
    """An obstacle that nobody knows of before second ``at``."""

    at: float
    obstacle: Obstacle


@dataclass(frozen=True)
class Simulation:
    """How a scenario runs through time.

    Parameters
    ----------
    until
        Second at which the run ends, whatever is open; ``None``: when all orders are done.
    """

    until: float | None = None
    streams: tuple[OrderStream, ...] = ()
    disturbances: Disturbances = field(default_factory=Disturbances)
    surprises: tuple[Surprise, ...] = ()

    def __post_init__(self) -> None:
        if self.until is not None and not (math.isfinite(self.until) and self.until > 0.0):
            raise ValueError(f"until must be above 0 and finite, got {self.until}")
        endless = [s.name for s in self.streams if s.last is None]
        if endless and self.until is None:
            raise ValueError(f"stream {endless[0]} never ends: give until, or the stream's last")
