from types import ModuleType

import pytest
from tests.data.bad_traces import make


@pytest.fixture(scope="session")
def traces() -> ModuleType:
    """Small traces made by hand, and what they are built with."""
    return make
