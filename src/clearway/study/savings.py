"""A claimed saving beside the one that came out."""

from collections.abc import Sequence

from clearway.study.findings import Finding
from clearway.study.statistics import saving


def saving_finding(
    claim: str, claimed: float, ours: Sequence[float], theirs: Sequence[float]
) -> Finding:
    """Return whether the claimed saving (per cent) lies in the interval of the one measured."""
    if len(ours) < 2:
        return Finding(claim, "fewer than two pairs of complete plans", None)
    measured = saving(ours, theirs)
    holds = measured.low <= claimed <= measured.high
    if holds:
        told = "the claim lies in the interval"
    elif not measured.excludes_zero:
        told = "no difference to be seen"
    elif measured.low > 0.0:
        told = (
            f"so the direction holds, the size is {'less' if measured.value < claimed else 'more'}"
        )
    else:
        told = "the other way round"
    return Finding(claim, f"{measured} % over {measured.count} pairs: {told}", holds)
