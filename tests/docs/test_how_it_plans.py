"""The page on how plans are made: its pictures, and the names and numbers that it quotes."""

import importlib.util
import math
import re

import pytest
from tests.docs.run_page import DOCS

from clearway.model import Piece, Pose, Trajectory
from clearway.plan import TeamParams
from clearway.plan.native_team import COARSE_HEADINGS, FINE_HEADINGS

PAGE = (DOCS / "how-it-plans.md").read_text(encoding="utf-8")
PICTURES = re.findall(r"!\[.+\]\(images/how-it-plans-(.+)\.png\)", PAGE)
WORDS = " ".join(PAGE.split())
ROOT = DOCS.parent


@pytest.fixture(scope="module")
def script():
    """The script that makes the pictures."""
    spec = importlib.util.spec_from_file_location("script", DOCS / "make_how_it_plans.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_shows_what_the_script_makes(script):
    """Each picture has a place on the page, and a file that does not weigh much."""
    assert list(script.PICTURES) == PICTURES
    for name in PICTURES:
        assert (DOCS / "images" / f"how-it-plans-{name}.png").stat().st_size < 150_000


def test_the_script_makes_a_picture(script, tmp_path):
    """The table of motions needs no search; made twice, it is the same."""
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        script.main(["motions", "--out", str(tmp_path / folder)])
    one, two = (path.read_bytes() for path in sorted(tmp_path.rglob("*.png")))
    assert one.startswith(b"\x89PNG")
    assert one == two


def test_an_unknown_picture_is_refused(script, capsys):
    """The message lists what there is."""
    with pytest.raises(SystemExit):
        script.main(["maps"])
    assert "take motions, search" in capsys.readouterr().err


def test_a_robot_is_where_its_trajectory_says(script):
    """A metre ahead from 1 s to 3 s: half of it is driven at 2 s, and then it rests."""
    start = Pose(0.0, 0.0, math.pi / 2.0)
    path = Trajectory("r1", start, (Piece(0, None, start, (1.0, 0.0, 0.0)),), ((1000, 3000),))
    where = [script.pose_at(path, t).y for t in (0.5, 2.0, 9.0)]
    assert where == pytest.approx([0.0, 0.5, 1.0])
    assert script.waits(path) == 1.0


@pytest.mark.parametrize("name", re.findall(r"`((?:src|cpp|tests)/[\w./]+)`", PAGE))
def test_the_page_names_files_that_exist(name):
    """Nothing that the page sends a reader to has moved away."""
    assert (ROOT / name).exists()


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("margin", 0.01, "keep 0.01 m"),
        ("first_penalty", 5.0, "5 s for each"),
        ("penalty_growth", 1.5, "half as much again"),
        ("first_hold", 5.0, "for 5 s in the eyes"),
        ("search_limit", 15_000, "15,000 expansions"),
        ("alone_limit", 400_000, "400,000 expansions"),
        ("neighbourhood", 8, "up to 8 robots"),
    ],
)
def test_the_page_tells_the_defaults_of_a_team(name, value, told):
    """What the page says of a parameter is what it is."""
    assert told in WORDS
    assert f"`{name}`" in WORDS
    assert getattr(TeamParams(), name) == value


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("weight", 1.1, "it is 1.1"),
        ("greed", 0.3, "grows by 0.3"),
        ("most_weight", 2.5, "up to 2.5"),
        ("tail_weight", 2.0, "weighs 2"),
        ("cell", 0.85, "0.85 of the shortest motion"),
        ("shot_words", 2, "the two best curves"),
    ],
)
def test_the_page_tells_the_defaults_of_a_search(name, value, told):
    """What the page says of a parameter is what it is."""
    assert told in WORDS
    assert f"`{name}`" in WORDS
    assert getattr(TeamParams().search, name) == value


@pytest.mark.parametrize(
    ("file", "constant", "told"),
    [
        ("search/tour_search.cpp", "kMostDelays = 64;", "up to 64 times"),
        ("search/tour_search.cpp", "kFirstGreed = 256;", "after 256 expansions"),
        ("multi/prioritised.cpp", "3 * order.size() + 8;", "three times as many robots"),
    ],
)
def test_the_page_tells_the_constants_of_the_core(file, constant, told):
    """What is no parameter stands in the source."""
    assert told in WORDS
    assert constant in (ROOT / "cpp" / "src" / file).read_text(encoding="utf-8")


def test_the_page_tells_the_headings():
    """16 of them, and 32 in the retry."""
    assert "a full turn / 16 (`COARSE_HEADINGS`)" in WORDS
    assert "with 64 headings (`FINE_HEADINGS`)" in WORDS
    assert (COARSE_HEADINGS, FINE_HEADINGS) == (16, 64)
