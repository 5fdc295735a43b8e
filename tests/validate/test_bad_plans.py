"""One wrong plan of each kind, and right plans that are nearly wrong."""

from pathlib import Path

import pytest

from clearway.formats.plan_file import dump_plan, read_plan
from clearway.validate import validate_plan
from clearway.validate.violation import KINDS

DATA = Path(__file__).parents[1] / "data"
WRONG = sorted(path.stem for path in (DATA / "bad_plans").glob("*.json"))
RIGHT = sorted(path.stem for path in (DATA / "right_plans").glob("*.json"))
# Files with these faults cannot be read, so that the judge meets them in memory only.
REFUSED_BY_READER = {"robot", "clock"}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_plan_is_wrong_in_exactly_its_one_way(name: str) -> None:
    """A plan with one thing wrong has one violation, of the kind in the file's name."""
    found = validate_plan(read_plan(DATA / "bad_plans" / f"{name}.json"))
    assert [violation.kind for violation in found] == [name.split("--")[0]]


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_plan_is_right(name: str) -> None:
    """Contact, jumps of heading where allowed, and open borders are no violations."""
    assert validate_plan(read_plan(DATA / "right_plans" / f"{name}.json")) == []


def test_there_is_a_wrong_plan_of_every_kind() -> None:
    """Whatever the judge can find, a file shows."""
    assert {name.split("--")[0] for name in WRONG} == set(KINDS) - REFUSED_BY_READER


def test_the_files_are_those_that_the_script_makes(by_hand) -> None:
    """The wrong and right plans can be made again, byte for byte."""
    for folder, plans in (
        ("bad_plans", by_hand.wrong_plans()),
        ("right_plans", by_hand.right_plans()),
    ):
        made = {name: dump_plan(record) for name, record in plans.items()}
        kept = {p.stem: p.read_text() for p in (DATA / folder).glob("*.json")}
        assert made == kept
