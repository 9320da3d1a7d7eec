"""How long the lab takes from a slider's change to the new picture, for every system, in Chromium.

Prints, for each system of the catalogue with its default numbers, the time from opening it to its
first picture, and the median, least and largest time from moving a slider to the frame in which the
new motion is drawn; of this, what the server took; and the median until plots and formulas are
there too. In milliseconds.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from playwright.sync_api import sync_playwright  # noqa: E402

from browser.chromium import ARGUMENTS, find_chromium  # noqa: E402
from polhode.catalogue import CATALOGUE  # noqa: E402

CHANGES = 8
PATIENCE = 120_000  # ms
HEADINGS = ("opens", "median", "least", "largest", "server", "all")

# Moves the first slider a little, and waits until the picture's frame has been painted: reading a
# pixel waits for all that was asked of what draws. Then waits for the frame of all the rest.
CHANGE = """async (step) => {
  const slider = document.querySelector(".slider input[type=range]");
  const { dataset } = document.body;
  const { pictures, answers } = dataset;
  const frame = () => new Promise(requestAnimationFrame);
  const gl = document.querySelector(".picture canvas").getContext("webgl2");
  const drawn = async () => {
    await frame();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - began;
  };
  const began = performance.now();
  slider.value = String(Number(slider.value) + (step % 2 ? 7 : -6));
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  while (dataset.pictures === pictures) await frame();
  const picture = await drawn();
  const asked = performance.getEntriesByType("resource").findLast((r) => /run$/.test(r.name));
  while (dataset.answers === answers) await frame();
  return [picture, asked.responseEnd - asked.requestStart, await drawn()];
}"""


def main() -> None:
    command = [sys.executable, "-m", "polhode", "lab", "--no-browser", "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as serving:
        assert serving.stdout is not None
        found = re.search(r"http://\S+/", serving.stdout.readline())
        assert found
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=find_chromium(), args=list(ARGUMENTS)
            )
            print(f"{'system':28}", *(f"{heading:>7}" for heading in HEADINGS))
            for name in CATALOGUE:
                print(f"{name:28}", *(f"{t:7.0f}" for t in measured(browser, found[0], name)))
            browser.close()
        serving.terminate()


def measured(browser: Any, address: str, name: str) -> tuple[float, ...]:
    """Times to open; median, least and largest to change; medians of server and whole; all ms."""
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.goto(f"{address}#system={name}")
    page.wait_for_selector("body[data-ready]", timeout=PATIENCE)
    opens = page.evaluate("performance.now()")
    times = [page.evaluate(CHANGE, step) for step in range(CHANGES)]
    page.close()
    picture, server, whole = zip(*times[1:], strict=True)
    most = max(picture)
    return opens, median(picture), min(picture), most, median(server), median(whole)


if __name__ == "__main__":
    main()
