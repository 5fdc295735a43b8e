"""The command line, run as people and machines run it."""

import json
import subprocess
import sys
from dataclasses import dataclass

import pytest
from tests.cli.sites import HALL

SECONDS = 120


@dataclass(frozen=True)
class Told:
    """What a command answered."""

    code: int
    out: str
    err: str

    @property
    def json(self):
        """The one object on stdout; anything beside it is an error."""
        return json.loads(self.out)


@pytest.fixture
def clearway(tmp_path):
    """Run ``clearway`` in an empty folder."""

    def run(*arguments):
        done = subprocess.run(
            [sys.executable, "-m", "clearway", *map(str, arguments)],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            timeout=SECONDS,
            check=False,
        )
        return Told(done.returncode, done.stdout, done.stderr)

    return run


@pytest.fixture
def hall(tmp_path):
    """A scenario file of two carriers and two tasks."""
    path = tmp_path / "hall.toml"
    path.write_text(HALL)
    return path


@pytest.fixture(scope="session")
def solved_hall(tmp_path_factory):
    """A run folder of the hall, to be read only."""
    folder = tmp_path_factory.mktemp("solved")
    (folder / "hall.toml").write_text(HALL)
    subprocess.run(
        [sys.executable, "-m", "clearway", "solve", "hall.toml", "--out", "run", "--quiet"],
        cwd=folder,
        check=True,
        capture_output=True,
        timeout=SECONDS,
    )
    return folder / "run"
