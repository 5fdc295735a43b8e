"""Rows on disk outlive whatever stops a study."""

import errno
import json
import os

import pytest

from clearway.formats.atomic import FormatError
from clearway.study.rows_file import RowsFile

ORIGIN = {"study": "squares", "version": 1}
KEYS = {"a", "b", "c"}


def written(path, *rows):
    """Write rows by the front door."""
    with RowsFile(path, ORIGIN, KEYS) as file:
        for row in rows:
            file.add(row)


@pytest.fixture
def path(tmp_path):
    """A file that is not there yet."""
    return tmp_path / "rows.jsonl"


def test_rows_are_there_when_the_file_is_opened_again(path):
    """And as they will be read: a tuple comes back as a list."""
    written(path, {"cell": "a", "value": (1, 2)})
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert file.rows == {"a": {"cell": "a", "value": [1, 2]}}
        assert file.notes == []


def test_a_last_line_that_was_cut_short_is_dropped(path):
    """With a word; what comes next begins a line of its own."""
    written(path, {"cell": "a"}, {"cell": "b"})
    path.write_bytes(path.read_bytes()[:-4])
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert list(file.rows) == ["a"]
        assert "cut short" in file.notes[0]
        file.add({"cell": "c"})
    assert [json.loads(line).get("cell") for line in path.read_text().splitlines()] == [
        None,
        "a",
        "c",
    ]


def test_a_first_line_that_was_cut_short_begins_anew(path):
    """Nothing was done yet."""
    path.write_text('{"study": "squ')
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert file.rows == {}
    assert json.loads(path.read_text()) == ORIGIN


def test_a_broken_line_in_the_middle_is_named(path):
    """It is nothing that a stop leaves behind."""
    written(path, {"cell": "a"}, {"cell": "b"})
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], lines[1][:-3], lines[2]]) + "\n")
    with pytest.raises(FormatError, match=r"rows.jsonl: line 2 is no JSON object.*delete"):
        RowsFile(path, ORIGIN, KEYS)


@pytest.mark.parametrize(
    ("origin", "keys", "told"),
    [
        ({"study": "cubes", "version": 1}, KEYS, r'study is "squares", not "cubes"'),
        ({"study": "squares", "version": 2}, KEYS, "version is 1, not 2"),
        (ORIGIN, {"b"}, "line 2 is a row of another cell, a"),
    ],
)
def test_rows_of_something_else_are_refused(path, origin, keys, told):
    """And stay as they are."""
    written(path, {"cell": "a"})
    before = path.read_bytes()
    with pytest.raises(FormatError, match=f"{told}.*give another --out"):
        RowsFile(path, origin, keys)
    assert path.read_bytes() == before


def test_failed_rows_are_forgotten(path):
    """They are made again; the others are not."""
    written(path, {"cell": "a"}, {"cell": "b", "failed": "its worker died"})
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert list(file.rows) == ["a"]
        assert "made again" in file.notes[0]
        file.add({"cell": "b"})
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert set(file.rows) == {"a", "b"}


def test_two_studies_do_not_write_into_one_file(path):
    """The second one is told."""
    with RowsFile(path, ORIGIN, KEYS), pytest.raises(FormatError, match="another study is writing"):
        RowsFile(path, ORIGIN, KEYS)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="this system has no /dev/full")
def test_a_full_disk_keeps_what_is_there(path):
    """The error names the file, and the rows before can be read."""
    written(path, {"cell": "a"})
    with RowsFile(path, ORIGIN, KEYS) as file:
        full = os.open("/dev/full", os.O_WRONLY)
        os.dup2(full, file._file)
        os.close(full)
        with pytest.raises(OSError) as caught:
            file.add({"cell": "b"})
        assert caught.value.errno == errno.ENOSPC
        assert caught.value.filename == str(path)
    with RowsFile(path, ORIGIN, KEYS) as file:
        assert list(file.rows) == ["a"]


def test_a_row_that_half_fits_is_taken_back(path):
    """A limit on the file's size stands for a disk that fills up in the middle of a line."""
    import resource
    import signal

    written(path, {"cell": "a"})
    size = path.stat().st_size
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (size + 8, limit[1]))
        with RowsFile(path, ORIGIN, KEYS) as file, pytest.raises(OSError):
            file.add({"cell": "b", "value": "long enough"})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, before)
    assert path.stat().st_size == size
