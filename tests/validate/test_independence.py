"""The judge has geometry of its own."""

import subprocess
import sys


def test_judging_loads_no_native_code_of_the_planner():
    """A judge who asks the accused is no judge: the core is not even loaded."""
    code = "import clearway.validate, sys; sys.exit('clearway._core' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=False)
    assert done.returncode == 0
