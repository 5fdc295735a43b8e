"""The scenarios that come with Clearway."""

from importlib import resources
from pathlib import Path


def scenario_folder() -> Path:
    """Return the folder of the scenarios that come with Clearway."""
    installed = Path(str(resources.files("clearway"))) / "scenarios"
    in_tree = Path(__file__).parents[3] / "scenarios"
    return installed if installed.is_dir() else in_tree
