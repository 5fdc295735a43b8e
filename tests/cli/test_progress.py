"""The one line that tells how far a long command is."""

import io
import sys

import pytest

from clearway.cli import progress
from clearway.cli.progress import ProgressLine


class Terminal(io.StringIO):
    """Something that says it is one."""

    def isatty(self):
        return True


@pytest.fixture
def shown(monkeypatch):
    """What a line shows, at seconds of our choice."""
    terminal, now = Terminal(), [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])

    def after(seconds):
        monkeypatch.setattr(sys, "stderr", terminal)
        now[0] = 100.0 + seconds
        return terminal

    return after


def test_time_left_is_told_at_the_pace_of_this_run(shown):
    """20 rows were there, 10 more took 60 s: the 70 left take 7 minutes."""
    terminal = shown(0.0)
    with ProgressLine(quiet=False) as line:
        line.rows(20, 100)
        shown(60.0)
        line.rows(30, 100)
        text = terminal.getvalue()
    assert "30/100 rows, 7 min 0 s left, 60 s" in text
    assert "[#######................." in text


def test_before_the_first_row_no_time_is_guessed(shown):
    """Nothing is known of the pace."""
    terminal = shown(0.0)
    with ProgressLine(quiet=False) as line:
        line.rows(0, 9)
        shown(5.0)
        line.rows(0, 9)
        assert "0/9 rows, 5 s" in terminal.getvalue()
        assert "left" not in terminal.getvalue()


def test_notes_stay_and_the_line_goes(shown):
    """A note is a line of its own, not quiet ones."""
    terminal = shown(0.0)
    with ProgressLine(quiet=False) as line:
        shown(2.0)
        line.say("working")
        line.note("a row is made again")
    assert terminal.getvalue().endswith("\rclearway: a row is made again\n")
    silent = shown(3.0)
    before = silent.getvalue()
    ProgressLine(quiet=True).note("nothing")
    assert silent.getvalue() == before


@pytest.mark.parametrize(
    ("seconds", "told"), [(8.4, "8 s"), (61.0, "1 min 1 s"), (7322.0, "2 h 2 min")]
)
def test_times_are_told_without_units_that_are_none(seconds, told):
    """Seconds, minutes or hours."""
    assert progress._clock(seconds) == told
