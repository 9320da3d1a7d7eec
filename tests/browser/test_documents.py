"""Pages of the documents: axe finds nothing serious, by day and by night, on a phone too."""

import shutil
import subprocess
import sys
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest

from browser.conftest import AXE, PATIENCE, PHONE, RULES, WIDE

ROOT = Path(__file__).parents[2]
#: A front page, examples with figures, a reference with tables of parameters.
CHOSEN = ("index.md", "tutorials/spinning-coin.md", "reference/solving.md")

#: Whether every example has its button to copy, with a name.
NAMED = """[...document.querySelectorAll("pre > code")].every(
    code => code.closest(".highlight").querySelector(".md-code__nav[aria-label]"))"""


class Quiet(SimpleHTTPRequestHandler):
    """Tells nothing of what it serves."""

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The address of a few pages, built as all are."""
    folder = tmp_path_factory.mktemp("documents")
    for name in CHOSEN:
        (folder / "docs" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / "docs" / name, folder / "docs" / name)
    for name in ("theme", "pictures"):
        shutil.copytree(ROOT / "docs" / name, folder / "docs" / name)
    settings = (
        f"INHERIT: {ROOT / 'mkdocs.yml'}\nhooks: [{ROOT / 'docs_hooks.py'}]\nstrict: false\n"
        f"docs_dir: {folder / 'docs'}\nsite_dir: {folder / 'site'}\nuse_directory_urls: false\n"
        f"nav: [{', '.join(CHOSEN)}]\n"
    )
    (folder / "mkdocs.yml").write_text(settings, "utf-8")
    command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "-f", str(folder / "mkdocs.yml")]
    subprocess.run(command, check=True, cwd=ROOT, capture_output=True, timeout=120)
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder / "site"))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


@pytest.fixture
def page(browser, site, request):
    """A page of the documents, which asks for nothing from elsewhere."""
    name, viewport = request.param
    context = browser.new_context(viewport=viewport)
    shown = context.new_page()
    asked = []
    shown.on("request", lambda sent: asked.append(sent.url))
    shown.goto(site + name.replace(".md", ".html"))
    yield shown
    assert [url for url in asked if not url.startswith((site, "data:", "blob:"))] == []
    context.close()


EVERY = [*((name, PHONE) for name in CHOSEN[:2]), *((name, WIDE) for name in CHOSEN[1:])]


@pytest.mark.parametrize("page", EVERY, indirect=True, ids=str)
def test_axe_finds_no_serious_fault_of_the_documents(page):
    page.wait_for_selector(".md-search[aria-label]", state="attached", timeout=PATIENCE)
    page.wait_for_function(NAMED, timeout=PATIENCE)
    page.evaluate(AXE.read_text("utf-8"))
    for scheme, named in (("light", "default"), ("dark", "slate")):
        page.emulate_media(color_scheme=scheme)
        page.wait_for_selector(f"body[data-md-color-scheme={named}]", timeout=PATIENCE)
        page.wait_for_timeout(400)  # colours fade
        faults = page.evaluate(RULES[scheme])["violations"]
        serious = [(f["id"], f["nodes"][0]["html"]) for f in faults if f["impact"] != "minor"]
        assert (scheme, serious) == (scheme, [])
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize("page", [("tutorials/spinning-coin.md", WIDE)], indirect=True, ids=str)
def test_dots_stand_over_their_letters(page):
    letter = page.locator(".dotted").first
    assert letter.inner_text() == "φ\N{COMBINING DIAERESIS}"  # and so it is copied
    assert letter.evaluate("e => getComputedStyle(e, '::before').content") == '"¨"'
    assert 4 < letter.bounding_box()["width"] < 16
