"""Runs the Python of a documentation page."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def run_page(name: str) -> dict[str, object]:
    """Execute all ``python`` blocks of a page in one namespace and return it.

    Parameters
    ----------
    name
        Path below ``docs/``. Errors point at the page's own lines.
    """
    path = DOCS / name
    page = path.read_text(encoding="utf-8")
    blocks = list(BLOCK.finditer(page))
    if not blocks:
        raise ValueError(f"{path} has no python block to run")
    namespace: dict[str, object] = {"__name__": path.stem}
    for block in blocks:
        lines_before = page.count("\n", 0, block.start(1))
        exec(compile("\n" * lines_before + block.group(1), str(path), "exec"), namespace)
    return namespace
