"""A motion in a notebook's cell plays in its frame."""

import pytest

from browser.conftest import PATIENCE
from browser.runs import run_of


@pytest.fixture(scope="module")
def cell(tmp_path_factory):
    path = tmp_path_factory.mktemp("notebook") / "cell.html"
    html = run_of("gyroscope")._repr_html_()
    path.write_text(f"<!DOCTYPE html><meta charset='utf-8'><body data-ready>{html}</body>", "utf-8")
    return path


def test_the_frame_plays(opened, cell):
    with opened(cell) as shown:
        frame = shown.page.frame_locator("iframe")
        frame.locator("body[data-ready]").wait_for(timeout=PATIENCE)
        frame.get_by_role("button", name="Play").click()
        frame.get_by_role("button", name="Pause").wait_for()
        shown.until(lambda: float(frame.locator("output.time").inner_text().split()[0]) > 0)
        assert frame.locator(".plot canvas").count() > 0
        assert shown.page.locator("iframe").bounding_box()["width"] <= 1000
        assert [url for url in shown.requests if not url.startswith(("file:", "about:"))] == []
        assert shown.complaints == []


def test_a_frame_out_of_sight_is_ready_when_it_is_scrolled_to(opened, cell):
    """Browsers paint no frame that is out of sight, and exported notebooks begin with many."""
    with opened(cell) as shown:
        shown.page.evaluate("document.body.style.paddingTop = '5000px'")
        shown.page.frames[1].evaluate("location.reload()")
        frame = shown.page.frame_locator("iframe")
        frame.locator("body[data-ready]").wait_for(state="attached", timeout=PATIENCE)
        assert frame.locator("canvas").count() > 1
