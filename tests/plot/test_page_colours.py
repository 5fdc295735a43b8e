"""The page's colours can be read, by day and by night."""

import re
from importlib import resources

import pytest

from clearway.plot.palette import ROBOT_COLOURS

READ = [
    ("text", "page"),
    ("text", "surface"),
    ("text", "floor"),
    ("text", "chosen"),
    ("text", "warn-back"),
    ("text", "bad-back"),
    ("muted", "page"),
    ("muted", "surface"),
    ("muted", "chosen"),
    ("accent", "page"),
    ("accent", "surface"),
    ("on-accent", "accent"),
    ("on-service", "service"),
    ("on-service", "charge"),
    ("bad", "page"),
    ("good", "good-back"),
    ("warn", "warn-back"),
    ("bad", "bad-back"),
    ("zone-text", "floor"),
    ("page", "text"),
]
SEEN = [
    ("drive", "surface"),
    ("turn-dark", "turn"),
    ("wait", "surface"),
    ("service", "surface"),
    ("cursor", "surface"),
    ("charge", "surface"),
    ("fault", "surface"),
    ("fault", "floor"),
    ("waiting", "surface"),
    ("load", "surface"),
    ("focus", "page"),
    ("focus", "surface"),
    ("edge", "floor"),
]


def tokens(theme: str) -> dict[str, str]:
    """Return the colours of a theme; night inherits from day what it does not change."""
    sheet = resources.files("clearway.plot").joinpath("page/report.css").read_text("utf-8")
    day, night = (dict(re.findall(r"--([\w-]+): (#\w{6});", b)) for b in sheet.split("}")[:2])
    return day if theme == "light" else {**day, **night}


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours as WCAG 2.2 defines it: 1 (none) to 21."""

    def light(colour: str) -> float:
        shares = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted((light(one), light(other)))
    return (high + 0.05) / (low + 0.05)


def test_black_on_white_is_21() -> None:
    """The scale's own end point."""
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_words_and_signs_stand_out(theme: str) -> None:
    """Words have 4.5 to 1 and signs 3 to 1 (WCAG AA)."""
    colour = tokens(theme)
    faint = [(a, b) for a, b in READ if contrast(colour[a], colour[b]) < 4.5]
    faint += [(a, b) for a, b in SEEN if contrast(colour[a], colour[b]) < 3.0]
    assert faint == []


def test_an_id_reads_on_every_body() -> None:
    """White or near-black has 4.5 to 1 on each robot's colour."""
    for colour in ROBOT_COLOURS:
        assert max(contrast(colour, "#ffffff"), contrast(colour, "#111418")) >= 4.5
