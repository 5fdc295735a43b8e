"""What a trace file holds: the header, and what happened, event by event."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from clearway.model.robot import Robot, RobotType
from clearway.model.site import Site


@dataclass(frozen=True)
class Trace:
    """The content of ``trace.jsonl`` (format ``clearway.trace/1``).

    Parameters
    ----------
    events
        As in the file, in order, the header left out: each a mapping with ``event`` and ``t``
        (s; of a ``motion`` the array of its samples' times).
    is_whole
        Whether the closing ``end`` event is there; else the run was cut short.
    """

    scenario: str
    system: str
    seed: int
    site: Site
    robot_types: Mapping[str, RobotType]
    robots: tuple[Robot, ...]
    events: tuple[Mapping[str, Any], ...]
    is_whole: bool
    parameters: Mapping[str, Any]
    version: str = ""

    def of(self, kind: str) -> tuple[Mapping[str, Any], ...]:
        """Return the events of one kind."""
        return tuple(event for event in self.events if event["event"] == kind)
