"""Pages opened in a real browser, in which nothing may go wrong unseen."""

from __future__ import annotations

import io
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import polhode as ph
from browser.chromium import ARGUMENTS, find_chromium
from browser.runs import JUDGED, double_pendulum, run_of
from polhode.catalogue import CATALOGUE

WIDE = {"width": 1000, "height": 640}
SMALL = {"width": 520, "height": 480}
PHONE = {"width": 390, "height": 844}
PATIENCE = 90_000  # ms, on a machine that has other work
PAINTED = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
AXE = Path(__file__).parent / "node_modules" / "axe-core" / "axe.min.js"
#: What axe looks for, by colour scheme: all but the contrast of colours is the same in the dark.
RULES = {
    "light": "axe.run()",
    "dark": "axe.run({runOnly: {type: 'rule', values: ['color-contrast']}})",
}


@dataclass
class Opened:
    """A page in the browser, with all it complained of and asked for."""

    page: object
    complaints: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def time(self) -> float:
        """What the clock of the page shows, s."""
        return float(self.page.locator("output.time").inner_text().split()[0])

    def until(self, condition: Callable[[], bool]) -> None:
        """Wait until something is so, however slow the machine is."""
        for _ in range(PATIENCE // 50):
            if condition():
                return
            self.page.wait_for_timeout(50)
        assert condition()

    def wait_until_past(self, time: float) -> None:
        """Until the clock of the page is past a time, s."""
        self.until(lambda: self.time() > time)

    def value(self, number: int = 0) -> str:
        """What stands beside a quantity above its plot."""
        return self.page.locator(".key .value").nth(number).inner_text()

    def picture(self, folder: Path) -> np.ndarray:
        """Pixels of the three-dimensional picture, shape (height, width, 3)."""
        self.page.wait_for_timeout(150)
        self.page.evaluate(PAINTED)
        shot = folder / "picture.png"
        self.page.locator(".picture").screenshot(path=shot)
        return np.asarray(Image.open(shot).convert("RGB"), dtype=int)

    def picture_of(self, element: object) -> np.ndarray:
        """Pixels of an element, shape (height, width, 3)."""
        self.page.evaluate(PAINTED)
        shot = element.screenshot()
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=int)


# For the tests of one file: its event loop would be in the way of others' loops.
@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=find_chromium(), args=list(ARGUMENTS))
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def opened(browser):
    """Opens a file as from disk; the network is off."""

    @contextmanager
    def open_page(path, *, viewport=WIDE, script="", **options):
        context = browser.new_context(viewport=viewport, offline=True, locale="en-US", **options)
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        shown = Opened(page)
        page.on("console", lambda m: shown.complaints.append(m.text) if _bad(m) else None)
        page.on("pageerror", lambda error: shown.complaints.append(str(error)))
        page.on("dialog", lambda dialog: shown.complaints.append(dialog.message))
        page.on("request", lambda request: shown.requests.append(request.url))
        if script:
            page.add_init_script(script)
        page.goto(path.as_uri())
        page.wait_for_selector("body[data-ready]", timeout=PATIENCE)
        yield shown
        context.close()

    return open_page


def _bad(message) -> bool:
    return message.type in ("error", "warning") and "GPU stall" not in message.text


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    """The page of a system of the catalogue, or of a double pendulum; written once."""
    folder = tmp_path_factory.mktemp("pages")
    known = {}

    def path_of(name):
        if name not in known:
            known[name] = folder / f"{name.replace('/', '-')}.html"
            if name == "double pendulum":
                ph.page(double_pendulum(), known[name], judgements=JUDGED)
            else:
                entry = CATALOGUE[name]
                ph.page(run_of(name), known[name], title=entry.title, plots=entry.plots)
        return known[name]

    return path_of
