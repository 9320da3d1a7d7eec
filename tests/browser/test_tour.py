"""Pages of the tour and of audits: what is too wide is scrolled, by the keyboard too."""

import subprocess
import sys
from importlib.resources import files

import pytest

from browser.conftest import AXE, PHONE, WIDE
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


@pytest.fixture(scope="module")
def audited(tmp_path_factory):
    """The page of an audit of a few claims, one of which fails and is corrected."""
    path = tmp_path_factory.mktemp("audit") / "audit.html"
    only = [word for claim in ("1", "13", "66") for word in ("--only", claim)]
    command = [sys.executable, "-m", "polhode", "audit", *only, "--html", str(path)]
    subprocess.run(command, check=False, capture_output=True, timeout=120)  # 1: some fail
    html = path.read_text("utf-8")
    path.write_text(html.replace("<body ", "<body data-ready "), "utf-8")
    return path


@pytest.mark.parametrize("viewport", [WIDE, PHONE])
def test_axe_finds_no_serious_fault_of_an_audit(opened, audited, viewport):
    with opened(audited, viewport=viewport) as shown:
        shown.page.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })")
        shown.page.evaluate(AXE.read_text("utf-8"))
        faults = shown.page.evaluate("axe.run()")["violations"]
        assert shown.page.locator("article").count() == 3
        assert shown.page.locator(".correction").count() == 1
        assert [f["id"] for f in faults if f["impact"] in ("serious", "critical")] == []
