"""How soon the report of a run shows its first picture, and how long a frame takes.

Usage: ``python benchmarks/replay.py RUN/ ...`` with folders that hold a ``report.html``. It needs
playwright and a Chromium. Frames are drawn in software, at 1600 by 1000 pixels.
"""

import shutil
import sys
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, sync_playwright

FRAMES = 200
# Seeks all over the run, a robot chosen, as a hand on the slider does. `script` is what the page's
# own code takes for a frame; `frame` is until the next one begins.
SCRUB = """async (frames) => {
    const next = () => new Promise((done) => requestAnimationFrame(
        (begin) => done([begin, performance.now()])));
    const { duration } = clearway.view();
    const [script, frame] = [[], []];
    let [before] = await next();
    for (let i = 0; i < frames; i += 1) {
        clearway.seek(duration * (0.5 + 0.5 * Math.sin(0.37 * i)));
        const [begin, done] = await next();
        script.push(done - begin);
        frame.push(begin - before);
        before = begin;
    }
    return [script, frame];
}"""
TWO_FRAMES = "new Promise((d) => requestAnimationFrame(() => requestAnimationFrame(d)))"


def measure(page: Page, report: Path) -> dict[str, Any]:
    """Return seconds to the first picture, and the milliseconds of each frame."""
    begin = time.perf_counter()
    page.goto(report.as_uri())
    page.evaluate(TWO_FRAMES)
    opened = time.perf_counter() - begin
    first = page.evaluate("Object.keys(clearway.poses())[0]")
    page.evaluate("(id) => clearway.choose(id)", first)
    script, frame = page.evaluate(SCRUB, FRAMES)
    return {"opened": opened, "script": sorted(script), "frame": sorted(frame)}


def main(folders: list[str]) -> None:
    names = ("chromium", "chromium-browser", "google-chrome")
    browser_path = next((path for name in names if (path := shutil.which(name))), None)
    if browser_path is None or not folders:
        raise SystemExit(__doc__)
    print("run, MB, first picture s, script ms (median, 95 %, most), frame ms (median, 95 %, most)")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=browser_path, args=["--no-sandbox", "--disable-gpu"]
        )
        for folder in folders:
            report = Path(folder).resolve() / "report.html"
            size = {"width": 1600, "height": 1000}
            page = browser.new_context(viewport=size, reduced_motion="reduce").new_page()
            found = measure(page, report)
            told = [
                f"{found[k][FRAMES // 2]:.1f} {found[k][int(0.95 * FRAMES)]:.1f} {found[k][-1]:.1f}"
                for k in ("script", "frame")
            ]
            megabytes = report.stat().st_size / 1e6
            print(f"{folder}, {megabytes:.1f}, {found['opened']:.2f}, {told[0]}, {told[1]}")
            page.context.close()
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
