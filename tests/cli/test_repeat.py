"""The same build, scenario, seed and effort give the same bytes; the processes do not matter."""

import json
import os
import subprocess
import sys

import pytest
from tests.cli.sites import HALL, endless_corridor

from clearway.formats.scenario_file import dump_scenario
from clearway.world.warehouse import random_warehouse

SCENARIOS = {
    "hall": (HALL, 100_000),
    "warehouse": (dump_scenario(random_warehouse(6, 12, 3)), 100_000),
    "stopped": (endless_corridor(), 3_000),
}


def solve(folder, name, seed, hashing):
    """Run one solve in a process of its own; return the bytes of each file."""
    out = folder / f"run-{hashing}"
    done = subprocess.run(
        [
            *(sys.executable, "-m", "clearway", "solve", f"{name}.toml", "--out", out.name),
            *("--seed", str(seed), "--expansions", str(SCENARIOS[name][1]), "--quiet"),
        ],
        cwd=folder,
        env={**os.environ, "PYTHONHASHSEED": str(hashing)},
        capture_output=True,
        timeout=120,
        check=False,
    )
    assert done.returncode in (0, 3), done.stderr
    return {path.name: path.read_bytes() for path in sorted(out.iterdir())}


@pytest.mark.parametrize("name", SCENARIOS)
def test_the_same_seed_gives_the_same_bytes(tmp_path, name):
    """All files are equal; in plan.json, all but ``timings``."""
    (tmp_path / f"{name}.toml").write_text(SCENARIOS[name][0])
    one, other = (solve(tmp_path, name, 4, hashing) for hashing in (1, 2))
    assert set(one) == {"plan.json", "metrics.json", "report.html", "plan.png", "scenario.toml"}
    assert set(one) == set(other)
    plans = [json.loads(files.pop("plan.json")) for files in (one, other)]
    assert one == other
    timings = [plan.pop("timings") for plan in plans]
    assert set(timings[0]) == set(timings[1])
    # Text and not only values, so that the order of keys is compared too.
    assert json.dumps(plans[0]) == json.dumps(plans[1])


def test_another_seed_is_told(tmp_path):
    """The file says by which seed it was made."""
    (tmp_path / "hall.toml").write_text(HALL)
    files = solve(tmp_path, "hall", 9, 0)
    assert json.loads(files["plan.json"])["seed"] == 9
