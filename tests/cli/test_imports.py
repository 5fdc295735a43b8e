"""Asking how to use it costs no heavy import."""

import subprocess
import sys

import pytest

HEAVY = ("numpy", "shapely", "pydantic", "matplotlib", "scipy")


def imported_by(*arguments):
    """Names of all modules that a run of ``python`` imports."""
    done = subprocess.run(
        [sys.executable, "-X", "importtime", *arguments],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    return {line.rpartition("|")[2].strip() for line in done.stderr.splitlines() if "|" in line}


@pytest.mark.parametrize(
    "arguments",
    [
        ("-m", "clearway", "--help"),
        ("-m", "clearway", "solve", "--help"),
        ("-m", "clearway", "--version"),
        ("-m", "clearway", "solve"),
        ("-c", "import clearway"),
        ("-c", "import clearway.cli"),
    ],
    ids=" ".join,
)
def test_nothing_heavy_is_imported(arguments):
    """Help, version, usage errors and the package itself come without the big libraries."""
    names = imported_by(*arguments)
    assert "clearway" in names
    assert not {name for name in names if name.split(".")[0] in HEAVY}


@pytest.mark.parametrize("name", ["solve", "Run", "Budget", "read_scenario", "validate_plan"])
def test_the_package_gives_its_names_on_first_use(name):
    """And an unknown one is an attribute that is not there."""
    import clearway

    assert getattr(clearway, name)
    assert name in clearway.__all__
    with pytest.raises(AttributeError, match="sovle"):
        _ = clearway.sovle
