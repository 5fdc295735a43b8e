"""What is wrong or doubtful about a scenario, before anything is solved."""

from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong or doubtful about a scenario.

    Parameters
    ----------
    kind
        ``start_in_obstacle``, ``start_outside``, ``starts_overlap``, ``visit_in_obstacle``,
        ``visit_outside``, ``zone_in_obstacle``, ``zone_outside``, ``no_room``,
        ``rests_overlap``, ``no_robot``, ``unreachable``, ``few_bays``, ``few_chargers``,
        ``start_off_place``, ``too_late``, ``no_work``, ``covered`` or ``unsupported``.
    key
        Key path in the scenario file.
    robots
        Ids of the robots concerned.
    place
        Where to look (m).
    depth
        How deep bodies overlap or how far they are outside (m).
    text
        A sentence for people, with the mend.
    proof
        Whether it proves that the scenario has no plan.
    """

    kind: str
    severity: Severity
    key: str
    text: str
    robots: tuple[str, ...] = ()
    place: tuple[float, float] | None = None
    depth: float | None = None
    proof: bool = False
