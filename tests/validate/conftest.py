import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest
from tests.data.bad_traces import make

HERE = Path(__file__).parent


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"tests_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def by_hand() -> ModuleType:
    """The small plans of tests/data, and what they are built with."""
    return load(HERE.parent / "data" / "bad_plans" / "make.py")


@pytest.fixture(scope="session")
def traces() -> ModuleType:
    """The small traces of tests/data, and what they are built with."""
    return make


@pytest.fixture(scope="session")
def random_plans() -> ModuleType:
    """Right plans by construction, at random."""
    return load(HERE / "random_plans.py")
