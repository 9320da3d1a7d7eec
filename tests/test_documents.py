"""The Python in README and docs runs, and prints what the page says it prints."""

import contextlib
import io
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [
    page
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if "```python" in page.read_text()
]
BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_page_tells_the_truth(page):
    names: dict[str, object] = {}
    printed = ""
    for kind, block in BLOCK.findall(page.read_text()):
        if kind == "text":
            assert printed == block
            printed = ""
            continue
        assert not printed, f"{page.name} hides what is printed before: {block}"
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(compile(block, str(page), "exec"), names)
        printed = out.getvalue()
    assert not printed
