"""Somebody who opens pages in a real browser, without a network."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

PHONE = {"width": 360, "height": 740}
DESK = {"width": 1600, "height": 1000}
HOSTILE = ("</script><b>x</b>", "\"'><img src=x onerror=alert(1)>", "__proto__", "\u2028 & &lt;")


class Visitor:
    """Somebody with the page open, who notices every complaint and every request."""

    def __init__(
        self, browser: "Browser", file: Path, size: dict[str, int], **context: Any
    ) -> None:
        settings = {"viewport": size, "reduced_motion": "reduce", **context}
        self.page: Page = browser.new_context(**settings).new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(file.as_uri())
        self.settle()

    def settle(self) -> None:
        """Wait until the page has drawn what it was told."""
        self.page.evaluate(
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )

    def run(self, script: str) -> Any:
        result = self.page.evaluate(script)
        self.settle()
        return result

    def wait(self, condition: str) -> None:
        """Wait for a condition, ten seconds of frames at most; the page's policy forbids eval."""
        script = """async () => {
            for (let i = 0; i < 600 && !(CONDITION); i += 1) {
                await new Promise((done) => requestAnimationFrame(done));
            }
            return Boolean(CONDITION);
        }"""
        assert self.page.evaluate(script.replace("CONDITION", condition)), condition

    def press(self, *keys: str) -> dict[str, Any]:
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()
        return dict(self.page.evaluate("clearway.view()"))

    @property
    def time(self) -> float:
        return float(self.page.evaluate("clearway.time()"))

    def close(self) -> None:
        self.page.context.close()
