"""From a study's name to its files."""

import csv
import json
import re

import pytest
from tests.study import rows

from clearway.formats.atomic import FormatError
from clearway.study.conduct import conduct, find_study
from clearway.study.experiment import Scale
from clearway.study.studies import STUDIES
from clearway.study.workers import local

COMMAND = "clearway study squares --out DIR"


def conducted(study, out, **more):
    """Run a study on one process."""
    return conduct(study, Scale(), out, local(1), COMMAND, **more)


def test_a_study_leaves_all_its_files(squares, tmp_path):
    """Rows, CSV, Markdown, pictures and a page that needs nothing else."""
    done = conducted(squares(), tmp_path)
    assert {path.name for path in done.files} == {
        "rows.jsonl",
        "table.csv",
        "table.md",
        "report.html",
        "squares.png",
    }
    assert all(path.stat().st_size for path in done.files)
    with (tmp_path / "table.csv").open() as file:
        assert [row["square"] for row in csv.DictReader(file)] == ["7", "8", "11", "16"]
    assert "| Squares are 0 or more | least: 7 | yes |" in (tmp_path / "table.md").read_text()
    assert (tmp_path / "squares.png").read_bytes().startswith(b"\x89PNG")


def test_the_report_is_one_file(squares, tmp_path):
    """It loads nothing, escapes what it shows, and tells how to run the study again."""
    conducted(squares(), tmp_path)
    page = (tmp_path / "report.html").read_text()
    assert not re.findall(r'(?:src|href|srcset)="(?!data:)', page)
    assert "Squares &lt; cubes &amp; more" in page
    assert COMMAND in page
    assert page.count("data:image/png;base64,") == 2  # on light and on dark ground


def test_a_stopped_study_goes_on_where_it_was(squares, tmp_path):
    """Rows that are there are not made again: the second row function would fail on them."""
    study = squares()
    conducted(study, tmp_path)
    lines = (tmp_path / "rows.jsonl").read_text().splitlines(keepends=True)
    (tmp_path / "rows.jsonl").write_text("".join(lines[:3]) + lines[3][:9])
    told = []
    seen = []
    done = conducted(study, tmp_path, warn=told.append, progress=lambda a, b: seen.append((a, b)))
    assert seen[0] == (2, 4)
    assert [row["x"] for row in done.rows] == [0, 1, 2, 3]
    assert any("cut short" in text for text in told)
    again = (tmp_path / "rows.jsonl").read_text().splitlines(keepends=True)
    assert again[:3] == lines[:3]
    assert len(again) == 5


def test_a_finished_study_makes_no_row(squares, tmp_path):
    """Its files are written anew, the same but for nothing."""
    conducted(squares(), tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    conducted(squares(row=rows.wrong), tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize("other", [{"version": 2}, {"part": "added"}, {"count": 2}])
def test_rows_of_other_settings_are_refused(squares, tmp_path, other):
    """A version, a part or cells that differ."""
    conducted(squares(), tmp_path)
    with pytest.raises(FormatError, match="give another --out, or delete the file"):
        conducted(squares(**other), tmp_path)


def test_failed_rows_are_told_and_tried_again(squares, tmp_path):
    """They are in no figure; a later run mends them."""
    done = conducted(squares(row=rows.deadly), tmp_path)
    assert [row["x"] for row in done.failed] == [2]
    assert "died 3 times" in (tmp_path / "table.md").read_text()
    mended = conducted(squares(), tmp_path)
    assert not mended.failed
    assert len(mended.rows) == 4


def test_rows_come_in_the_order_of_cells(squares, tmp_path):
    """However they were finished."""
    study = squares(6)
    conduct(study, Scale(), tmp_path, local(2), COMMAND)
    with (tmp_path / "table.csv").open() as file:
        assert [row["x"] for row in csv.DictReader(file)] == list("012345")


def test_an_unknown_study_is_told_the_closest():
    """And all that there are."""
    with pytest.raises(ValueError, match=r"did you mean hierarchical-table2\? known: "):
        find_study("hierarchical-tabel2")


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
@pytest.mark.parametrize("quick", [True, False])
def test_cells_are_plain_and_differ(study, quick):
    """Each has a key of its own, and settings that survive JSON."""
    cells = study.cells(Scale(quick=quick))
    assert len({cell.key for cell in cells}) == len(cells) > 0
    assert all(json.loads(json.dumps(cell.settings)) == cell.settings for cell in cells)


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_a_study_without_complete_rows_says_so(study):
    """No figure is made up; the claims are not told."""
    assert all(finding.holds is None for finding in study.summarise([]).findings)
