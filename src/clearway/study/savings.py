"""A claimed saving beside the one that came out."""

from collections.abc import Sequence

from clearway.study.findings import Finding
from clearway.study.statistics import Estimate, saving


def saving_finding(
    claim: str, claimed: float, ours: Sequence[float], theirs: Sequence[float]
) -> Finding:
    """Return whether the claimed saving (per cent) lies in the interval of the one measured.

    Where the interval holds no saving at all as well, the rows do not tell.
    """
    if len(ours) < 2:
        return Finding(claim, "fewer than two pairs of complete plans", None)
    measured = saving(ours, theirs)
    told, holds = _compared(measured, claimed)
    return Finding(claim, f"{measured} % over {measured.count} pairs: {told}", holds)


def _compared(measured: Estimate, claimed: float) -> tuple[str, bool | None]:
    if measured.low <= claimed <= measured.high:
        if measured.excludes_zero:
            return "the claim lies in the interval", True
        return "neither the claim nor no saving at all is excluded", None
    if not measured.excludes_zero:
        return "no difference to be seen", False
    if measured.high < 0.0:
        return "the other way round", False
    return f"the direction holds, with {'less' if measured.value < claimed else 'more'}", False
