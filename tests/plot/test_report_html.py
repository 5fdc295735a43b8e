"""The report's file: whole, small, alone, and the same each time."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from clearway.metrics import plan_metrics
from clearway.model import PlanRecord, Status, Track
from clearway.plot.payload import as_script, carrying, payload
from clearway.plot.report import render, write_report


def page_of(record: PlanRecord, violations: int = 0) -> str:
    return render(record, plan_metrics(record, [], violations))


def test_nothing_is_loaded_from_anywhere(warehouse_record: PlanRecord) -> None:
    """Neither a link nor a source in the page names another file or host."""
    page = page_of(warehouse_record)
    assert re.findall(r'(?:src|href)="(?!#|data:)', page) == []
    assert re.findall(r"https?://(?!www\.w3\.org/2000/svg)", page) == []
    assert "default-src 'none'" in page


def test_timings_do_not_change_the_page(warehouse_record: PlanRecord) -> None:
    """The same plan found more slowly has the same report, byte for byte."""
    slower = replace(warehouse_record, timings={"wall_s": 99.0})
    assert page_of(slower) == page_of(warehouse_record)


def test_sixteen_robots_for_five_minutes_stay_below_two_megabytes(
    warehouse_record: PlanRecord,
) -> None:
    """3000 samples a robot, all of them on a slalom, still make a page that opens at once."""
    t = np.arange(0.0, 300.0, 0.1)
    heading = 0.6 * np.sin(t / 3.0)
    x, y = np.cumsum(0.15 * np.cos(heading)), np.cumsum(0.15 * np.sin(heading))
    slalom = Track(t, x, y, heading, ("forward",) * len(t))
    robots = tuple(replace(warehouse_record.robots[0], id=f"R{k}") for k in range(16))
    record = replace(
        warehouse_record,
        robots=robots,
        tracks={r.id: slalom for r in robots},
        tours={},
        paths={},
    )
    assert len(page_of(record).encode()) < 2_000_000


def test_strings_cannot_end_the_script() -> None:
    """What stands in a script element holds no sign that HTML would read."""
    text = as_script({"</script><b>": "\u2028&"})
    assert not set(text) & set("<>&\u2028")
    assert json.loads(text) == {"</script><b>": "\u2028&"}


def test_a_load_is_aboard_from_the_end_of_pick_to_the_end_of_drop(
    warehouse_record: PlanRecord,
) -> None:
    """R1 starts at 0 s, drives 14 m at 1.5 m/s (9.334 s) and picks for 8 s: aboard at 17.334 s."""
    robot = payload(warehouse_record, plan_metrics(warehouse_record, [], 0))["robots"][0]
    (span,) = robot["carrying"]
    stops = warehouse_record.paths["R1"].stops
    assert span == [17334, stops[1].leave]
    assert carrying((), ()) == []


def test_an_unfinished_plan_says_why_and_who(warehouse_record: PlanRecord) -> None:
    """The banner holds the reason and the robots whose visits are open."""
    record = replace(
        warehouse_record,
        status=Status.INFEASIBLE,
        reason="R2 cannot leave its aisle",
        tracks={k: v for k, v in warehouse_record.tracks.items() if k != "R2"},
        paths={},
    )
    page = page_of(record)
    assert "There is no plan that does all of this" in page
    assert "R2 cannot leave its aisle" in page
    assert "Visits left open: R2." in page
    right = page_of(warehouse_record)
    assert 'role="alert"' in page and 'role="alert"' not in right


def test_violations_are_shouted(warehouse_record: PlanRecord) -> None:
    """A plan that the judge condemned says so above everything else."""
    assert "The judge found 3 violations: do not drive this plan" in page_of(warehouse_record, 3)


def test_the_file_is_whole_and_alone(warehouse_record: PlanRecord, tmp_path: Path) -> None:
    """Nothing but the report is left in the folder, and a missing folder is an error."""
    metrics = plan_metrics(warehouse_record, [], 0)
    write_report(warehouse_record, metrics, tmp_path / "report.html")
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]
    with pytest.raises(FileNotFoundError):
        write_report(warehouse_record, metrics, tmp_path / "nowhere" / "report.html")
