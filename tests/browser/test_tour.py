"""Pages of the tour on a telephone: what is wider than the screen is scrolled by itself."""

from importlib.resources import files

from browser.conftest import PHONE
from polhode.view import typeset

LONG = r"\frac{" + " + ".join([r"4\dot\theta^2\cos\theta"] * 9) + "}{8}"


def test_a_long_fraction_does_not_make_the_page_wide(opened, tmp_path):
    style = files("polhode").joinpath("tour", "style.css").read_text("utf-8")
    path = tmp_path / "page.html"
    path.write_text(
        f"<!DOCTYPE html><meta charset='utf-8'><style>{style}</style>"
        f"<body data-ready><main><div class='equation'>{typeset(LONG)}</div></main></body>",
        "utf-8",
    )
    with opened(path, viewport=PHONE) as shown:
        inner = shown.page.locator(".equation").evaluate("e => [e.scrollWidth, e.clientWidth]")
        assert inner[0] > inner[1]
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
