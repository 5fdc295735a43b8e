"""The example runs as it stands and is as short as promised."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "01_compare_assigners.py"


def test_three_assigners_are_compared_in_under_30_lines():
    """One line each, all plans clean, and the tuned ones better than chance."""
    assert len(EXAMPLE.read_text().splitlines()) < 30
    scenario = ROOT / "scenarios" / "warehouse-8x24.toml"
    told = subprocess.run(
        [sys.executable, str(EXAMPLE), str(scenario)], capture_output=True, text=True, check=True
    )
    lines = [line.split() for line in told.stdout.splitlines()[1:]]
    assert [line[0] for line in lines] == ["RandomAssigner", "Apsga", "AutomaticAssigner"]
    chance, theirs, ours = (float(line[1]) for line in lines)
    assert ours < theirs < chance
    assert [line[-1] for line in lines] == ["0", "0", "0"]
