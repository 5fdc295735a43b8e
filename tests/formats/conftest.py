import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

MAKE = Path(__file__).parents[1] / "data" / "bad_traces" / "make.py"


@pytest.fixture(scope="session")
def traces() -> ModuleType:
    """Small traces made by hand, and what they are built with."""
    spec = importlib.util.spec_from_file_location("traces_by_hand", MAKE)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
