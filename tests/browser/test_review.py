"""The page of a review in a browser: it plays a state, fits a phone, and axe finds no fault."""

import pytest

from browser.conftest import AXE, PATIENCE, PHONE, RULES, WIDE
from judge.solutions import equations, hostile, solution
from polhode.judge import Hints, Review, review_page

HOSTILE = (
    "</script><script>alert(1)</script><img src=x onerror=alert(2)>"
    "\\text{<script>alert(3)</script>}"
)
LATER = "(b) => Promise.all([...document.querySelectorAll('details')].map(d => d.open = b))"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The pages of a solution, and of one that is hostile."""
    place = tmp_path_factory.mktemp("review")
    review_page(solution(), place / "all.html", equations())
    review_page(solution(), place / "where.html", equations(), Hints.WHERE)
    review_page(hostile(HOSTILE), place / "hostile.html", equations())
    return place


@pytest.fixture
def visit(browser):
    """Opens a page from disk without a network; what it complains of and asks for is kept."""
    contexts = []

    def open_page(path, viewport=WIDE, **options):
        context = browser.new_context(viewport=viewport, offline=True, locale="en-US", **options)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        trouble = []
        page.on("console", lambda m: trouble.append(m.text) if "GPU stall" not in m.text else None)
        page.on("pageerror", lambda error: trouble.append(str(error)))
        page.on("dialog", lambda dialog: trouble.append(dialog.message))
        page.on("request", lambda r: trouble.append(r.url) if r.url.startswith("http") else None)
        page.goto(path.as_uri())
        return page, trouble

    yield open_page
    for context in contexts:
        context.close()


def test_a_state_is_played_where_its_button_stands(visit, folder):
    page, trouble = visit(folder / "all.html")
    page.evaluate(LATER, True)
    button = page.get_by_role("button", name="Show the motion from this state")
    button.click()
    assert button.get_attribute("aria-expanded") == "true"
    inside = page.frame_locator("#r1 iframe")
    inside.locator("body[data-ready]").wait_for()
    assert inside.get_by_role("heading").first.inner_text().endswith("refutes line 9")
    assert inside.locator("canvas").first.bounding_box()["width"] > 200
    button.click()
    assert page.locator("iframe").count() == 0
    assert trouble == []


@pytest.mark.parametrize("name", ["all.html", "where.html", "hostile.html"])
@pytest.mark.parametrize("viewport", [WIDE, PHONE], ids=["wide", "phone"])
def test_nothing_sticks_out_and_nothing_runs_that_should_not(visit, folder, name, viewport):
    page, trouble = visit(folder / name, viewport)
    page.evaluate(LATER, True)
    assert page.evaluate("document.documentElement.scrollWidth") <= viewport["width"]
    assert trouble == []


@pytest.mark.parametrize("viewport", [WIDE, PHONE], ids=["wide", "phone"])
def test_a_formula_within_words_that_is_too_long_scrolls(visit, tmp_path, viewport):
    total = " + ".join([r"m a^2(8\omega_3^2 + \dot\theta^2)"] * 12)
    text = f"Here $T = {total}$ holds."
    review_page(Review("", ("a.tex",), (), texts={"a.tex": text}), tmp_path / "a.html")
    page, trouble = visit(tmp_path / "a.html", viewport)
    assert page.evaluate("document.documentElement.scrollWidth") <= viewport["width"]
    assert page.evaluate("(w => w.scrollWidth > w.clientWidth)(document.querySelector('.wide'))")
    assert trouble == []


@pytest.mark.parametrize("viewport", [WIDE, PHONE], ids=["wide", "phone"])
def test_axe_finds_no_serious_fault_of_a_review(visit, folder, viewport):
    page, _ = visit(folder / "all.html", viewport, bypass_csp=True)
    page.evaluate(LATER, True)
    page.evaluate(AXE.read_text("utf-8"))
    for scheme, rules in RULES.items():
        page.emulate_media(color_scheme=scheme)
        faults = page.evaluate(rules)["violations"]
        serious = [(f["id"], f["nodes"][0]["html"]) for f in faults if f["impact"] != "minor"]
        assert (scheme, serious) == (scheme, [])


def test_a_link_leads_to_the_relation_that_it_names(visit, folder):
    page, _ = visit(folder / "all.html")
    page.get_by_role("link", name="line 9").first.click()
    assert page.url.endswith("#r1")
    assert page.locator("#r1:target").count() == 1
