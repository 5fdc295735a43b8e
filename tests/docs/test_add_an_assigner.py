"""The page on adding an assigner."""

import pytest
from tests.docs.run_page import DOCS, run_page

from clearway.protocols import check_routes


def test_the_page_runs_and_its_assigner_is_legal():
    """All blocks run in order, and what the page builds does every task once."""
    page = run_page("how-to/add-an-assigner.md")
    check_routes(page["problem"], page["NearestRobot"]()(page["problem"], 3))


def test_the_page_names_files_that_exist():
    """The exam and the proven optima are where the page says."""
    text = (DOCS / "how-to" / "add-an-assigner.md").read_text(encoding="utf-8")
    for name in (
        "tests/contracts/test_assigners.py",
        "tests/data/oracles/assignment.json",
        "tests/assign/test_insertion.py",
    ):
        assert name in text
        assert (DOCS.parent / name).is_file()


def test_a_page_without_python_is_refused(tmp_path):
    """A page that is thought to be run, but holds nothing to run, is an error."""
    page = tmp_path / "empty.md"
    page.write_text("no code")
    with pytest.raises(ValueError, match="no python block"):
        run_page(str(page))


def test_errors_point_at_the_line_of_the_page(tmp_path):
    """The fourth line of the page is the one that fails."""
    page = tmp_path / "wrong.md"
    page.write_text("# Wrong\n\n```python\n1 / 0\n```\n")
    with pytest.raises(ZeroDivisionError) as error:
        run_page(str(page))
    assert error.traceback[-1].lineno + 1 == 4
