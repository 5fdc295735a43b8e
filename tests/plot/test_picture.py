"""Still pictures of plans and sites."""

import struct
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

from clearway.model import Footprint, PlanRecord, RobotType, Task, Visit
from clearway.plot.picture import draw_plan, draw_site


def size_of(file: Path) -> tuple[int, int]:
    """Return width and height from the PNG header."""
    width, height = struct.unpack(">II", file.read_bytes()[16:24])
    return width, height


def test_the_same_plan_gives_the_same_bytes(warehouse_record: PlanRecord, tmp_path: Path) -> None:
    """No date and no chance in the picture; it is 1600 pixels wide."""
    for name in ("a.png", "b.png"):
        draw_plan(warehouse_record, tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert b"matplotlib" not in (tmp_path / "a.png").read_bytes().lower()
    assert size_of(tmp_path / "a.png")[0] == 1600


def test_each_mark_is_seen(warehouse_record: PlanRecord, tmp_path: Path) -> None:
    """A place to look at changes the picture of the site."""
    tasks = [Task("T", (Visit("T", warehouse_record.robots[0].start, 1.0),))]
    kinds, robots = warehouse_record.robot_types, warehouse_record.robots
    site = warehouse_record.site
    draw_site(site, kinds, robots, tasks, tmp_path / "plain.png")
    draw_site(site, kinds, robots, tasks, tmp_path / "marked.png", [(50.0, 30.0, "1")])
    assert (tmp_path / "plain.png").read_bytes() != (tmp_path / "marked.png").read_bytes()


def test_discs_and_dollar_signs_can_be_drawn(warehouse_record: PlanRecord, tmp_path: Path) -> None:
    """Round robots and names that look like formulas are nothing special."""
    disc = Footprint(radius=0.8)
    kinds: dict[str, RobotType] = {
        name: replace(kind, footprint=disc, loaded_footprint=None)
        for name, kind in warehouse_record.robot_types.items()
    }
    record = replace(warehouse_record, robot_types=kinds, scenario="costs $5 and $x_{", tracks={})
    draw_plan(record, tmp_path / "disc.png")
    assert size_of(tmp_path / "disc.png")[0] == 1600


def test_the_report_needs_no_matplotlib() -> None:
    """Importing the package, or the report, leaves matplotlib alone."""
    script = "import sys, clearway.plot, clearway.plot.report; print('matplotlib' in sys.modules)"
    found = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert found.stdout.strip() == "False"
