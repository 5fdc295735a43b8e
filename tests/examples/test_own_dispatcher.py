"""The example of a dispatcher of one's own runs as it stands."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "02_own_dispatcher.py"


def test_three_dispatchers_are_compared():
    """Looking ahead drives least of its way empty; nobody hits anybody."""
    scenario = ROOT / "scenarios" / "bidirectional.toml"
    told = subprocess.run(
        [sys.executable, str(EXAMPLE), str(scenario)], capture_output=True, text=True, check=True
    )
    lines = [line.split() for line in told.stdout.splitlines()[1:]]
    assert [line[0] for line in lines] == ["NearestIdle", "RestedFirst", "LookAhead"]
    nearest, _, ahead = (float(line[3]) for line in lines)
    assert ahead < nearest
    assert [line[-1] for line in lines] == ["0", "0", "0"]
