"""Pages of the tour and of audits: what is too wide is scrolled, by the keyboard too."""

import subprocess
import sys
from importlib.resources import files

import numpy as np
import pytest
from PIL import Image

import polhode as ph
from browser.conftest import AXE, PHONE, WIDE
from polhode.judge import audit_html
from polhode.lab._files import built
from polhode.view import math_fonts, typeset

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


ROOT = r"\sqrt{\frac{mga}{I_1}}"


def _tour():
    style = files("polhode").joinpath("tour", "style.css").read_text("utf-8")
    return f"<style>{math_fonts()}\n{style}</style>{typeset(ROOT)}"


def _page():
    return f"<style>{math_fonts()}{built('page.css')}</style>{typeset(ROOT)}"


def _lab():
    return f"<style>{built('lab.css')}</style>{typeset(ROOT)}"


def _notebook():
    root = ph.sqrt(ph.symbol("m") / ph.symbol("I_1"))
    return root._repr_html_()


def _report():
    document = HEAD + f"means = '{ROOT} > 0'"
    return audit_html(ph.audit(document))


HEAD = """schema = 1
[document]
title = "A text"
[[part]]
id = "7"
system = "gyroscope"
[[claim]]
id = "1"
part = "7"
words = "it is"
"""


@pytest.mark.parametrize("written", [_tour, _page, _lab, _notebook, _report])
def test_the_sign_of_a_root_is_as_tall_as_the_fraction_under_it(opened, tmp_path, written):
    """Without a font for mathematics the sign stands beside the numerator alone."""
    path = tmp_path / "page.html"
    style = "<style>math { font-size: 60px !important; color: #000 !important }</style>"
    html = f"<!DOCTYPE html><meta charset='utf-8'>{style}<body data-ready>{written()}</body>"
    path.write_text(html, "utf-8")
    with opened(path, color_scheme="light") as shown:
        root = shown.page.locator("msqrt:has(mfrac)").first
        under = root.locator("mfrac").first
        beside, box = root.bounding_box(), under.bounding_box()
        sign = {**beside, "width": box["x"] - beside["x"] - 1}
        shot = tmp_path / "sign.png"
        shown.page.screenshot(path=shot, clip=sign)
        ink = np.asarray(Image.open(shot).convert("L")).min(axis=1) < 128
        assert box["height"] > 60
        assert ink.sum() >= 0.8 * box["height"]


@pytest.fixture(scope="module")
def audited(tmp_path_factory):
    """The page of an audit of a few claims, one of which fails and is corrected."""
    path = tmp_path_factory.mktemp("audit") / "audit.html"
    only = [word for claim in ("1", "13", "66") for word in ("--only", claim)]
    command = [sys.executable, "-m", "polhode", "audit", *only, "--html", str(path)]
    subprocess.run(command, check=False, capture_output=True, timeout=600)  # 1: some fail
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
