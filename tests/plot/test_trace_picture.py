"""The still picture of a run."""

from pathlib import Path

import numpy as np
import pytest
from tests.plot.made_run import made_run

from clearway.model import Site, Track
from clearway.plot.trace_picture import draw_trace, passages

HALL = Site(((0.0, 0.0), (22.0, 0.0), (22.0, 11.0), (0.0, 11.0)))


def straight(x0: float, x1: float, y: float, samples: int) -> Track:
    x = np.linspace(x0, x1, samples)
    return Track(np.arange(float(samples)), x, np.full(samples, y), 0 * x, (None,) * samples)


@pytest.mark.parametrize("samples", [2, 7, 500])
def test_each_drive_passes_a_cell_once(samples: int) -> None:
    """Cells of 0.1 m; two drives along y = 5.05 pass each cell between twice, however sampled."""
    tracks = [straight(1.0, 21.0, 5.05, samples), straight(21.0, 1.0, 5.05, samples)]
    counts, side = passages(HALL, tracks)
    assert side == pytest.approx(0.1)
    assert counts.shape == (110, 220)
    assert counts[50, 15:205] == pytest.approx(2.0, abs=0.51)
    assert counts.sum() == pytest.approx(400.0)
    assert counts[:50].sum() == counts[51:].sum() == 0.0


def test_who_stands_passes_nothing() -> None:
    """A track of one sample, and no track at all."""
    assert passages(HALL, [straight(1.0, 1.0, 5.0, 1)])[0].sum() == 0.0
    assert passages(HALL, [])[0].sum() == 0.0


def test_the_same_trace_gives_the_same_bytes(tmp_path: Path) -> None:
    """No date and no chance in the picture, and traffic is seen."""
    trace = made_run(robots=3, seconds=150.0)
    for name in ("a.png", "b.png"):
        draw_trace(trace, tmp_path / name)
    drawn = (tmp_path / "a.png").read_bytes()
    assert drawn == (tmp_path / "b.png").read_bytes()
    still = made_run(robots=3, seconds=0.5)
    draw_trace(still, tmp_path / "still.png")
    assert drawn != (tmp_path / "still.png").read_bytes()
